# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""What tools/beside_peer makes of a peer's answers; the peers are made up here, and so is where they come from.

    beside_peer_test.py MADE_UP_PEER MADE_UP_OBJECT_PEER OBJECT_ENTROPIES
"""

import io
import json
import math
import os
import struct
import subprocess
import sys
import tempfile
import unittest
from array import array
from contextlib import redirect_stderr
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "tools/research"))

from peers import main as tool  # noqa: E402
from peers.drives import Drive, kitti_scan, roles  # noqa: E402
from peers.hazards import Found, Scans, counted, disturbance_rows, hazard_rows  # noqa: E402
from peers.objects import NAMES, beside, rows  # noqa: E402
from peers.programs import FROM_PACKETS, PASSES, Peer  # noqa: E402
from peers.sources import PeerSource, Source, Unavailable, build, fetch  # noqa: E402

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


class InAFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)


class Answers(InAFolder):
    def peer(self, text):
        program = self.root / "peer"
        program.write_text(text)
        program.chmod(0o755)
        return Peer("p", program, None)

    def drive(self, *scans):
        drive = Drive("recorded", "00", self.root)
        for number, classes in enumerate(scans):
            drive.scans.append(self.root / f"{number:06}.bin")
            drive.truth.append(self.root / f"{number:06}.truth")
            drive.scans[-1].write_bytes(bytes(16 * len(classes)))
            drive.truth[-1].write_bytes(array("I", classes).tobytes())
        return drive

    def score(self, peer, drive):
        labels = self.root / "labels"
        peer.label(drive, labels)
        return drive.score(labels, roles())

    def test_a_time_for_every_scan_of_every_pass_is_taken(self):
        self.assertEqual(self.peer(PEER).times(self.drive([40], [40], [10])), {"p": [0.001] * 3 * PASSES})

    def test_the_labels_a_peer_writes_are_scored(self):
        # 1 ground found, 1 missed, 1 car called ground, 1 not; 0 counts nowhere; instances do not matter.
        iou, recall = self.score(self.peer(PEER), self.drive([40, 72, 10 | 7 << 16, 0], [10, 50]))
        self.assertAlmostEqual(iou, 1 / 3)
        self.assertAlmostEqual(recall, 1 / 2)

    def test_a_peer_that_writes_no_labels_has_no_quality(self):
        self.assertEqual(self.score(self.peer("#!/bin/sh\n"), self.drive([40])), (None, None))

    def test_a_peer_that_does_not_answer_for_every_scan_is_refused(self):
        for text in ["#!/bin/sh\necho 1000\n", "#!/bin/sh\nexit 3\n"]:
            with self.assertRaises(SystemExit), redirect_stderr(io.StringIO()):
                self.peer(text).times(self.drive([40], [40]))

    def test_a_program_made_with_peer_program_hpp_is_such_a_peer(self):
        peer, drive = Peer("p", MADE_UP_PEER, None), self.drive([40, 40, 10, 10], [40, 50])
        self.assertEqual(len(peer.times(drive)["p"]), 2 * PASSES)
        self.assertEqual(self.score(peer, drive), (0.5, 0.5))
        drive.scans[1].write_bytes(bytes(17))
        with self.assertRaises(SystemExit) as refused:
            peer.times(drive)
        self.assertIn("000001.bin: not a scan", str(refused.exception))


class Hazards(InAFolder):
    """The made-up peer calls the first point of each scan ground, everything else obstacle."""

    HAZARD = 99 | 1 << 16

    def found(self, *scans):
        """Scans are (what they show, true classes)."""
        folder = self.root / "hazards"
        for kind in ("velodyne", "labels"):
            (folder / "sequences/00" / kind).mkdir(parents=True)
        shown = []
        for number, (what, classes) in enumerate(scans):
            shown.append({"sequence": "00", "scan": f"{number:06}"} | what)
            (folder / f"sequences/00/velodyne/{number:06}.bin").write_bytes(bytes(16 * len(classes)))
            (folder / f"sequences/00/labels/{number:06}.label").write_bytes(array("I", classes).tobytes())
        (folder / "hazards.json").write_text(json.dumps({"scans": shown}))
        program = self.root / "peer"
        program.write_text(PEER)
        program.chmod(0o755)
        found = Found()
        found.label(Peer("p", program, None), Scans(folder), self.root / "labels", roles())
        return found

    def test_a_hazard_is_found_by_two_returns_and_thirty_percent_of_them(self):
        child = {"what": "child", "ground": "road", "from_m": 5, "to_m": 10}
        found = self.found((child, [40, 40] + 4 * [self.HAZARD]), (child, [self.HAZARD, 40]), (child, [40, self.HAZARD]))
        self.assertEqual(found.trials["child", "road", 5, 10], {"trials": 3, "found": 1, "unseen": 1})
        self.assertEqual(dict(hazard_rows([found])), {"child, road, 5 to 10 m (3)": ["33 / 33"]})
        self.assertEqual(counted(["p"], [found]), [child | {"of": {"p": {"trials": 3, "found": 1, "unseen": 1}}}])

    def test_a_disturbance_is_scored_where_nothing_moved(self):
        found = self.found(({"what": "ghosts_1"}, [40, 40, 0, 10]), ({"what": ""}, [40, 10]))
        rows = dict(disturbance_rows([found], roles(), lambda scores: scores))
        self.assertEqual(rows, {"ghosts_1": [[(0.5, 1.0)]], "nothing": [[(1.0, 1.0)]]})


class Objects(InAFolder):
    """A car of 10 returns and a person of 10, whom the made-up peer cuts in two: it finds an object a metre of x. A return of the
    road is taken for an obstacle, in the car's object; an unlabelled one does not matter."""

    CAR, PERSON = 10 | 1 << 16, 30 | 2 << 16
    POINTS = (  # x, entry of the truth, label by terracut
        *zip([0.05 * i for i in range(10)], [CAR] * 10, [99] * 10),
        *zip([5 + 0.2 * i for i in range(10)], [PERSON] * 10, [99] * 10),
        (0.5, 40, 99),
        (0.6, 0, 99),
        (5.1, 40, 40),
    )
    # As the made-up peer finds them.
    COUNTED = {
        "frames": 1,
        "milliseconds": 0.5,
        "ose": {"mean": math.log(2), "deviation": 0.0},
        "use": {"mean": -sum(share * math.log(share) for share in (10 / 12, 2 / 12)), "deviation": 0.0},
        "instances": [
            {"kind": "cars", "instances": 1, "found": 1, "false_objects": 0, "pq": 10 / 11},
            {"kind": "persons", "instances": 1, "found": 0, "false_objects": 2, "pq": 0.0},
            {"kind": "two-wheelers", "instances": 0, "found": 0, "false_objects": 0, "pq": None},
        ],
    }

    class Terracut:
        """Labels as POINTS say and finds what the made-up peer finds; counts as told."""

        def __init__(self, counted):
            self.counted = counted

        def run(self, command, *arguments):
            after = dict(zip(arguments, arguments[1:]))
            if command == "segment":
                labels = [label | (int(x) + 1) << 16 if label == 99 else label for x, _, label in Objects.POINTS]
                after["--labels"].mkdir(parents=True)
                (after["--labels"] / "000007.label").write_bytes(array("I", labels).tobytes())
            else:
                none = {"frames": 0}
                after["--json"].write_text(json.dumps({"methods": {"m": {"objects": {"tuned": self.counted, "unseen": none}}}}))

    def beside(self, counted):
        folder = self.root / "root/sequences/00"
        for kind in ("velodyne", "labels"):
            (folder / kind).mkdir(parents=True)
        points = array("f", [value for x, _, _ in self.POINTS for value in (x, 0, 0, 0)])
        (folder / "velodyne/000007.bin").write_bytes(points.tobytes())
        (folder / "labels/000007.label").write_bytes(array("I", [true for _, true, _ in self.POINTS]).tobytes())
        scratch = self.root / "scratch"
        scratch.mkdir()
        peers = [Peer("p", MADE_UP_OBJECT_PEER, None)]
        return beside(self.Terracut(counted), peers, [Path(OBJECT_ENTROPIES)] * 2, [self.root / "root"], scratch)

    def test_numbers_go_to_the_peer_and_back_and_are_scored(self):
        (ours, peer), difference = self.beside(self.COUNTED)
        self.assertEqual(difference, 0)
        self.assertEqual(ours.entropies, peer.entropies)
        self.assertEqual(ours.ms["tuned"], [0.5])
        cells = dict(zip(NAMES, dict(rows([ours, peer]))["p"]))
        self.assertEqual(cells["OSE"], "0.7 (0.0) / -")
        self.assertEqual(cells["USE"], "0.5 (0.0) / -")
        self.assertEqual(cells["in objects, %"], "100 / -")
        self.assertEqual(cells["cars: PQ, recall"], "90.9, 100.0 / -")
        self.assertEqual(cells["persons: PQ, recall"], "0.0, 0.0 / -")
        self.assertEqual(cells["two-wheelers: PQ, recall"], "- / -")

    def test_another_count_by_terracut_is_refused(self):
        with self.assertRaises(SystemExit) as refused:
            self.beside(self.COUNTED | {"use": {"mean": 0.4, "deviation": 0.0}})
        self.assertIn("tuned: mean of USE 0.400, not 0.451", str(refused.exception))


