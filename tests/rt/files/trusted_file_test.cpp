// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/files/trusted_file.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

namespace terracut::files {
namespace {

using testing::HasSubstr;

struct ::stat file_of(::uid_t owner, ::mode_t mode) {
  struct ::stat file{};
  file.st_uid = owner;
  file.st_mode = mode;
  return file;
}

TEST(TrustedFile, IsOneOfTheReaderOfRootOrOfAService) {
  EXPECT_TRUE(is_trusted_owner(1000, 1000));
  EXPECT_TRUE(is_trusted_owner(0, 1000));
  EXPECT_TRUE(is_trusted_owner(999, 1000));
  EXPECT_TRUE(is_trusted_owner(61184, 0));
  EXPECT_TRUE(is_trusted_owner(65519, 1000));
}

TEST(TrustedFile, IsNoneOfAnotherPerson) {
  EXPECT_FALSE(is_trusted_owner(1001, 1000));
  EXPECT_FALSE(is_trusted_owner(1000, 0)) << "root reads what others may have made for it";
  EXPECT_FALSE(is_trusted_owner(61183, 1000));
  EXPECT_FALSE(is_trusted_owner(65534, 1000)) << "nobody";
}

TEST(TrustedFile, IsAPlainOneThatOnlyItsOwnerMayWriteTo) {
  const ::uid_t own = ::geteuid();
  EXPECT_TRUE(check_trusted(file_of(own, S_IFREG | 0644), "page"));
  for (const ::mode_t mode : {0664U, 0646U, 0666U}) {
    const Status refused = check_trusted(file_of(own, S_IFREG | mode), "page");
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message, HasSubstr("written to by others"));
  }
  EXPECT_FALSE(check_trusted(file_of(own, S_IFIFO | 0600), "page"));
  const Status foreign = check_trusted(file_of(own + 54321, S_IFREG | 0644), "page");
  ASSERT_FALSE(foreign);
  EXPECT_THAT(foreign.error().message, HasSubstr("belongs to user " + std::to_string(own + 54321)));
}

}  // namespace
}  // namespace terracut::files
