// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "firmware_io/bag/bag_file.hpp"
#include "firmware_io/bag/temporary_file.hpp"
#include "rt/error.hpp"

namespace terracut::bag {

/// True for a file's name that ends in .mcap or .db3, or in either and .zstd or .zst.
[[nodiscard]] bool is_bag_name(const std::filesystem::path& path);

/// The name of the file by which rosbag2 marks a bag's folder. It is not read.
inline constexpr const char* kMetadataFile = "metadata.yaml";

/// True if `path` is a bag: a file that begins as MCAP's or SQLite's, a file of these packed whole
/// by zstd (.mcap.zstd, .db3.zstd), or a folder with such files and a metadata.yaml, as `ros2 bag`
/// makes it, or with files of one name and a number each, as it leaves it when it is killed.
[[nodiscard]] bool is_bag(const std::filesystem::path& path);

/// Returns the files of a bag in their order; of a bag that is a file, that file.
[[nodiscard]] std::vector<std::filesystem::path> files_of(const std::filesystem::path& bag);

/// A recording of ROS 2's messages: MCAP files, or those of rosbag2's sqlite3 storage. The files of
/// a folder are read one after the other, in the order of the numbers in their names, whether or
/// not a metadata.yaml names them; messages come in the order of recording. Messages packed one by
/// one by zstd are unpacked, as are whole files, these to the folder for temporary files. Not
/// thread-safe; blocks on the disk.
class Bag {
 public:
  /// Fails with kNotFound, kUnreadable, kMalformed, kUnsupported or, if a file cannot be unpacked,
  /// kWriteFailed; the message names the file.
  [[nodiscard]] static Expected<Bag> open(const std::filesystem::path& path);

  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  /// Returns the topics with messages in CDR of all files.
  [[nodiscard]] const std::vector<Topic>& topics() const noexcept { return topics_; }

  /// Where a message lies; Position{} is the beginning.
  struct Position {
    std::size_t file = 0;
    Place place{};
  };
  struct Found {
    Message message;
    Position position;
  };
  /// Returns the next message of the topics for which `wanted` is true; nothing at the end. Fails
  /// as BagFile::next() and open() do; every further call then fails in the same way.
  [[nodiscard]] Expected<std::optional<Found>> next(const std::vector<bool>& wanted);
  /// Goes to a message that next() returned, or to the beginning.
  [[nodiscard]] Status seek(Position position);

 private:
  explicit Bag(std::string name) : name_(std::move(name)) {}
  [[nodiscard]] Status open_file(std::size_t index);

  std::string name_;
  std::vector<std::filesystem::path> files_;
  std::vector<Topic> topics_;
  std::optional<TemporaryFile> unpacked_;  ///< Of the open file, if that is packed.
  std::unique_ptr<BagFile> file_;          ///< Null at the end, and after a fault.
  std::size_t open_ = 0;                   ///< Index of the open file.
  std::vector<std::size_t> topic_of_;      ///< The bag's topic for each topic of the open file.
  std::vector<bool> wanted_here_;          ///< Topics of the open file.
  std::vector<std::byte> plain_;           ///< A message that was packed.
  std::optional<Error> broke_off_;
};

}  // namespace terracut::bag
