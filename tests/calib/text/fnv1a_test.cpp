// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/text/fnv1a.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string_view>

namespace terracut::text {
namespace {

/// The hash of bytes, as its authors describe it.
std::uint64_t hash_of(std::string_view bytes) {
  std::uint64_t hash = 14'695'981'039'346'656'037U;
  for (const char byte : bytes)
    hash = (hash ^ static_cast<unsigned char>(byte)) * 1'099'511'628'211U;
  return hash;
}

TEST(Fnv1a, HashesANumbersEightBytesFromTheLowestOn) {
  ASSERT_EQ(hash_of("a"), 0xAF63DC4C8601EC8CU);          // one of its authors' examples
  volatile std::int64_t number = 0x6867'6665'6463'6261;  // while the program runs, not before
  Fnv1a hash;
  EXPECT_EQ(hash.value(), hash_of(""));
  hash.add(number);
  EXPECT_EQ(hash.value(), hash_of("abcdefgh"));
  hash.add(number);
  EXPECT_EQ(hash.value(), hash_of("abcdefghabcdefgh"));
}

}  // namespace
}  // namespace terracut::text
