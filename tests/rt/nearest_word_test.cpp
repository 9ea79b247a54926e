// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/nearest_word.hpp"

#include <gtest/gtest.h>

#include <array>

namespace terracut::rt {
namespace {

constexpr std::array<std::string_view, 5> kWords{"labels", "json", "deadline", "height_m",
                                                 "pitch_deg"};

TEST(NearestWord, ForgivesALetterLeftOutAddedReplacedOrSwapped) {
  EXPECT_EQ(nearest_word("deadlin", kWords), "deadline");
  EXPECT_EQ(nearest_word("jsson", kWords), "json");
  EXPECT_EQ(nearest_word("lapels", kWords), "labels");
  EXPECT_EQ(nearest_word("hieght_m", kWords), "height_m");
}

TEST(NearestWord, IsWhatTheWordBegins) {
  EXPECT_EQ(nearest_word("d", kWords), "deadline");
  EXPECT_EQ(nearest_word("pitch", kWords), "pitch_deg");
}

TEST(NearestWord, ForgivesMoreInLongWords) {
  EXPECT_EQ(nearest_word("dedlnie", kWords), "deadline");
  EXPECT_EQ(nearest_word("jno", kWords), "");
}

TEST(NearestWord, IsNoneWhereNoneIsNear) {
  EXPECT_EQ(nearest_word("frobnicate", kWords), "");
  EXPECT_EQ(nearest_word("", kWords), "");
  EXPECT_EQ(nearest_word("json", {}), "");
}

TEST(NearestWord, OfEquallyNearOnesIsTheFirst) {
  constexpr std::array<std::string_view, 2> kTwins{"port", "sort"};
  EXPECT_EQ(nearest_word("fort", kTwins), "port");
}

}  // namespace
}  // namespace terracut::rt
