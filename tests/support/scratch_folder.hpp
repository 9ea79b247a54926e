// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

namespace terracut::test {

/// Makes an empty folder for the running test alone: of this process too, so that two builds can be
/// tested at once. Whoever makes it removes it.
inline std::filesystem::path make_scratch_folder() {
  const auto* info = testing::UnitTest::GetInstance()->current_test_info();
  std::string name = std::string("terracut_") + info->test_suite_name() + "_" + info->name() + "_" +
                     std::to_string(getpid());
  for (char& c : name) {
    if (c == '/') c = '_';  // parameterised tests
  }
  const auto folder = std::filesystem::path(testing::TempDir()) / name;
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

}  // namespace terracut::test
