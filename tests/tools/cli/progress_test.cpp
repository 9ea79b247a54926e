// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <gtest/gtest.h>

#include "tools/cli/console.hpp"

namespace terracut::cli {
namespace {

TEST(Progress, IsSaidInNumbersThatAreReadAtAGlance) {
  EXPECT_EQ(progress_line({"simulating", "s", 0.3287, 3, 5.2}),
            "simulating: 0.3 of 3 s, 11 %, after 5 s");
  EXPECT_EQ(progress_line({"simulating", "s", 0.2, 0.5, 5}),
            "simulating: 0.2 of 0.5 s, 40 %, after 5 s");
  EXPECT_EQ(progress_line({"sending", "packets", 17'362, 0, 5}),
            "sending: 17362 packets, after 5 s");
  EXPECT_EQ(progress_line({"labelling", "scans", 150, 20'000, 60}),
            "labelling: 150 of 20000 scans, 1 %, after 60 s");
}

}  // namespace
}  // namespace terracut::cli