class Clouds(unittest.TestCase):
    def test_a_decoded_frame_becomes_a_scan_in_the_sensors_frame(self):
        header = b"# .PCD v0.7\nFIELDS x y z intensity ring label\nSIZE 4 4 4 4 2 2\nDATA binary\n"
        scan = array("f", kitti_scan(header + struct.pack("<4f2H", 10, -2, 0.73, 51, 63, 40)))
        self.assertEqual([round(value, 5) for value in scan], [10, -2, -1, 0.2])

    def test_a_cloud_of_other_fields_is_refused(self):
        with self.assertRaises(SystemExit):
            kitti_scan(b"FIELDS x y z\nSIZE 4 4 4\nDATA binary\n" + bytes(12))


class Tables(unittest.TestCase):
    def test_rows_are_drives_and_all_drives_of_a_group(self):
        samples = {"a": {FROM_PACKETS: [2.0, 2.0], "p": [4.0, 6.0]}, "b": {FROM_PACKETS: [4.0], "p": [1.0]}}
        rows = dict(tool.time_rows({"recorded": ["a", "b"]}, [FROM_PACKETS, "p"], samples))
        self.assertEqual(rows["a"], ["2.00 / 2.00 (x 1.00)", "5.00 / 6.00 (x 2.50)"])
        self.assertEqual(rows["**recorded, all**"], ["2.00 / 4.00 (x 1.00)", "4.00 / 6.00 (x 2.00)"])
        quality = {"a": {"p": (0.5, None)}, "b": {"p": (1.0, 0.25)}}
        rows = dict(tool.quality_rows({"recorded": ["a", "b"]}, ["p"], quality))
        self.assertEqual(rows, {"a": ["50.0 / -"], "b": ["100.0 / 25.0"], "**recorded, mean**": ["75.0 / 25.0"]})

    def test_percentiles_are_of_the_nearest_rank(self):
        self.assertEqual(tool.percentile(range(1, 101), 99), 99)
        self.assertEqual(tool.percentile([5, 1], 99), 5)


