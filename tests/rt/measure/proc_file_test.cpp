// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/measure/proc_file.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <string>
#include <utility>

#include "tests/support/allocation_counter.hpp"
#include "tests/support/scratch_folder.hpp"

namespace terracut::measure {
namespace {

TEST(ProcFile, ReadsFromTheBeginningEachTime) {
  const test::ScratchFolder folder;
  const std::string path = (folder / "file").string();
  std::ofstream(path) << "1 2 3";
  auto file = ProcFile::open(path.c_str());
  ASSERT_TRUE(file.has_value());
  std::array<char, 64> buffer{};
  EXPECT_EQ(file->read(buffer), "1 2 3");
  std::ofstream(path) << "4 5 6";
  EXPECT_EQ(file->read(buffer), "4 5 6");
  const ProcFile moved = std::move(*file);
  EXPECT_EQ(moved.read(std::span(buffer).first(2)), "4 ");
}

TEST(ProcFile, SaysWhatDoesNotExist) {
  const auto file = ProcFile::open("/proc/no-such-file");
  ASSERT_FALSE(file.has_value());
  EXPECT_EQ(file.error().code, ErrorCode::kNotFound);
  EXPECT_NE(file.error().message.find("/proc/no-such-file"), std::string::npos);
}

TEST(ProcFile, AllocatesNothingWhenReadAgain) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "the sanitizer brings its own allocator";
  auto file = ProcFile::open("/proc/self/status");
  if (!file) GTEST_SKIP() << file.error().message;
  std::array<char, 256> buffer{};
  const std::uint64_t before = test::allocations_of_this_thread();
  std::size_t bytes = 0;
  for (int n = 0; n < 10; ++n) bytes += file->read(buffer).size();
  EXPECT_EQ(test::allocations_of_this_thread(), before);
  EXPECT_GT(bytes, 0U);
}

TEST(NthNumber, CountsFromZeroAndSkipsBlanks) {
  EXPECT_EQ(nth_number("12 34 56", 0), 12);
  EXPECT_EQ(nth_number("12 34 56\n78", 2), 56);
  EXPECT_EQ(nth_number("  12   34", 1), 34);
  EXPECT_EQ(nth_number("9223372036854775807", 0), INT64_MAX);
}

TEST(NthNumber, IsNegativeWhereThereIsNone) {
  EXPECT_EQ(nth_number("", 0), -1);
  EXPECT_EQ(nth_number("12 34", 2), -1);
  EXPECT_EQ(nth_number("12 ", 1), -1);
  EXPECT_EQ(nth_number("12 x 34", 1), -1);
  EXPECT_EQ(nth_number("12 x 34", 2), -1);
  EXPECT_EQ(nth_number("12\n34", 1), -1) << "of one line only";
  EXPECT_EQ(nth_number("9223372036854775808", 0), -1);
}

}  // namespace
}  // namespace terracut::measure
