// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/status/times_table.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace terracut::status {
namespace {

TEST(TimesTable, HasARowForEachHistogramThatPeopleAreShown) {
  measure::LogLinearHistogram decode, did_not_run;
  decode.record(2'000'000);
  did_not_run.record(0);
  const std::vector<Figure> figures{{"decode", &decode, {}, {"times", "decode"}},
                                    {"cut", &did_not_run, {}, {"times", "cut", Shown::kIfAny}},
                                    {"wall", &decode},
                                    {"frames", std::uint64_t{1}, {}, {"frames"}}};
  EXPECT_EQ(times_table(figures, {}),
            "ms                       p50       p90       p99     p99.9       max\n"
            "decode                 2.000     2.000     2.000     2.000     2.000\n");
}

}  // namespace
}  // namespace terracut::status
