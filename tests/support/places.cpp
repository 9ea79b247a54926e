// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "places.hpp"

#include <cstdlib>

namespace terracut::test {

std::filesystem::path source_folder() {
  return TERRACUT_SOURCE_DIR;
}
std::filesystem::path program() {
  return TERRACUT_PROGRAM;
}
std::filesystem::path drive() {
  return TERRACUT_TEST_DRIVE;
}

std::filesystem::path shared_data(const std::filesystem::path& relative) {
  const char* const shared = std::getenv("TERRACUT_SHARED");
  return (shared != nullptr ? shared : source_folder() / ".." / "shared") / "data" / relative;
}

}  // namespace terracut::test
