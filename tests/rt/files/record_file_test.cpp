// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/files/record_file.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/scratch_folder.hpp"

namespace terracut::files {
namespace {

namespace fs = std::filesystem;

class RecordFiles : public test::InScratchFolder {
 protected:
  /// What reading eight bytes of a file of the folder ends with.
  [[nodiscard]] Status read(const char* name) const {
    std::array<char, 8> bytes{};
    return read_bytes(folder_ / name, bytes.data(), bytes.size());
  }
};

TEST_F(RecordFiles, ThatBecameAPipeOrShorterSinceTheyWereCountedAreRefused) {
  std::ofstream(folder_ / "whole") << "12345678";
  std::ofstream(folder_ / "shorter") << "1234567";
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  EXPECT_TRUE(read("whole"));
  for (const char* const name : {"shorter", "pipe"}) {
    const Status refused = read(name);
    ASSERT_FALSE(refused) << name;
    EXPECT_EQ(refused.error().code, ErrorCode::kUnreadable) << refused.error().message;
  }
}

TEST_F(RecordFiles, OfMoreThanOneFrameSayHowManyRecordsTheyHave) {
  std::ofstream(folder_ / "twelve") << std::string(48, 'x');
  const RecordLayout layout{.record = "word of 4 bytes", .record_bytes = 4, .max_records = 11};
  const Expected<std::size_t> refused = count_records(folder_ / "twelve", layout);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, testing::HasSubstr("12 records, expected at most 11"));
}

}  // namespace
}  // namespace terracut::files
