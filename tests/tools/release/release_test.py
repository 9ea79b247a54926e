# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""A release is made of what is committed and described, and of nothing else."""

import hashlib
import os
import shutil
import subprocess
import tarfile
import tempfile
import unittest
from pathlib import Path

RELEASE = Path(__file__).resolve().parents[3] / "tools/release"
CHANGELOG = "# Changelog\n\n## 0.3.0, 2026-12-01\n\n### Added\n- A page.\n\n## 0.2.0, 2026-11-23\n\n### Added\n- A word.\n"
# In place of what builds, packs and wraps: they leave files where those leave them.
CMAKE = "#!/bin/sh\n"
CPACK = '#!/bin/sh\nfor word; do folder=$word; done\nmkdir -p "$folder"\nfor old in 0.2.0 0.3.0; do echo deb >"$folder/terracut_${old}_amd64.deb"; done\n'
WHEEL = '#!/bin/sh\nfor word; do folder=$word; done\necho wheel >"$folder/terracut-0.3.0-cp311.whl"\n'


class Release(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.repository = Path(scratch.name) / "terracut"
        programs = Path(scratch.name) / "bin"
        self.environment = os.environ | {"PATH": f"{programs}:{os.environ['PATH']}", "GIT_CONFIG_GLOBAL": "/dev/null"}
        for place, text in (
            (programs / "cmake", CMAKE),
            (programs / "cpack", CPACK),
            (self.repository / "tools/wheel", WHEEL),
            (self.repository / "tools/release", RELEASE.read_text()),
            (self.repository / "CMakeLists.txt", "project(terracut VERSION 0.3.0 LANGUAGES CXX)\n"),
            (self.repository / "CHANGELOG.md", CHANGELOG),
            (self.repository / ".gitignore", "/build*/\n"),
        ):
            place.parent.mkdir(parents=True, exist_ok=True)
            place.write_text(text)
            place.chmod(0o755)
        self.git("init", "--quiet")
        self.commit()
        self.output = self.repository / "build/dist/0.3.0"

    def git(self, *words):
        identity = ("-c", "user.name=a", "-c", "user.email=a@b")
        return subprocess.run(["git", *identity, *words], cwd=self.repository, env=self.environment, check=True, capture_output=True, text=True).stdout

    def commit(self):
        self.git("add", "--all")
        self.git("commit", "--quiet", "--message", "a change")

    def release(self, *words):
        identity = {"GIT_COMMITTER_NAME": "a", "GIT_COMMITTER_EMAIL": "a@b"}
        return subprocess.run([self.repository / "tools/release", *words], env=self.environment | identity, capture_output=True, text=True)

    def refused(self, why):
        done = self.release("--make")
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn(why, done.stderr)
        self.assertFalse(self.output.exists())

    def test_says_what_it_would_make_and_makes_nothing(self):
        done = self.release()
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("v0.3.0", done.stdout)
        self.assertIn("### Added\n- A page.\n", done.stdout)
        self.assertNotIn("A word", done.stdout)
        self.assertFalse(self.output.exists())
        self.assertEqual(self.git("tag"), "")

    def test_makes_archive_packages_wheel_sums_notes_and_tag(self):
        done = self.release("--make")
        self.assertEqual(done.returncode, 0, done.stderr)
        made = {"terracut-0.3.0.tar.gz", "terracut_0.3.0_amd64.deb", "terracut-0.3.0-cp311.whl"}
        self.assertEqual({path.name for path in self.output.iterdir()}, made | {"SHA256SUMS", "notes.md"})
        sums = dict(line.split()[::-1] for line in (self.output / "SHA256SUMS").read_text().splitlines())
        self.assertEqual(sums, {name: hashlib.sha256((self.output / name).read_bytes()).hexdigest() for name in made})
        with tarfile.open(self.output / "terracut-0.3.0.tar.gz") as archive:
            self.assertIn("terracut-0.3.0/CMakeLists.txt", archive.getnames())
        self.assertEqual((self.output / "notes.md").read_text(), "### Added\n- A page.\n")
        self.assertEqual(self.git("tag", "--list", "--format=%(objecttype) %(contents)", "v0.3.0").strip(), "tag ### Added\n- A page.")
        self.assertEqual(self.git("status", "--porcelain"), "")

    def test_refuses_changes_that_are_not_committed(self):
        (self.repository / "new.txt").write_text("not committed")
        self.refused("new.txt")

    def test_refuses_a_version_that_changelog_does_not_describe(self):
        (self.repository / "CMakeLists.txt").write_text("project(terracut VERSION 0.4.0 LANGUAGES CXX)\n")
        self.commit()
        self.refused("'0.3.0, 2026-12-01'; the version in CMakeLists.txt is 0.4.0")

    def test_refuses_changes_that_are_described_as_unreleased(self):
        (self.repository / "CHANGELOG.md").write_text(CHANGELOG.replace("## 0.3.0", "## Unreleased\n\n### Fixed\n- A word.\n\n## 0.3.0"))
        self.commit()
        self.refused("'Unreleased'")

    def test_refuses_a_version_that_is_tagged(self):
        self.git("tag", "v0.3.0")
        self.refused("tagged already")

    def test_leaves_no_tag_where_the_build_fails(self):
        shutil.copy("/bin/false", Path(self.environment["PATH"].split(":")[0]) / "cmake")
        self.assertNotEqual(self.release("--make").returncode, 0)
        self.assertEqual(self.git("tag"), "")


if __name__ == "__main__":
    unittest.main()
