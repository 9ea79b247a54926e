#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""A fleet labelled by Slurm on two nodes, both on this machine, of which one is killed in the middle.

slurm_test.py REPOSITORY PROGRAM WORK_FOLDER

An array of twelve shards over simulated and recorded drives of HDL-64E and RS-Ruby128, one input cut short and one missing; a
slurmd and a task are killed with -9. Every good drive's labels have to be those of `terracut replay` or `segment`, the bad ones
named, and the same submission again, or GNU parallel, does only what is missing. The daemons are this test's own: their ports,
keys and folders are.
"""

import contextlib
import hashlib
import json
import os
import shutil
import signal
import socket
import subprocess
import sys
import threading
import time
from pathlib import Path

SHARDS = 12
PATIENCE_S = 100
NEEDED = ("sbatch", "squeue", "slurmctld", "slurmd", "munged")
HELD_S = 2.5


def pause():
    """Between two looks at what Slurm does; nothing is concluded from how long that takes."""
    time.sleep(0.1)


def wait_for(what, is_so):
    end = time.monotonic() + PATIENCE_S
    while not is_so():
        if time.monotonic() > end:
            raise TimeoutError(f"{what} has not come about within {PATIENCE_S} s")
        pause()


def free_ports(count):
    with contextlib.ExitStack() as stack:
        sockets = [stack.enter_context(socket.socket()) for _ in range(count)]
        for one in sockets:
            one.bind(("127.0.0.1", 0))
        return [one.getsockname()[1] for one in sockets]


class Cluster:
    """A controller and two nodes of one core each."""

    def __init__(self, folder: Path):
        self.folder = folder
        self.processes = {}
        self.control, *self.nodes = free_ports(3)
        for name in ("state", "n1", "n2", "munge"):
            (folder / name).mkdir(parents=True, mode=0o755)
        (folder / "munge/key").write_bytes(os.urandom(128))
        (folder / "munge/key").chmod(0o600)
        host = socket.gethostname().split(".")[0]
        # A node that is silent for 5 s is down; its jobs may begin again when their credentials, 10 s, are void.
        (folder / "slurm.conf").write_text(f"""
ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={self.control}
SlurmUser=root
AuthType=auth/munge
CredType=cred/munge
AuthInfo=socket={folder}/munge/socket,cred_expire=10
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.%n.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
MpiDefault=none
SlurmdTimeout=5
ReturnToService=2
KillWait=5
SchedulerParameters=sched_interval=1,bf_interval=1
SlurmdParameters=config_overrides
NodeName=n1 NodeHostname={host} NodeAddr=127.0.0.1 Port={self.nodes[0]} CPUs=1 RealMemory=4000
NodeName=n2 NodeHostname={host} NodeAddr=127.0.0.1 Port={self.nodes[1]} CPUs=1 RealMemory=4000
PartitionName=all Nodes=n1,n2 Default=YES MaxTime=INFINITE State=UP
""")
        self.environment = os.environ | {"SLURM_CONF": str(folder / "slurm.conf")}

    def run(self, *words, **more):
        return subprocess.run(words, env=self.environment | more, check=True, text=True, stdout=subprocess.PIPE).stdout

    def start(self, name, *words):
        log = open(self.folder / f"{name}.out", "a")
        self.processes[name] = subprocess.Popen(words, env=self.environment, stdout=log, stderr=log, start_new_session=True)

    def start_node(self, name):
        self.start(name, "slurmd", "-D", "-N", name, "-f", str(self.folder / "slurm.conf"))

    def __enter__(self):
        munge = self.folder / "munge"
        self.start("munged", "munged", "--foreground", "--force", f"--socket={munge}/socket", f"--key-file={munge}/key",
                   f"--pid-file={munge}/pid", f"--log-file={munge}/log", f"--seed-file={munge}/seed")
        wait_for("a munged", (munge / "socket").exists)
        self.start("slurmctld", "slurmctld", "-D", "-f", str(self.folder / "slurm.conf"))
        self.start_node("n1")
        self.start_node("n2")
        wait_for("two idle nodes", lambda: self.states() == {"idle": 2})
        return self

    def __exit__(self, *_):
        with contextlib.suppress(subprocess.CalledProcessError):
            self.run("scancel", "--user=root")
        for process in reversed(self.processes.values()):
            process.terminate()
        for process in self.processes.values():
            with contextlib.suppress(subprocess.TimeoutExpired):
                process.wait(10)
            process.kill()

    def states(self):
        with contextlib.suppress(subprocess.CalledProcessError):
            count = {}
            for state in self.run("sinfo", "--noheader", "--Node", "--format=%T").split():
                count[state] = count.get(state, 0) + 1
            return count
        return {}

    def tasks(self):
        """(node, array index) of the running ones."""
        lines = self.run("squeue", "--noheader", "--states=RUNNING", "--format=%N %K").splitlines()
        return [tuple(line.split()) for line in lines]

    def is_idle(self):
        return not self.run("squeue", "--noheader").strip()


class Fleet:
    """Drives of HDL-64E and RS-Ruby128, and their labels."""

    def __init__(self, repository: Path, program: Path, folder: Path):
        self.repository, self.program, self.folder = repository, program, folder
        self.root = folder / "fleet"
        self.root.mkdir()

    def run(self, *words):
        return subprocess.run([self.program, *map(str, words)], cwd=self.folder, text=True, capture_output=True)

    def make(self, *words):
        run = self.run(*words)
        if run.returncode != 0:
            raise RuntimeError(f"terracut {' '.join(map(str, words))}: {run.stderr}")

    def add_drives(self):
        for sensor, duration in (("hdl64e", "0.9"), ("ruby128", "0.5")):
            for number, scene in enumerate(("street", "flat", "hill")):
                self.make("simulate", "--sensor", sensor, "--scene", scene, "--seed", number, "--duration", duration,
                          "-o", self.root / sensor / f"{scene}.pcap")
        scans = self.repository.parent / "shared/data/semantickitti/sequences"
        if not scans.is_dir():
            print("skipped: recorded drives: ../shared/data is not here")
            return
        sequence = sorted(path for path in scans.iterdir() if (path / "velodyne").is_dir())[0]
        few = self.root / "recorded/scans/velodyne"
        few.mkdir(parents=True)
        for scan in sorted((sequence / "velodyne").glob("*.bin"))[:4]:
            (few / scan.name).symlink_to(scan)
        self.make("encode", few, "-o", self.root / "recorded/hdl64e.pcap")

    def spoil(self):
        """One drive cut short, one that will be missing, and more of the good ones until there are enough."""
        for name in ("short", "missing"):
            shutil.copy(self.root / "hdl64e/street.pcap", self.root / f"{name}.pcap")
            shutil.copy(self.root / "hdl64e/street.calibration.xml", self.root / f"{name}.calibration.xml")
        for path in sorted(self.root.glob("*/*.pcap")):
            for ending in (".pcap", ".calibration.xml", ".calibration.csv"):
                of_drive = path.with_suffix(ending)
                if of_drive.exists():
                    (path.parent / f"again_{path.stem}{ending}").symlink_to(of_drive)
        self.make("manifest", "fleet", "-o", "fleet.json")
        manifest = json.loads((self.folder / "fleet.json").read_text())
        with open(self.root / "short.pcap", "r+b") as capture:
            capture.truncate(2_000_003)
        (self.root / "missing.pcap").unlink()
        return manifest["drives"]

    def check_labels(self, drive):
        """Those of the program that reads one recording."""
        is_capture = "capture" in drive
        words = ["replay" if is_capture else "segment", self.root / drive["capture" if is_capture else "scans"]]
        if "calibration" in drive:
            words += ["--calibration", self.root / drive["calibration"]]
        labels = self.folder / "labels" / drive["name"]
        self.make(*words, "--labels", labels)
        (found,) = self.outputs(drive["name"])
        sums = dict(reversed(line.split("  ")) for line in (found / "SHA256SUMS").read_text().splitlines())
        expected = sorted(path.name for path in labels.glob("*.label"))
        assert expected and expected == sorted(path.name for path in found.glob("*.label")), drive["name"]
        for name in expected:
            label = (labels / name).read_bytes()
            assert label == (found / name).read_bytes(), f"{drive['name']}/{name} differs"
            assert hashlib.sha256(label).hexdigest() == sums[name], f"{drive['name']}/{name} is not what its sum says"

    def outputs(self, name):
        place = self.folder / "out" / name
        return [path for path in place.parent.glob(f"{place.name}-*") if path.is_dir()]

    def status(self):
        return self.run("relabel", "--status", "out").stdout


def submit(cluster, fleet):
    cluster.run(str(fleet.repository / "tools/fleet/submit"), "fleet.json", "out", str(SHARDS), "--", f"--chdir={fleet.folder}",
                TERRACUT=str(fleet.program))


def processes_that(are_meant):
    """Whose words are so."""
    found = []
    for process in Path("/proc").glob("[0-9]*"):
        with contextlib.suppress(OSError):
            if are_meant((process / "cmdline").read_bytes().split(b"\0")):
                found.append(int(process.name))
    return found


def processes_of(shard):
    """Of `terracut relabel` of this fleet."""
    return processes_that(lambda words: b"relabel" in words and f"{shard}/{SHARDS}".encode() in words)


@contextlib.contextmanager
def tasks_that_last(fleet):
    """Each drive's labelling is held for a while, without using a core, so that there is time to kill."""
    over = threading.Event()

    def is_of_a_drive(words):
        return b"replay" in words and any(word.startswith(bytes(fleet.root)) for word in words)

    def hold():
        held_since = {}
        while not over.wait(0.01):
            for process in processes_that(is_of_a_drive):
                with contextlib.suppress(ProcessLookupError):
                    if process not in held_since:
                        os.kill(process, signal.SIGSTOP)
                        held_since[process] = time.monotonic()
                    elif time.monotonic() - held_since[process] > HELD_S:
                        os.kill(process, signal.SIGCONT)
        for process in held_since:
            with contextlib.suppress(ProcessLookupError):
                os.kill(process, signal.SIGCONT)

    holding = threading.Thread(target=hold)
    holding.start()
    try:
        yield
    finally:
        over.set()
        holding.join()


