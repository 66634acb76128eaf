# SPDX-License-Identifier: MIT
"""The conditions of a measurement: the machine, and its load by other programs."""
import datetime
import os
import platform
import time

# Above this share of the processors, the machine counts as busy.
BUSY = 0.25
WAITED = 2  # seconds in which other programs are observed; the load average would include our own last run


class Watched:
    """The machine from now on. Loads are processors that others keep busy, on average."""

    def __init__(self):
        self.before = Usage().others_since(WAITED)
        self.begun = Usage()

    def description(self):
        """Call it when all started processes have ended: a running one would count as another program."""
        return {
            "processor": processor(),
            "processors": os.cpu_count(),
            "memory_gigabytes": round(os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 2**30),
            "python": platform.python_version(),
            "date": datetime.date.today().isoformat(),
            "load_before": self.before,
            "load_beside": self.begun.others_since(),
        }


class Usage:
    """Processor time that the machine has spent so far, and this process with its children."""

    def __init__(self):
        self.when = time.monotonic()
        self.all = busy_seconds()
        self.own = sum(os.times()[:4])

    def others_since(self, wait=0):
        time.sleep(wait)
        now = Usage()
        others = (now.all - self.all) - (now.own - self.own)
        return round(max(0, others) / (now.when - self.when), 2)


def busy_seconds():
    with open("/proc/stat", encoding="ascii") as lines:
        user, nice, system, _, _, *interrupts = map(int, lines.readline().split()[1:9])
    return (user + nice + system + sum(interrupts)) / os.sysconf("SC_CLK_TCK")


def processor():
    with open("/proc/cpuinfo", encoding="ascii", errors="replace") as lines:
        for line in lines:
            if line.startswith("model name"):
                return line.partition(": ")[2].strip()
    return platform.processor() or "unknown"


def is_busy(machine):
    return max(machine["load_before"], machine.get("load_beside", 0)) > BUSY * machine["processors"]


def caption(machine):
    """One sentence to go below a table."""
    beside = f" and {machine['load_beside']:g} during the run" if "load_beside" in machine else ""
    remark = " **The machine was busy: preliminary figures.**" if is_busy(machine) else ""
    return (f"{machine['processor']}, {machine['processors']} processors, {machine['memory_gigabytes']} GB, on"
            f" {machine['date']}. Load from other programs: {machine['load_before']:g} before{beside}.{remark}")
