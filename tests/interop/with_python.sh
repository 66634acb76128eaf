#!/bin/sh
# SPDX-License-Identifier: MIT
# compare_readers.sh PYTHON DUMP_MESH SHARED: runs compare_readers.py, or skips (77) where there is no such Python.
if ! [ -x "$1" ]; then
  echo "skipped: no $1 with the packages of tests/interop/requirements.txt"
  exit 77
fi
exec "$1" "$(dirname "$0")/compare_readers.py" "$2" "${MESHHOOD_SHARED:-$3}/meshes"
