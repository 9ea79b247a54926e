// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/eval/report/paper_tables.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace terracut::evaluation::report {
namespace {

double mean_of(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

// A slip of the pen would show: the paper's means are the means of what it prints, as far as it
// rounds them.
TEST(PaperTables, RowsHaveTheMeansThatArePrintedWithThem) {
  for (const char* const name : {"semantickitti", "koblenz"}) {
    const PaperDataset* const dataset = paper_dataset(name);
    ASSERT_NE(dataset, nullptr);
    EXPECT_EQ(dataset->sequences.size(), dataset->scans.size());
    for (const PaperTable* const table : {&dataset->iou_g, &dataset->recall_o, &dataset->time}) {
      EXPECT_EQ(table->rows.size(), 3U);
      for (const PaperRow& row : table->rows) {
        ASSERT_EQ(row.values.size(), dataset->sequences.size()) << table->number << row.method;
        const double rounding = row.mean > 1000                            ? 0.5
                                : row.mean < 40 && table == &dataset->time ? 0.06
                                                                           : 0.011;
        EXPECT_NEAR(mean_of(row.values), row.mean, rounding) << table->number << " " << row.method;
      }
    }
  }
}

TEST(PaperTables, KnowTheMethodsByOurNames) {
  const PaperDataset* const dataset = paper_dataset("koblenz");
  ASSERT_NE(dataset, nullptr);
  ASSERT_NE(dataset->recall_o.row_of("paper"), nullptr);
  EXPECT_EQ(dataset->recall_o.row_of("paper")->mean, 86.32);
  EXPECT_EQ(dataset->recall_o.row_of("pfaff"), nullptr);
  EXPECT_EQ(paper_dataset("simulated"), nullptr);
  EXPECT_EQ(paper_averages().size(), 4U);
}

}  // namespace
}  // namespace terracut::evaluation::report
