#!/bin/sh
# SPDX-License-Identifier: MIT
# with_python.sh PYTHON SCRIPT ARGUMENT...: runs the script beside this one, or skips (77) where there is no such Python.
if ! [ -x "$1" ]; then
  echo "skipped: no $1 with the packages of tests/interop/requirements.txt"
  exit 77
fi
python=$1 script=$2
shift 2
exec "$python" "$(dirname "$0")/$script" "$@"
