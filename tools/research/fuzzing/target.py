# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""One fuzz target of libFuzzer: run for a time, its corpus kept small, what it says read."""

import os
import re
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

LIMITS = ("-timeout=10", "-rss_limit_mb=2048")
# What a target may take in the repository: its corpus is a start, not an archive.
MOST_FILES, MOST_BYTES = 16, 96 * 1024


@dataclass
class Figures:
    """What a run, or all of them, came to."""

    seconds: float = 0  # of processor time
    executions: int = 0
    edges: int = 0  # of the program's control flow, the most that one run reached

    def __add__(self, other):
        return Figures(self.seconds + other.seconds, self.executions + other.executions, max(self.edges, other.edges))


def figures_of(log, seconds):
    executions = re.search(r"^stat::number_of_executed_units: *(\d+)", log, re.MULTILINE)
    edges = re.findall(r"\bcov: (\d+)", log)
    return Figures(seconds, int(executions[1]) if executions else 0, int(edges[-1]) if edges else 0)


@dataclass
class Target:
    program: Path
    folder: Path  # logs, failures and corpora of all targets

    @property
    def name(self):
        return self.program.name

    @property
    def corpus(self):
        return self.folder / "corpus" / self.name

    @property
    def log(self):
        return self.folder / f"{self.name}.log"

    def run(self, seconds, seeds):
        """Its figures, or None where it has found an input that breaks it; the log names that file then."""
        self.corpus.mkdir(parents=True, exist_ok=True)
        for seed in seeds:
            shutil.copy(seed, self.corpus)
        words = [self.program, f"-max_total_time={seconds}", *LIMITS, "-print_final_stats=1", self.corpus]
        with self.log.open("w") as log:
            process = subprocess.Popen([str(word) for word in words], cwd=self.folder, stdout=log, stderr=subprocess.STDOUT)
            _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)  # or Popen waits for it, in vain
        if process.returncode != 0:
            return None
        return figures_of(self.log.read_text(errors="replace"), used.ru_utime + used.ru_stime)

    def smallest_corpus(self):
        """The fewest inputs that reach all that the corpus reaches, in a folder beside it."""
        merged = self.folder / "merged" / self.name
        shutil.rmtree(merged, ignore_errors=True)
        merged.mkdir(parents=True)
        subprocess.run([str(self.program), "-merge=1", *LIMITS, str(merged), str(self.corpus)], cwd=self.folder, check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)  # fmt: skip
        return sorted(merged.iterdir())


def within_budget(files, kept):
    """Those of `files`, the smallest first, that there is room for beside the `kept` ones, whose content is not kept already."""
    contents = {path.read_bytes() for path in kept}
    count, size = len(kept), sum(path.stat().st_size for path in kept)
    chosen = []
    for path in sorted(files, key=lambda path: (path.stat().st_size, path.name)):
        if path.read_bytes() in contents:
            continue
        count, size = count + 1, size + path.stat().st_size
        if count > MOST_FILES or size > MOST_BYTES:
            break
        chosen.append(path)
    return chosen
