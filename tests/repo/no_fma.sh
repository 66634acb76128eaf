#!/bin/sh
# SPDX-License-Identifier: MIT
# No fused multiply-add in the object files given, for it would round distances differently from machine to machine.
# And one in the first of them, which is compiled to have it: else the search itself would be blind.
set -eu

fused() {
  objdump --disassemble --no-show-raw-insn "$1" | grep -cE '\bv?fn?m(add|sub)' || true
}

control=$1
shift
if [ "$(fused "$control")" -eq 0 ]; then
  echo "no fused multiply-add in the control $control: the search is blind" >&2
  exit 1
fi
for object in "$@"; do
  if [ "$(fused "$object")" -ne 0 ]; then
    echo "$object: $(fused "$object") fused multiply-adds" >&2
    exit 1
  fi
done
echo "$# object files, no fused multiply-add"
