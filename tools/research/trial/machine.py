# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""The machine of a trial, and what the trial may do there."""

from __future__ import annotations

import functools
import os
import platform
import shutil
import subprocess
from pathlib import Path


@functools.cache
def line() -> str:
    """Returns processor, cores, kernel and distribution in one line."""
    cpu = "unknown processor"
    virtual = False
    for entry in Path("/proc/cpuinfo").read_text().splitlines():
        if entry.startswith("model name"):
            cpu = entry.split(":", 1)[1].strip()
        if entry.startswith("flags"):
            virtual = "hypervisor" in entry.split()
    system = "unknown system"
    for entry in Path("/etc/os-release").read_text().splitlines():
        if entry.startswith("PRETTY_NAME="):
            system = entry.split("=", 1)[1].strip('"')
    where = ", virtual machine" if virtual else ""
    preemption = "PREEMPT_RT" if "PREEMPT_RT" in platform.version() else "no PREEMPT_RT"
    return f"{cpu}{where}, {len(os.sched_getaffinity(0))} cores; Linux {platform.release()} ({preemption}); {system}"


def is_root() -> bool:
    return os.geteuid() == 0


@functools.cache
def has_realtime_rights() -> bool:
    """True if a process may ask for SCHED_FIFO."""
    if shutil.which("chrt") is None:
        return False
    return subprocess.run(["chrt", "-f", "1", "true"], capture_output=True, check=False).returncode == 0


def lacks(*programs: str) -> str:
    """Returns a reason to skip that names those of these programs that are missing; empty if none
    is."""
    missing = [program for program in programs if shutil.which(program) is None]
    return f"not installed: {', '.join(missing)} (./tools/setup --trial)" if missing else ""


def load() -> str:
    """Returns the load averages of the last 1, 5 and 15 minutes."""
    return " ".join(f"{value:.1f}" for value in os.getloadavg())
