# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""A network of a test's own: its ports are free, and nothing leaves the machine."""

import os
import shlex
import subprocess
import sys


def in_own_network() -> bool:
    """Goes on in a network with nothing but a loopback interface; False where the system does not allow that."""
    if os.environ.get("TERRACUT_OWN_NETWORK"):
        return True
    begin = ["unshare", "--user", "--map-root-user", "--net"]
    up = "ip link set lo up && exec "
    try:
        allowed = subprocess.run([*begin, "sh", "-c", up + "true"], capture_output=True, check=False).returncode == 0
    except FileNotFoundError:
        return False
    if allowed:
        os.environ["TERRACUT_OWN_NETWORK"] = "1"
        os.execvp(begin[0], [*begin, "sh", "-c", up + shlex.join([sys.executable, *sys.argv])])
    return False


def skip_without_own_network():
    if not in_own_network():
        print("skipped: no network of its own is to be had here (unshare, iproute2)")
        sys.exit(0)
