# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Mistakes are planted where they mean what they say, and nowhere else."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(REPOSITORY / "tools/research"))

try:
    from mutants import planting, sites
    from mutants.main import noticed_by
except ModuleNotFoundError as missing:
    print(f"skipped: no {missing.name} for Python (./tools/setup --all)")
    sys.exit(0)

SOURCE = """
namespace made {
constexpr int kMost = 3 + 4;
static_assert(kMost > 6);
enum class Kind { kOne = 1 };
int calls = 0;
void count() { ++calls; }
int difference(int a, int b) { return a - b; }
int max(int a, int b);  // swapped arguments would change nothing
inline int most(int a, int b) { return max(a, b); }
bool is_small(int value) {
  return value < 10 && value != 5;
}
int use(int a, int b) {
  count();
  if constexpr (kMost > 5) calls += 2;
  switch (a) {
    case 7: return -b;
    default: break;
  }
  return difference(a, b);
}
}  // namespace made
"""

MAIN = """
#include <cstdio>
namespace made { extern int calls; bool is_small(int); int use(int, int); }
int main() {
  const bool small = made::is_small(10), odd = made::is_small(5);
  const int used = made::use(5, 3), turned = made::use(7, 3);
  std::printf("%d %d %d %d %d", small, odd, used, turned, made::calls);
}
"""


class Mistakes(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.addCleanup(self.scratch.cleanup)
        self.root = Path(self.scratch.name).resolve()
        source = self.root / "rt/made.cpp"
        source.parent.mkdir()
        source.write_text(SOURCE)
        self.found = sites.sites_of(self.root, source, "c++ -std=c++20")

    def what(self, rule):
        return sorted((site.before, site.after) for site in self.found if site.rule == rule)

    def test_are_found_by_rule(self):
        self.assertEqual(self.what("comparison"), [("!=", "=="), ("<", "<=")])
        self.assertEqual(self.what("logic"), [("&&", "||")])
        self.assertEqual(self.what("arithmetic"), [("-", "+")])
        self.assertEqual(self.what("swapped"), [("a, b", "b, a")])
        self.assertEqual(self.what("sign"), [("-", "")])
        self.assertEqual(self.what("dropped"), [("count()", "")])

    def test_are_not_planted_where_the_compiler_works_things_out(self):
        constants = [before for before, _ in self.what("constant")]
        self.assertEqual(sorted(constants), ["10", "2", "5"])

    def test_are_drawn_alike_for_a_seed_and_never_within_each_other(self):
        one, again = planting.sample(self.found, 50, 4), planting.sample(self.found, 50, 4)
        self.assertEqual(one, again)
        for site in one:
            others = [other for other in one if other is not site]
            self.assertTrue(all(site.end < other.begin or other.end < site.begin for other in others))

    def test_change_what_the_program_does_only_when_they_are_chosen(self):
        for rule, shown in {"comparison": {"1 0 2 -3 6", "0 1 2 -3 6"}, "arithmetic": {"0 0 8 -3 6"}, "swapped": {"0 0 -2 -3 6"},
                            "sign": {"0 0 2 3 6"}, "dropped": {"0 0 2 -3 4"}}.items():  # fmt: skip
            of_rule = [site for site in self.found if site.rule == rule]
            numbered = dict(enumerate(of_rule, 1))
            tree = self.root / "tree"
            planting.put(tree / "main.cpp", MAIN.encode())
            planting.plant(planting.sources_of(self.root, numbered.values()), tree, numbered)
            program = self.root / "program"
            subprocess.run(["c++", "-std=c++20", tree / "rt/made.cpp", tree / "main.cpp",
                            "-o", program], check=True)  # fmt: skip
            run = lambda number: subprocess.run([program], env={"TERRACUT_MUTANTS": str(number)}, capture_output=True, text=True).stdout
            self.assertEqual(run(0), "0 0 2 -3 6")
            self.assertEqual({run(number) for number in numbered}, shown)

    def test_several_are_made_at_once(self):
        numbered = dict(enumerate((site for site in self.found if site.rule in ("arithmetic", "dropped")), 1))
        tree, program = self.root / "tree", self.root / "program"
        planting.put(tree / "main.cpp", MAIN.encode())
        planting.plant(planting.sources_of(self.root, numbered.values()), tree, numbered)
        subprocess.run(["c++", "-std=c++20", tree / "rt/made.cpp", tree / "main.cpp", "-o", program], check=True)
        done = subprocess.run([program], env={"TERRACUT_MUTANTS": ",".join(map(str, numbered))}, capture_output=True, text=True)
        self.assertEqual(done.stdout, "0 0 8 -3 4")

    def test_those_that_a_suite_notices_are_found_by_halves(self):
        tried = []

        def fails(numbers):
            tried.append(numbers)
            return any(number in (3, 4, 40) for number in numbers)

        self.assertEqual(list(noticed_by(fails, list(range(100)))), [3, 4, 40])
        self.assertLess(len(tried), 40)
        tried.clear()
        self.assertEqual(list(noticed_by(fails, list(range(50, 100)))), [])
        self.assertEqual(len(tried), 1)

    def test_a_negation_is_lost_whatever_is_asked(self):
        source = self.root / "rt/asked.cpp"
        source.write_text("""
struct Answer { bool good; explicit operator bool() const { return good; } };
bool is_bad(Answer answer) { return !answer; }
int main() { return is_bad({true}) ? 1 : 0; }
""")
        lost = [site for site in sites.sites_of(self.root, source, "c++ -std=c++20") if site.rule == "sign"]
        tree, program = self.root / "tree", self.root / "program"
        planting.plant(planting.sources_of(self.root, lost), tree, dict(enumerate(lost, 1)))
        subprocess.run(["c++", "-std=c++20", tree / "rt/asked.cpp", "-o", program], check=True)
        codes = [subprocess.run([program], env={"TERRACUT_MUTANTS": number}, check=False).returncode for number in ("0", "1")]
        self.assertEqual(codes, [0, 1])


if __name__ == "__main__":
    unittest.main()
