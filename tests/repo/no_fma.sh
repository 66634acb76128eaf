#!/bin/sh
# SPDX-License-Identifier: MIT
# The given object files have no fused multiply-add, which would round distances differently on different machines. The
# first file is a control: it is compiled to have one, which shows that this script finds them.
set -eu

fused() {
  objdump --disassemble --no-show-raw-insn "$1" | grep -cE '\bv?fn?m(add|sub)' || true
}

control=$1
shift
if [ "$(fused "$control")" -eq 0 ]; then
  echo "no fused multiply-add found in the control $control: this check does not work" >&2
  exit 1
fi
for object in "$@"; do
  if [ "$(fused "$object")" -ne 0 ]; then
    echo "$object: $(fused "$object") fused multiply-adds" >&2
    exit 1
  fi
done
echo "$# object files, no fused multiply-add"
