# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""The wheel of ./tools/wheel has within what the module needs, and says truly what it holds and where it runs.

wheel_test.py REPOSITORY BUILD
"""

import base64
import hashlib
import os
import platform
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

REPOSITORY, BUILD = sys.argv[1:3]
LABELS_A_FRAME = """
import os, re, terracut
print(next(terracut.replay(os.environ["TERRACUT_DRIVE"])))
print(set(re.findall(r"/\\S+\\.so\\S*", open("/proc/self/maps").read())))
"""
DEPENDENCIES = ("fmt", "pcap", "png16", "pugixml", "yaml-cpp", "zstd")


def main() -> int:
    if not shutil.which("patchelf"):
        print("skipped: patchelf is not installed")
        return 0
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([Path(REPOSITORY) / "tools/wheel", "--build", BUILD, "--output", folder], check=True)
        (wheel,) = Path(folder).glob("*.whl")
        python, glibc = "".join(platform.python_version_tuple()[:2]), platform.libc_ver()[1].replace(".", "_")
        expected = rf"terracut-[0-9.]+-cp{python}-cp{python}-manylinux_{glibc}_{platform.machine()}\.whl"
        assert re.fullmatch(expected, wheel.name), wheel.name

        site = Path(folder) / "site"
        with zipfile.ZipFile(wheel) as archive:
            archive.extractall(site)
        (record,) = site.glob("*.dist-info/RECORD")
        listed = dict(line.rsplit(",", 2)[:2] for line in record.read_text().splitlines())
        for path in (path for path in site.rglob("*") if path.is_file() and path != record):
            digest = base64.urlsafe_b64encode(hashlib.sha256(path.read_bytes()).digest()).rstrip(b"=").decode()
            assert listed.pop(path.relative_to(site).as_posix()) == f"sha256={digest}", path
        assert list(listed) == [record.relative_to(site).as_posix()], listed

        said = subprocess.run(
            [sys.executable, "-c", LABELS_A_FRAME], check=True, capture_output=True, text=True, cwd=folder,
            env=os.environ | {"PYTHONPATH": str(site)},
        ).stdout  # fmt: skip
        assert "returns" in said, said
        for name in DEPENDENCIES:
            loaded = re.findall(rf"'(/[^']*/lib{name}[-.][^']*)'", said)
            assert loaded and all(path.startswith(str(site)) for path in loaded), f"lib{name}: {loaded}\n{said}"
            assert list(site.glob(f"*.dist-info/licenses/lib{name}*")), f"no copyright notice of lib{name}"
    return 0


sys.exit(main())
