// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdlib>
#include <set>
#include <string>

#include "tests/tools/cli/cli_fixture.hpp"
#include "tools/cli/fleet/labelled_drive.hpp"

namespace terracut::cli {

/// A fleet below "fleet" in the test's folder, and what `terracut relabel` makes of it in "out".
class Relabel : public Cli {
 protected:
  /// The test drive and its table under another name. Small, for nothing is copied.
  void add_drive(const std::string& name) const {
    const fs::path place = folder_ / "fleet" / (name + ".pcap");
    fs::create_directories(place.parent_path());
    fs::create_symlink(kDrive, place);
    fs::copy_file(kDriveCalibration, fs::path(place).replace_extension("calibration.xml"));
  }
  /// One that a test may change.
  void copy_drive(const std::string& name) const {
    const fs::path place = folder_ / "fleet" / (name + ".pcap");
    fs::create_directories(place.parent_path());
    fs::copy_file(kDrive, place);
    fs::copy_file(kDriveCalibration, fs::path(place).replace_extension("calibration.xml"));
  }
  void make_manifest() const { expect_done("manifest fleet -o m.json"); }

  /// The drives' folders in "out", below it, whole or not.
  [[nodiscard]] std::set<std::string> outputs() const {
    std::set<std::string> found;
    if (!fs::exists(folder_ / "out")) return found;
    fs::recursive_directory_iterator entry(folder_ / "out");
    for (; entry != fs::recursive_directory_iterator(); ++entry) {
      const std::string name = entry->path().filename().string();
      if (name == ".relabel") entry.disable_recursion_pending();
      if (name == kDriveSums || name.ends_with(".label")) {
        found.insert(entry->path().parent_path().lexically_relative(folder_ / "out").string());
      }
    }
    return found;
  }
  /// That every one of them has what its sums say.
  void expect_outputs_whole() const {
    for (const std::string& output : outputs()) {
      EXPECT_FALSE(facts_of_whole(folder_ / "out" / output).is_null()) << output;
      const std::string check =
          "cd " + quoted(folder_ / "out" / output) + " && sha256sum --quiet --strict -c SHA256SUMS";
      EXPECT_EQ(std::system(check.c_str()), 0) << output;
    }
  }
  /// That a folder holds the labels of `terracut replay` of the test drive.
  void expect_labels_of_replay(const std::string& output) const {
    if (!fs::exists(folder_ / "replayed")) {
      expect_done("replay " + quoted(kDrive) + " --calibration " + quoted(kDriveCalibration) +
                  " --labels replayed");
    }
    const fs::path labels = folder_ / "out" / output;
    EXPECT_EQ(files_in(labels, ".label"), kDriveFrames);
    for (const auto& entry : fs::directory_iterator(folder_ / "replayed")) {
      const fs::path name = entry.path().filename();
      if (name.extension() != ".label") continue;
      EXPECT_EQ(content_of(entry.path()), content_of(labels / name)) << output << "/" << name;
    }
  }
  [[nodiscard]] bool parts_are_gone() const {
    return fs::is_empty(folder_ / "out" / ".relabel" / "parts");
  }
};

}  // namespace terracut::cli
