# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Plants mistakes in calib, firmware_io, pipeline and rt, and lists those that no test notices.

    ./tools/mutate --since main                   # in the lines a change touches
    ./tools/mutate firmware_io/decode --count 40  # in a folder or a file
    ./tools/mutate --count 400 --seed 7           # a sample of all

Mistakes are made by rule, from clang's syntax tree: a comparison off by its bound or turned around, && for ||, a wrong operator,
a constant off by one, a sign or negation lost, a statement dropped, two arguments of one type swapped, a function that returns at
once. All drawn ones are compiled into one program, in a copy of the tree (build/mutants/tree); a number in the environment makes
one of them. The suites of `./tools/test` run once without any, which shows whom each is reached by; then each mistake is tried with
the likeliest of those that reach it, until one fails. The mistakes not noticed then are made all at once for each other suite, and
by halves where it fails. Verdicts go into build/mutants/verdicts.json as they fall, and a run that broke off goes on there. Exit
code 1 where a mistake was not noticed.

A mistake that survives may change nothing anyone can see (a bound that is never met): look before you write a test.
"""

import argparse
import hashlib
import json
import re
import subprocess
import sys
from collections import Counter
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from pathlib import Path

from whole_file import write_whole_file

from . import planting, sites
from .suites import Failed, Suites

REPOSITORY = Path(__file__).resolve().parents[3]
FOLDER = REPOSITORY / "build/mutants"
# Seconds of suites that each mistake is tried with alone: most are noticed by them.
FIRST_S = 3


def arguments(given):
    parser = argparse.ArgumentParser(prog="mutate", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("path", nargs="*", help="folders or files to plant in (default: the four rooms)")
    parser.add_argument("--since", metavar="REV", help="only in lines that differ from this revision")
    parser.add_argument("--count", type=int, default=50, help="how many mistakes (default: 50)")
    parser.add_argument("--seed", type=int, default=1, help="the same seed draws the same mistakes (default: 1)")
    parser.add_argument("--jobs", type=int, default=2, help="compilers and suites at once (default: 2)")
    parser.add_argument("--list", action="store_true", help="only list what would be planted")
    return parser.parse_args(given)


def commands():
    """The compile command of each source file of the four rooms, from the preset `dev`, which joins none."""
    folder = FOLDER / "commands"
    subprocess.run(["cmake", "--preset", "dev", "-B", folder], cwd=REPOSITORY, check=True, stdout=subprocess.DEVNULL)
    listed = json.loads((folder / "compile_commands.json").read_text())
    found = {Path(entry["file"]): entry["command"] for entry in listed}
    return {path: command for path, command in found.items()
            if path.is_relative_to(REPOSITORY) and path.relative_to(REPOSITORY).parts[0] in sites.ROOMS}  # fmt: skip


def is_below(file, paths):
    return any(file == path or file.startswith(path + "/") for path in paths)


def all_sites(paths, jobs):
    """Every site below the paths, from a file where the sources are as they were."""
    by_source = {path: command for path, command in commands().items() if is_below(str(path.parent.relative_to(REPOSITORY)), paths)
                 or is_below(str(path.relative_to(REPOSITORY)), paths)}  # fmt: skip
    names = sorted(path for room in sites.ROOMS for path in (REPOSITORY / room).rglob("*.[ch]pp"))
    state = hashlib.sha256(repr(paths).encode() + b"".join(path.read_bytes() for path in [*names, Path(sites.__file__)])).hexdigest()
    kept = FOLDER / f"sites-{state[:16]}.json"
    if not kept.exists():
        with ProcessPoolExecutor(jobs) as pool:
            found = pool.map(sites.sites_of, [REPOSITORY] * len(by_source), by_source, by_source.values())
            unique = {site.key(): site for some in found for site in some}
        write_whole_file(kept, sites.to_json(unique.values()))
    return sites.from_json(kept.read_text())


def changed_lines(revision):
    """The lines of each file that differ from a revision."""
    shown = subprocess.run(["git", "-C", REPOSITORY, "diff", "-U0", revision, "--", *sites.ROOMS], check=True, capture_output=True,
                           text=True).stdout  # fmt: skip
    changed, name = {}, None
    for line in shown.splitlines():
        if line.startswith("+++ "):
            name = line[6:]
        hunk = re.match(r"@@ -\S+ \+(\d+)(?:,(\d+))? @@", line)
        if hunk:
            first = int(hunk[1])
            changed.setdefault(name, set()).update(range(first, first + int(hunk[2] or 1)))
    return changed


def wanted(given):
    lines = changed_lines(given.since) if given.since else {}
    folders = [str(Path(path).resolve().relative_to(REPOSITORY)) for path in given.path]
    paths = folders or sorted({str(Path(file).parent) for file in lines}) or list(sites.ROOMS)
    found = [site for site in all_sites(paths, given.jobs) if is_below(site.file, paths)]
    if given.since:
        found = [site for site in found if site.line in lines.get(site.file, ())]
    return planting.sample(found, given.count, given.seed)


class Trial:
    def __init__(self, drawn, jobs):
        self.numbered = dict(enumerate(drawn, 1))
        self.tree = FOLDER / "tree"
        self.suites = Suites(self.tree, jobs)

    def build(self):
        planting.copy_tree(REPOSITORY, self.tree)
        sources = planting.sources_of(REPOSITORY, self.numbered.values())
        planting.plant(sources, self.tree, self.numbered)
        self.suites.configure()
        while broken := self.suites.build():
            gone = [self.numbered.pop(number) for number in broken if number in self.numbered]
            print(f"{len(gone)} do not compile and are left out", flush=True)
            planting.restore(sources, self.tree, {site.file for site in gone})
            planting.plant(sources, self.tree, self.numbered)

    def reach(self):
        """Which suites reach each mistake, and how long each takes, without a mistake. Known already where nothing was built since."""
        kept = FOLDER / "reached.json"
        if kept.exists() and not self.suites.has_built:
            known = json.loads(kept.read_text())
            return known["seconds"], {int(number): names for number, names in known["reached_by"].items()}
        kept.unlink(missing_ok=True)
        self.suites.make_fixtures()

        def look(name):
            marks = FOLDER / f"reached-{name.replace('/', '-')}"
            marks.unlink(missing_ok=True)
            seconds = self.suites.timed(name, marks)
            seen = marks.read_bytes() if marks.exists() else b""
            marks.unlink(missing_ok=True)
            return seconds, {number for number in self.numbered if number < len(seen) and seen[number]}

        names = self.suites.names()
        with ThreadPoolExecutor(self.suites.jobs) as pool:
            looked = {name: each for name, each in zip(names, pool.map(look, names)) if each[0] is not None}
        if failing := [name for name in names if name not in looked]:
            print(f"left out, they fail without a mistake: {' '.join(failing)}", flush=True)
        seconds = {name: each[0] for name, each in looked.items()}
        reached_by = {number: [name for name in looked if number in looked[name][1]] for number in self.numbered}
        write_whole_file(kept, json.dumps({"seconds": seconds, "reached_by": reached_by}))
        return seconds, reached_by

    def judge(self, seconds, reached_by, verdicts):
        """Yields (site, verdict) as they fall; those in `verdicts` are not tried again."""
        open_ones = [number for number, site in self.numbered.items() if site.key() not in verdicts]
        reaches = Counter(name for names in reached_by.values() for name in names)
        left = {}
        for number in list(open_ones):
            first, left[number] = of_budget(likeliest_first(reached_by[number], seconds, reaches), seconds)
            noticed = self.suites.run(first, [number], limit_s=limit_s(first, seconds)) if first else None
            if noticed:
                open_ones.remove(number)
                yield self.numbered[number], noticed
        print(f"{len(open_ones)} not noticed by the likeliest {FIRST_S} s of suites; together for the others:", flush=True)

        def look(name):
            together = [number for number in list(open_ones) if name in left[number]]
            return list(noticed_by(lambda numbers: self.suites.run([name], numbers, limit_s=limit_s([name], seconds)), together))

        names = sorted(seconds, key=seconds.get)
        with ThreadPoolExecutor(self.suites.jobs) as pool:
            for name, noticed in zip(names, pool.map(look, names)):
                for number in noticed:
                    if number in open_ones:
                        open_ones.remove(number)
                        yield self.numbered[number], name
        for number in open_ones:
            yield self.numbered[number], "" if reached_by[number] else "reached by no suite"


def noticed_by(fails, numbers):
    """Yields those of the mistakes with which a suite fails alone, by halves: most suites fail with none of those that are left."""
    if not numbers or not fails(numbers):
        return
    if len(numbers) == 1:
        yield numbers[0]
        return
    half = len(numbers) // 2
    yield from noticed_by(fails, numbers[:half])
    yield from noticed_by(fails, numbers[half:])


def limit_s(names, seconds):
    return 20 + 5 * sum(map(seconds.get, names))


def likeliest_first(names, seconds, reaches):
    """A suite that reaches few mistakes looks at them more closely, and one that is quick costs little."""
    return sorted(names, key=lambda name: (seconds[name] + 0.2) * reaches[name])


def of_budget(names, seconds):
    """The first suites that take no longer than FIRST_S, one at least, and the others."""
    taken, count = 0, 0
    for name in names:
        taken += seconds[name]
        if count and taken > FIRST_S:
            break
        count += 1
    return names[:count], names[count:]


def described(site):
    what = f"{site.before!r} -> {site.after!r}" if site.after else f"without {site.before!r}"
    return f"{site.file}:{site.line}: {site.rule}: {what}"


def report(drawn, verdicts):
    judged = [(site, verdicts[site.key()]) for site in drawn if site.key() in verdicts]
    missed = [(site, verdict) for site, verdict in judged if verdict in ("", "reached by no suite")]
    for site, verdict in missed:
        print(f"{described(site)}{': ' + verdict if verdict else ''}")
    print(f"{len(judged)} mistakes planted, {len(judged) - len(missed)} noticed, {len(missed)} not")
    return 1 if missed else 0


def main(given):
    given = arguments(given)
    drawn = wanted(given)
    if given.list:
        for site in drawn:
            print(described(site))
        return 0
    kept = FOLDER / "verdicts.json"
    state = hashlib.sha256("".join(site.key() + site.shape for site in drawn).encode()).hexdigest()
    known = json.loads(kept.read_text()) if kept.exists() else {}
    verdicts = known["verdicts"] if known.get("of") == state else {}
    trial = Trial(drawn, given.jobs)
    try:
        trial.build()
        print(f"{len(trial.numbered)} mistakes in the tree; the suites run once without any", flush=True)
        for site, verdict in trial.judge(*trial.reach(), verdicts):
            verdicts[site.key()] = verdict
            write_whole_file(kept, json.dumps({"of": state, "verdicts": verdicts}, indent=1))
            print(f"{site.file}:{site.line} {site.rule}: {'noticed by ' + verdict if verdict and verdict != 'reached by no suite' else 'NOT NOTICED'}",
                  flush=True)  # fmt: skip
    except Failed as failure:
        print(f"error: {failure}", file=sys.stderr)
        return 2
    return report(list(trial.numbered.values()), verdicts)
