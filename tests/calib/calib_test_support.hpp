// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "rt/error.hpp"
#include "tests/support/places.hpp"
#include "tests/support/scratch_folder.hpp"

namespace terracut::calib {

inline void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

/// `text` with the first `from` replaced by `to`; fails the test if there is none.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << "\"" << from << "\" is not in the text";
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// EXPECT_THAT(result, IsRefusedWith(ErrorCode::kMalformed, HasSubstr("laser 5")))
template <class Matcher>
auto IsRefusedWith(ErrorCode code, const Matcher& message) {
  return testing::Truly([code, message](const auto& result) {
    if (result.has_value()) return false;
    const bool fits =
        result.error().code == code && testing::Matches(message)(result.error().message);
    EXPECT_TRUE(fits) << to_string(result.error().code) << ": " << result.error().message;
    return fits;
  });
}

}  // namespace terracut::calib
