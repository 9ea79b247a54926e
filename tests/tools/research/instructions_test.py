# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""What tools/instructions makes of callgrind's lists, of figures made up here."""

import importlib.util
import unittest
from importlib.machinery import SourceFileLoader
from pathlib import Path

PATH = Path(__file__).resolve().parents[3] / "tools/instructions"
loader = SourceFileLoader("instructions", str(PATH))
tool = importlib.util.module_from_spec(importlib.util.spec_from_loader("instructions", loader))
loader.exec_module(tool)

LIST = """
--------------------------------------------------------------------------------
Ir
--------------------------------------------------------------------------------
14,001,000 (100.0%)  PROGRAM TOTALS

--------------------------------------------------------------------------------
Ir                   file:function
--------------------------------------------------------------------------------
 9,000,000 (64.29%)  ???:terracut::decode::Decoder::place() [/somewhere/terracut]
 4,000,000 (28.57%)  ???:bool terracut::min_cut::contract<terracut::random_field::Term>(terracut::Label) [/somewhere/terracut]
 1,000,000 ( 7.14%)  ./string/../multiarch/memset.S:__memset_avx2 [/usr/lib/libc.so.6]
     1,000 ( 0.00%)  ???:terracut::cli::run_bench(terracut::cli::Options const&) [/somewhere/terracut]
"""


class Instructions(unittest.TestCase):
    def test_every_function_of_the_list_counts_once_and_totals_do_not(self):
        counts = tool.counts_of(LIST)
        self.assertEqual(sum(counts.values()), 14_001_000)
        self.assertEqual(counts["terracut::decode::Decoder::place()"], 9_000_000)

    def test_a_function_belongs_to_the_stage_of_its_own_namespace(self):
        for function, stage in {
            "bool terracut::min_cut::contract<terracut::random_field::Term>(terracut::Label)": "min-cut",
            "terracut::ground::(anonymous namespace)::solve(terracut::min_cut::MinCut&)": "min-cut",
            "terracut::elevation::AdjacentPoints::compare(int)": "adjacent points",
            "terracut::elevation::(anonymous namespace)::mark_by_slope(int) [clone .avx2]": "adjacent points",
            "terracut::elevation::RingElevationMap::label(terracut::frame::RangeImage const&)": "elevation map",
            "terracut::hdl64e::PointKernel::compute(int)": "decoding",
            "terracut::cli::run_bench(terracut::cli::Options const&)": tool.REST,
            "__memset_avx2": tool.REST,
        }.items():
            self.assertEqual(tool.stage_of(function), stage, function)

    def test_costs_are_told_by_the_frame(self):
        rows = list(tool.table(tool.counts_of(LIST), frames=2))
        self.assertIn("| decoding | 4.50 | 64% |", rows)
        self.assertIn("| min-cut | 2.00 | 29% |", rows)
        self.assertIn("| **all** | **7.00** | |\n", rows)
        self.assertIn("| `decode::Decoder::place` | 4.50 | decoding |", rows)


if __name__ == "__main__":
    unittest.main()
