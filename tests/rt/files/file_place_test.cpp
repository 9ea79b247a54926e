// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/files/file_place.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/support/scratch_folder.hpp"

namespace terracut::files {
namespace {

namespace fs = std::filesystem;

class FilePlaces : public test::InScratchFolder {
 protected:
  void SetUp() override {
    fs::create_directory(folder_ / "d");
    std::ofstream(folder_ / "d" / "file") << "x";
  }
  [[nodiscard]] bool same(const fs::path& a, const fs::path& b) const {
    return FilePlace(folder_ / a).is_same_as(FilePlace(folder_ / b));
  }
  [[nodiscard]] bool in(const fs::path& a, const fs::path& b) const {
    return FilePlace(folder_ / a).lies_in(FilePlace(folder_ / b));
  }
};

TEST_F(FilePlaces, OfOneFileAreOneWhateverItIsCalled) {
  fs::create_symlink("d/file", folder_ / "link");
  fs::create_directory_symlink("d", folder_ / "e");
  fs::create_hard_link(folder_ / "d" / "file", folder_ / "hard");
  for (const char* name : {"d/file", "d/../d/./file", "link", "e/file", "hard"}) {
    EXPECT_TRUE(same(name, "d/file")) << name;
  }
  const fs::path back = fs::current_path();
  fs::current_path(folder_ / "d");
  EXPECT_TRUE(FilePlace("file").is_same_as(FilePlace(folder_ / "d" / "file")));
  EXPECT_TRUE(FilePlace("new").is_same_as(FilePlace(folder_ / "d" / "new")));
  fs::current_path(back);
}

TEST_F(FilePlaces, OfWhatIsNotThereAreKnownByTheirFolder) {
  fs::create_directory_symlink("d", folder_ / "e");
  EXPECT_TRUE(same("d/new", "e/new"));
  EXPECT_TRUE(same("d/new", "d/new/"));
  EXPECT_TRUE(same("d/x/new", "e/x/y/../new"));
  EXPECT_FALSE(same("d/new", "d/newer"));
  EXPECT_FALSE(same("d/new", "d/file"));
}

TEST_F(FilePlaces, LieInAFolderAtAnyDepthThroughLinks) {
  fs::create_directory_symlink("d", folder_ / "e");
  EXPECT_TRUE(in("d/file", "d"));
  EXPECT_TRUE(in("e/file", "d"));
  EXPECT_TRUE(in("d/x/y", "e"));
  EXPECT_TRUE(in("absent/x/y", "absent"));
  EXPECT_FALSE(in("d", "d"));
  EXPECT_FALSE(in("d", "d/file"));
  EXPECT_FALSE(in("dd/x", "d"));
}

}  // namespace
}  // namespace terracut::files
