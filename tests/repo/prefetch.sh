#!/bin/sh
# SPDX-License-Identifier: MIT
# The breadth-first search prefetches. g++ 12 treated a function that only prefetches as one without effect and removed
# its calls, which made cold queries up to 1.7 times as slow and changed no answer (see src/base/prefetch.h). The
# arguments are object files of the library, compiled with optimization for x86-64.
set -eu

found=$(objdump --disassemble --demangle --no-show-raw-insn "$@" |
  awk '/^[0-9a-f]+ </ { inside = /ReferenceSearcher::/ } inside && /\tprefetch/ { ++found } END { print found + 0 }')
if [ "$found" -eq 0 ]; then
  echo "no prefetch in the breadth-first search" >&2
  exit 1
fi
echo "$found prefetches in the breadth-first search"
