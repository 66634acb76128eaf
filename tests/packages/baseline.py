#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks that libraries for x86_64 use instructions beyond those of every such processor only where the processor was
asked before: in the kernels, whose namespaces are named after the target.

    baseline.py ARCHIVE...
"""

import collections
import re
import subprocess
import sys

# Vectors of AVX and beyond, whose names begin with v; those of SSE3 to SSE4.2; and the bit instructions, without tzcnt,
# which older processors take for bsf, and compilers use where both give the same.
BEYOND = re.compile(
    r"\t(v[a-z]\w+|k(mov|or|and|xor|not|unpck|shift|test|add)\w*|movddup|movs[lh]dup|lddqu|pshufb|pabs[bwd]|palignr"
    r"|ph(add|sub)\w+|pmulhrsw|psign[bwd]|pmaddubsw|pblend\w+|blend\w+|pmov[sz]x\w+|ptest|round[sp][sd]|pcmpeqq|pcmpgtq|packusdw|pmulld"
    r"|pmuldq|p(min|max)(s[bd]|u[wd])|insertps|extractps|p(insr|extr)[bdq]|pcmp[ei]str[im]|movntdqa|crc32\w*"
    r"|popcnt|lzcnt|andn|bextr|bls(i|r|msk)|bzhi|mulx|p(dep|ext)|rorx|s(ar|hl|hr)x)\b"
)
FUNCTION = re.compile(r"^[0-9a-f]+ <(.*)>:$")
KERNELS = re.compile(r"N_(SSE4|AVX2|AVX3)")


def main():
    counts = collections.Counter()
    wrong = collections.Counter()
    for archive in sys.argv[1:]:
        text = subprocess.run(
            ["objdump", "--disassemble", "--no-show-raw-insn", archive], check=True, capture_output=True, text=True
        ).stdout
        function = ""
        for line in text.splitlines():
            if named := FUNCTION.match(line):
                function = named[1]
            elif found := BEYOND.search(line):
                target = KERNELS.search(function)
                counts[target[1] if target else "all processors"] += 1
                if not target:
                    wrong[function, found[1]] += 1
    print("instructions beyond the baseline:", dict(counts))
    for (function, instruction), count in wrong.most_common(20):
        print(f"  {function}: {instruction}, {count} times")
    # The kernels must be there, or this looked at the wrong files.
    return 1 if wrong or not all(counts[target] for target in ("SSE4", "AVX2", "AVX3")) else 0


sys.exit(main())