def check_parallel(fleet):
    """The other recipe finds all of it there, and fails for the bad ones alone."""
    if shutil.which("parallel") is None:
        print("not tried: tools/fleet/parallel, for want of GNU parallel")
        return
    run = subprocess.run([fleet.repository / "tools/fleet/parallel", "fleet.json", "out"], text=True, capture_output=True,
                         env=os.environ | {"TERRACUT": str(fleet.program), "JOBS": "2"})
    failed = [line for line in run.stdout.splitlines() if line.startswith("failed")]
    assert run.returncode == len(failed) == 2 and "labelled  1" not in run.stdout, run.stdout + run.stderr


def kill_node(cluster, name):
    """Its slurmd and the slurmstepd above a task, so that nobody tells the controller how that ended: the task, an orphan now, goes on
    while the controller, once it misses the node, has it done again elsewhere."""
    cluster.processes[name].kill()
    cluster.processes[name].wait()
    for node, shard in cluster.tasks():
        for process in processes_of(shard) if node == name else ():
            parent = int(Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[1])
            if "slurmstepd" in Path(f"/proc/{parent}/comm").read_text():
                os.kill(parent, signal.SIGKILL)


def run(repository: Path, program: Path, folder: Path):
    fleet = Fleet(repository, program, folder)
    fleet.add_drives()
    drives = fleet.spoil()
    bad = ("short", "missing")
    os.chdir(folder)
    started = time.monotonic()
    with Cluster(folder / "slurm") as cluster, contextlib.ExitStack() as first:
        first.enter_context(tasks_that_last(fleet))
        submit(cluster, fleet)
        wait_for("tasks on both nodes", lambda: {node for node, _ in cluster.tasks()} == {"n1", "n2"})
        wait_for("labels", lambda: any((folder / "out").rglob("*.label")))
        kill_node(cluster, "n2")

        killed = []

        def kill_a_task():
            for node, shard in cluster.tasks():
                for process in processes_of(shard) if node == "n1" else ():
                    os.kill(process, signal.SIGKILL)
                    killed.append(shard)
            return killed

        wait_for("a task to kill", kill_a_task)
        wait_for("a node that is down", lambda: any(state.startswith("down") for state in cluster.states()))
        cluster.start_node("n2")
        wait_for("the array's end", cluster.is_idle)
        print(f"killed: node n2, and the task of shard {killed[0]}; the array ended {time.monotonic() - started:.0f} s after it began")
        control = (folder / "slurm/slurmctld.log").read_text()
        assert "due to failure of node n2" in control, "nothing was requeued"
        first.close()
        print(fleet.status())

        written = {path: path.stat().st_mtime_ns for path in (folder / "out").rglob("*.label")}
        submit(cluster, fleet)
        wait_for("the second array's end", cluster.is_idle)
        for path, stamp in written.items():
            assert path.stat().st_mtime_ns == stamp, f"{path} was written again"
    status = fleet.status()
    print(status)
    good = [drive for drive in drives if drive["name"] not in bad]
    assert f"done      {len(good)} drives" in status and "failed    2 drives" in status and "missing   0 drives" in status
    assert "short: " in status and "breaks off" in status and "missing.pcap: No such file" in status
    for drive in good:
        fleet.check_labels(drive)
    assert not any(fleet.outputs(name) for name in bad)
    check_parallel(fleet)
    assert not any((folder / "out/.relabel/parts").iterdir()), "the next run on a host takes away what killed ones left"
    print(f"{len(good)} drives in {SHARDS} shards on 2 nodes: labels as of replay and segment; 2 bad ones named")


def main():
    repository, program, folder = (Path(word).resolve() for word in sys.argv[1:4])
    missing = [name for name in NEEDED if shutil.which(name) is None]
    if missing or os.geteuid() != 0:
        print(f"skipped: needs root and {', '.join(NEEDED)}; ./tools/setup --all installs slurm-wlm and munge")
        return
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    try:
        run(repository, program, folder)
    except Exception:
        for log in sorted((folder / "slurm").glob("*.log")) + sorted((folder / "out/slurm").glob("*.txt")):
            print(f"--- {log}\n" + "\n".join(log.read_text(errors="replace").splitlines()[-30:]))
        raise


if __name__ == "__main__":
    main()
