#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The libraries keep no state between calls but what is named here. Names of constants begin with k; what the standard
library instantiates is not looked at.

    no_global_state.py ARCHIVE...
"""
import re
import subprocess
import sys

KNOWN = {
    "most_isa": "the kernels that tests and benchmarks choose",
    "of_processor": "what the processor can do, asked once",
    "serial": "a number for the name of the next temporary file",
    "current": "of each thread: the call that a slow reader waits for",
}
NAME = re.compile(r"^(?:guard variable for )?meshhood::(?:.*::)?(\w+)(?:<.*>)?$")

seen, faults = set(), []
for archive in sys.argv[1:]:
    table = subprocess.run(["nm", "-C", archive], capture_output=True, text=True, check=True).stdout
    for name in re.findall(r"^[0-9a-f]+ [bBdDuV] (.*)$", table, re.M):
        if match := NAME.match(name):
            seen.add(match[1])
            if match[1] not in KNOWN and not re.match(r"k[A-Z]", match[1]):
                faults.append(f"{archive}: {name} is kept between calls")
faults += [f"{name} is named, but no archive has it: {why}" for name, why in KNOWN.items() if name not in seen]
print("\n".join([*faults, f"{len(seen)} names of data in {len(sys.argv) - 1} archives, {len(faults)} faults"]))
sys.exit(1 if faults or not seen else 0)