class Arguments(unittest.TestCase):
    def test_peers_are_chosen_by_names_that_exist(self):
        self.assertEqual(tool.arguments(["--only", "FugSeg,TRAVEL"]).only, ["FugSeg", "TRAVEL"])
        self.assertEqual(tool.arguments(["--only", ""]).only, [])
        with self.assertRaises(SystemExit), redirect_stderr(io.StringIO()) as said:
            tool.arguments(["--only", "FugSeg,Nobody"])
        self.assertIn("there is no peer Nobody", said.getvalue())


class Sources(InAFolder):
    """A repository of GitHub's, made up: git is told that it lies in a folder."""

    def setUp(self):
        super().setUp()
        self.upstream = self.root / "upstream"
        (self.upstream / "core").mkdir(parents=True)
        (self.upstream / "core/method.cpp").write_text("int answer() { return 42; }\n")
        (self.upstream / "film.gif").write_text("large")
        git = ["git", "-C", self.upstream, "-c", "user.name=n", "-c", "user.email=e"]
        for command in (["init", "-q"], ["add", "."], ["commit", "-qm", "first"]):
            subprocess.run([*git, *command], check=True)
        commit = subprocess.run([*git, "rev-parse", "HEAD"], check=True, capture_output=True, text=True).stdout.strip()
        self.source = Source("somebody/method", commit, "core")
        settings = {"uploadpack.allowFilter": "true", "uploadpack.allowAnySHA1InWant": "true", "safe.directory": "*",
                    f"url.file://{self.upstream}.insteadOf": "https://github.com/somebody/method"}  # fmt: skip
        home = {"HOME": str(self.root), "GIT_CONFIG_NOSYSTEM": "1"}
        before = {name: os.environ.get(name) for name in home}
        self.addCleanup(lambda: [os.environ.pop(n) if v is None else os.environ.update({n: v}) for n, v in before.items()])
        os.environ.update(home)
        for name, value in settings.items():
            subprocess.run(["git", "config", "--global", name, value], check=True)

    def test_code_is_fetched_at_its_commit_without_what_is_not_built(self):
        fetch(self.source, self.root / "peers")
        place = self.root / "peers/method"
        self.assertTrue((place / "core/method.cpp").is_file())
        self.assertFalse((place / "film.gif").exists())

    def test_what_was_fetched_is_not_asked_for_again(self):
        fetch(self.source, self.root / "peers")
        self.upstream.rename(self.root / "gone")
        fetch(self.source, self.root / "peers")

    def test_why_a_peer_cannot_be_had_is_said(self):
        absent = Source("somebody/method", "0" * 40, "core")
        with self.assertRaisesRegex(Unavailable, "somebody/method@0000000 cannot be fetched: "):
            build(PeerSource("m", "MIT", (absent,), "none.cpp"), self.root / "peers")
        with self.assertRaisesRegex(Unavailable, "m cannot be built: .*none.cpp"):
            build(PeerSource("m", "MIT", (self.source,), "none.cpp"), self.root / "peers")
        with self.assertRaisesRegex(Unavailable, "/absent.hpp is missing; ./tools/setup --peers installs it"):
            build(PeerSource("m", "MIT", (self.source,), "none.cpp", needs="/absent.hpp"), self.root / "peers")


if __name__ == "__main__":
    MADE_UP_PEER, MADE_UP_OBJECT_PEER, OBJECT_ENTROPIES = sys.argv[-3:]
    del sys.argv[-3:]
    unittest.main()
