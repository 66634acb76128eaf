#!/bin/sh
# SPDX-License-Identifier: MIT
# The breadth-first search and the search along paths prefetch. g++ 12 treated a function that only prefetches as one without effect and removed
# its calls, which made cold queries up to 1.7 times as slow and changed no answer (see src/base/prefetch.h). The
# arguments are object files of the library, compiled with optimization for x86-64.
set -eu

for class in ReferenceSearcher PathSearch; do
  found=$(objdump --disassemble --demangle --no-show-raw-insn "$@" |
    awk -v class="$class::" '/^[0-9a-f]+ </ { inside = index($0, class) } inside && /\tprefetch/ { ++found }
                             END { print found + 0 }')
  if [ "$found" -eq 0 ]; then
    echo "no prefetch in $class" >&2
    exit 1
  fi
  echo "$found prefetches in $class"
done
