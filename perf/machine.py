# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The machine under the numbers: what it is, and what else it was doing."""
import os
import re
import time


def describe():
    """Processor, cores, kernel's name for it; a short name for its class."""
    info = {}
    try:
        with open("/proc/cpuinfo") as file:
            for line in file:
                key, _, value = line.partition(":")
                info.setdefault(key.strip(), value.strip())
    except OSError:
        pass
    model = info.get("model name", os.uname().machine)
    name = " ".join([model, info.get("cpu family", ""), info.get("model", "")])
    return {"processor": model, "family": info.get("cpu family", ""), "model": info.get("model", ""),
            "cores": len(os.sched_getaffinity(0)),
            "class": re.sub(r"[^a-z0-9]+", "-", name.lower()).strip("-")}


def _busy():
    """Seconds that all processors have worked (or were taken away by a host), and our share of them."""
    with open("/proc/stat") as file:
        t = [int(x) for x in file.readline().split()[1:]]
    user, nice, system, _idle, _wait, irq, softirq, steal = t[:8]
    own = os.times()
    return ((user + nice + system + irq + softirq + steal) / os.sysconf("SC_CLK_TCK"),
            own.user + own.system + own.children_user + own.children_system)


class Watch:
    """What others used of the machine, from its making to report(), in cores."""

    def __init__(self):
        self.load = os.getloadavg()[0]
        self.start = time.time()
        self.busy = _busy()

    def report(self):
        wall = time.time() - self.start
        busy = _busy()
        others = ((busy[0] - self.busy[0]) - (busy[1] - self.busy[1])) / wall
        others = max(0.0, others)
        return {"load_before": round(self.load, 2), "others_cores": round(others, 2),
                "minutes": round(wall / 60.0, 2), "trusted": others < 0.1}


def words(load):
    """One sentence on whether the numbers can be trusted."""
    used = f"other programs used {load['others_cores']:.2f} cores meanwhile (load {load['load_before']:.2f} before)"
    if load["trusted"]:
        return f"The machine was quiet: {used}."
    return f"The machine was busy, do not trust these numbers: {used}."


def short(machine):
    """A processor in a table's head."""
    return f"{machine['processor']} {machine['family']}/{machine['model']}, {machine['kernels']}"
