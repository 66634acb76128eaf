#!/bin/sh
# SPDX-License-Identifier: MIT
# with_python.sh PYTHON ARGUMENT...: runs that Python, or skips (77) where there is none.
if ! [ -x "$1" ]; then
  echo "skipped: no $1 with the packages of tests/*/requirements.txt"
  exit 77
fi
exec "$@"
