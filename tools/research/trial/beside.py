# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""The programs beside a trial: cyclictest measures the machine, stress-ng loads it."""

from __future__ import annotations

import os
import re
import signal
import subprocess
from pathlib import Path

from . import machine

# Lies between the priorities of the segmenting and the receiving thread, so that cyclictest is
# delayed as they are.
CYCLICTEST_PRIORITY = 75
LONGEST_US = 200_000


class CyclicTest:
    """Measures the wake-up delays of a thread that sleeps 1 ms at a time, in the same minutes."""

    def __init__(self, seconds: float):
        self.process: subprocess.Popen | None = None
        self.reason = machine.lacks("cyclictest")
        if not self.reason and not machine.has_realtime_rights():
            self.reason = "no right to SCHED_FIFO"
        if self.reason:
            return
        command = ["timeout", "--foreground", "-k", "5", str(int(seconds) + 120), "cyclictest", "-q", "-m", "-p",
                   str(CYCLICTEST_PRIORITY), "-i", "1000", "-D", str(int(seconds)), "-h", str(LONGEST_US)]  # fmt: skip
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)

    def result(self) -> str:
        """Returns p99.9 and maximum, or why there is none."""
        if self.process is None:
            return self.reason
        output, _ = self.process.communicate()
        counts = [(int(us), int(count)) for us, count in re.findall(r"^(\d{6}) (\d+)$", output, re.MULTILINE)]
        longest = re.search(r"^# Max Latencies: (\d+)", output, re.MULTILINE)
        total = sum(count for _, count in counts)
        if not total or not longest:
            return "cyclictest gave no histogram"
        left, p999 = total / 1000, LONGEST_US
        for us, count in reversed(counts):
            left -= count
            p999 = us
            if left < 0:
                break
        return f"p99.9 {p999 / 1000:.2f} ms, max {int(longest[1]) / 1000:.2f} ms"


class Stress:
    """Loads every core, at normal priority: computes, moves memory and writes to the disk."""

    def __init__(self, scratch: Path, seconds: float):
        folder = scratch / "stress"
        folder.mkdir(exist_ok=True)
        cores = str(os.cpu_count())
        self.command = ["stress-ng", "--cpu", cores, "--vm", cores, "--vm-bytes", "40%", "--hdd", cores,
                        "--hdd-bytes", "256M", "--temp-path", str(folder), "--timeout", f"{int(seconds)}s",
                        "--quiet"]  # fmt: skip
        self.process = subprocess.Popen(self.command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def stop(self) -> None:
        """Ends stress-ng with its workers."""
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
        self.process.wait(timeout=60)
