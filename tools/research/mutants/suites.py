# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Builds the tree with the mistakes in it, and runs the suites that reach one."""

import json
import os
import re
import shutil
import signal
import subprocess
import time

LEFT_OUT = re.compile("slow|install")


class Failed(Exception):
    """The tree could not be built."""


class Suites:
    def __init__(self, tree, jobs):
        self.tree, self.jobs = tree, jobs
        self.folder = tree / "build/release"
        self.has_built = False

    def configure(self):
        # What no mistake touches comes from the cache of the tree itself.
        launcher = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
        subprocess.run(["cmake", "--preset", "release", *launcher], cwd=self.tree, check=True, stdout=subprocess.DEVNULL)

    def build(self):
        """Builds all. Returns the numbers of mistakes that do not compile; raises Failed for anything else."""
        built = subprocess.run(["ninja", "-C", self.folder, "-k0", f"-j{self.jobs}"], capture_output=True, text=True)
        self.has_built |= "ninja: no work to do." not in built.stdout
        if built.returncode == 0:
            return set()
        errors = [part for part in built.stdout.split("FAILED: ")[1:] if "error:" in part]
        numbers = {int(number) for part in errors for number in _planted_beside_errors(part)}
        if not numbers:
            raise Failed(f"the tree does not build:\n{built.stdout[-3000:]}")
        return numbers

    def names(self):
        """The suites that may be run for a mistake, in ctest's order."""
        listed = json.loads(self._ctest("--show-only=json-v1").stdout)
        names = []
        for test in listed["tests"]:
            facts = {fact["name"]: fact["value"] for fact in test.get("properties", [])}
            labels = facts.get("LABELS", [])
            if test.get("command") and not any(map(LEFT_OUT.search, labels)) and "FIXTURES_SETUP" not in facts:
                names.append(test["name"])
        return names

    def make_fixtures(self):
        self._ctest("-R", "ForTheOtherTests")

    def run(self, names, numbers=(), limit_s=200, reached=None):
        """Runs suites with these mistakes, stopping at the first that fails. Returns its name, or that none ended within the limit; None if
        all pass."""
        environment = dict(os.environ, TERRACUT_MUTANTS=",".join(map(str, numbers)), TERRACUT_SHARED=str(self.shared()))
        if reached is not None:
            environment["TERRACUT_MUTANTS_REACHED"] = str(reached)
        pattern = "^(" + "|".join(map(re.escape, names)) + ")$"
        try:
            done = self._ctest("-R", pattern, "-FA", ".*", "-j", str(self.jobs), "--stop-on-failure", environment=environment,
                               limit_s=limit_s)  # fmt: skip
        except subprocess.TimeoutExpired:
            return f"the limit of {limit_s:.0f} s"
        if done.returncode == 0:
            return None
        failed = re.findall(r"Test +#\d+: (\S+) \.*\*\*\*", done.stdout)
        return failed[0] if failed else names[0]

    def timed(self, name, reached):
        """How long a suite takes without a mistake; None if it fails."""
        begun = time.monotonic()
        failed = self.run([name], reached=reached)
        return None if failed else time.monotonic() - begun

    def shared(self):
        given = os.environ.get("TERRACUT_SHARED")
        return given or self.tree.parents[2] / "../shared"

    def _ctest(self, *options, environment=None, limit_s=None):
        # In a session of its own: what hangs is ended with all that it began. A suite's own limit is for slow machines.
        command = ["ctest", "--test-dir", self.folder, *options]
        with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment,
                              start_new_session=True) as process:  # fmt: skip
            try:
                out, err = process.communicate(timeout=limit_s)
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)
                raise
        return subprocess.CompletedProcess(command, process.returncode, out, err)


def _planted_beside_errors(text):
    """Numbers of mistakes in the source lines that GCC shows below its errors."""
    for part in text.split("error:")[1:]:
        yield from re.findall(r"planted\((\d+)\)", part)
