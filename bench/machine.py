# SPDX-License-Identifier: MIT
"""What a figure was measured on, for it means nothing without."""
import datetime
import os
import platform

# Above this share of the processors, somebody else was at work.
BUSY = 0.25


def describe():
    """Taken before the measuring begins, so that the load is that of the others."""
    return {
        "processor": processor(),
        "processors": os.cpu_count(),
        "memory_gigabytes": round(os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 2**30),
        "python": platform.python_version(),
        "date": datetime.date.today().isoformat(),
        "load_before": round(os.getloadavg()[0], 2),
    }


def processor():
    with open("/proc/cpuinfo", encoding="ascii", errors="replace") as lines:
        for line in lines:
            if line.startswith("model name"):
                return line.partition(": ")[2].strip()
    return platform.processor() or "unknown"


def is_busy(machine):
    return machine["load_before"] > BUSY * machine["processors"]


def caption(machine):
    """One sentence for under a table."""
    remark = " **The machine was busy: preliminary figures.**" if is_busy(machine) else ""
    return (f"{machine['processor']}, {machine['processors']} processors, {machine['memory_gigabytes']} GB, on"
            f" {machine['date']}, load {machine['load_before']:g} when it began.{remark}")
