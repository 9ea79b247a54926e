# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""What tools/beside_peer makes of a peer's answers; the peers are made up here.

    beside_peer_test.py MADE_UP_PEER
"""
import importlib.util
import io
import sys
import tempfile
import unittest
from array import array
from contextlib import redirect_stderr
from importlib.machinery import SourceFileLoader
from pathlib import Path

PATH = Path(__file__).resolve().parents[3] / "tools/beside_peer"
loader = SourceFileLoader("beside_peer", str(PATH))
tool = importlib.util.module_from_spec(importlib.util.spec_from_loader("beside_peer", loader))
loader.exec_module(tool)

# Answers 1000 ns a scan; calls the first point of each ground.
PEER = f"""#!{sys.executable}
import struct, sys
repeat, labels, scans = int(sys.argv[1]), sys.argv[2], sys.argv[3:]
print("1000\\n" * (repeat * len(scans)), end="")
for n, scan in enumerate(scans):
    points = len(open(scan, "rb").read()) // 16
    if labels != "-":
        open(f"{{labels}}/{{n:06}}.label", "wb").write(struct.pack(f"{{points}}I", 40, *[50] * (points - 1)))
"""
ROLES = {40: "ground", 10: "key", 50: "ordinary"}


class BesidePeer(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.root = Path(self.folder.name)

    def peer(self, text):
        program = self.root / "peer"
        program.write_text(text)
        program.chmod(0o755)
        return tool.Peer(f"p={program}", None)

    def sequence(self, *scans):
        folder = self.root / "sequences" / "00"
        for number, classes in enumerate(scans):
            for kind, suffix, content in [("velodyne", "bin", bytes(16 * len(classes))),
                                          ("labels", "label", array("I", classes).tobytes())]:  # fmt: skip
                path = folder / kind / f"{number:06}.{suffix}"
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_bytes(content)
        return tool.Sequence(folder, self.root)

    def test_takes_a_time_for_every_scan_of_every_pass(self):
        times = self.peer(PEER).times(self.sequence([40], [40], [10]))
        self.assertEqual(times, [0.001] * 3 * tool.PASSES)

    def test_scores_the_labels_a_peer_writes(self):
        # 1 ground found, 1 missed, 1 key obstacle called ground, 1 not; a class without a role.
        iou, recall = self.peer(PEER).quality([self.sequence([40, 40, 10, 0], [10, 50])], ROLES, self.root)
        self.assertAlmostEqual(iou, 1 / 3)
        self.assertAlmostEqual(recall, 1 / 2)

    def test_a_peer_that_writes_no_labels_has_no_quality(self):
        self.assertEqual(self.peer("#!/bin/sh\n").quality([self.sequence([40])], ROLES, self.root), (None, None))

    def test_a_peer_that_does_not_answer_for_every_scan_is_refused(self):
        said = io.StringIO()
        for text in ["#!/bin/sh\necho 1000\n", "#!/bin/sh\nexit 3\n"]:
            with self.assertRaises(SystemExit), redirect_stderr(said):
                self.peer(text).times(self.sequence([40], [40]))

    def test_a_program_made_with_peer_program_hpp_is_such_a_peer(self):
        peer, sequence = tool.Peer(f"p={MADE_UP_PEER}", None), self.sequence([40, 40, 10, 10], [40, 50])
        self.assertEqual(len(peer.times(sequence)), 2 * tool.PASSES)
        self.assertEqual(peer.quality([sequence], ROLES, self.root), (0.5, 0.5))
        (sequence.scans[1]).write_bytes(bytes(17))
        with self.assertRaises(SystemExit) as refused:
            peer.times(sequence)
        self.assertIn("000001.bin: not a scan", str(refused.exception))

    def test_percentiles_are_of_the_nearest_rank(self):
        self.assertEqual(tool.percentile(range(1, 101), 99), 99)
        self.assertEqual(tool.percentile([5, 1], 99), 5)


if __name__ == "__main__":
    MADE_UP_PEER = sys.argv.pop()
    unittest.main()
