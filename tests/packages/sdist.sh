#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes the source package, and installs it as pip does where there is no wheel: into an empty environment, with what
# pyproject.toml needs from PyPI, and the compiler and the libraries of this machine.
# Usage: sdist.sh REPOSITORY
set -euo pipefail
cd "$1"
python=$PWD/build/venv/bin/python3 packages=$PWD/build/packages
rm -f "$packages"/meshhood-*.tar.gz
"$python" -m build --sdist --outdir "$packages" . >/dev/null
archive=$(ls "$packages"/meshhood-*.tar.gz)
tar --list --file "$archive" >"$packages/sdist.txt"
if grep --extended-regexp '^[^/]+/(bench|docs|fuzz|packaging|tests|\.)' "$packages/sdist.txt"; then
  echo "these do not belong into the source package"
  exit 1
fi
for file in README.md LICENSE NOTICE PKG-INFO build/viewer/viewer.html; do
  grep --quiet "^meshhood-[^/]*/$file\$" "$packages/sdist.txt"
done
"$python" -m twine check --strict "$archive"
stat --format='%n: %s bytes' "$archive"

folder=$packages/installed/sdist
rm -rf "$folder"
"$python" -m venv "$folder"
unset CMAKE_CXX_COMPILER_LAUNCHER CMAKE_C_COMPILER_LAUNCHER # what a user spends
TIMEFORMAT='installed in %U + %S seconds of processor time'
time "$folder/bin/python3" -m pip install --quiet --disable-pip-version-check "$archive"
MESHHOOD_PROGRAM=none "$folder/bin/python3" "tests/packages/installed_wheel.py"
