// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/places.hpp"
#include "tests/support/scratch_folder.hpp"

namespace terracut::cli {

namespace fs = std::filesystem;

using test::content_of;

[[nodiscard]] inline std::vector<std::uint32_t> ids_of(const fs::path& path) {
  const std::string bytes = content_of(path);
  std::vector<std::uint32_t> ids(bytes.size() / 4);
  std::memcpy(ids.data(), bytes.data(), ids.size() * 4);
  return ids;
}

[[nodiscard]] inline std::size_t files_in(const fs::path& folder, const std::string& extension) {
  std::size_t count = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == extension) ++count;
  }
  return count;
}

struct Outcome {
  int exit_code = -1;
  std::string out, err;
};

/// A folder of this test's own and the built program to run in it.
class Cli : public test::InScratchFolder {
 protected:
  void SetUp() override {
    ::setenv("STATE_DIRECTORY", folder_.c_str(), 1);  // what live runs remember goes with the test
  }
  /// Runs `terracut ARGUMENTS` with the test's folder as working directory. From any thread.
  [[nodiscard]] Outcome run(const std::string& arguments) const {
    static std::atomic<int> runs = 0;
    const std::string number = std::to_string(runs++);
    const std::string out = "stdout" + number + ".txt", err = "stderr" + number + ".txt";
    const std::string command = "cd '" + folder_.string() + "' && '" + test::program().string() +
                                "' " + arguments + " >" + out + " 2>" + err;
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content_of(folder_ / out),
            content_of(folder_ / err)};
  }
  void expect_done(const std::string& arguments) const {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << arguments << "\n" << outcome.out << outcome.err;
  }
  [[nodiscard]] nlohmann::json json(const std::string& name) const {
    return nlohmann::json::parse(content_of(folder_ / name), nullptr, false);
  }
};

/// 1.3 s of the scene "street": 13 frames, and one whole round of the status stream.
inline const fs::path kDrive = test::drive();
inline const fs::path kDriveCalibration = fs::path(kDrive).replace_extension("calibration.xml");
inline const fs::path kDriveTruth = fs::path(kDrive).replace_extension("truth");
inline constexpr std::size_t kDriveFrames = 13;

[[nodiscard]] inline std::string quoted(const fs::path& path) {
  return "'" + path.string() + "'";
}

}  // namespace terracut::cli
