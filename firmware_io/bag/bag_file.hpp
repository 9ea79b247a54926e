// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rt/error.hpp"

namespace terracut::bag {

/// The most topics of a file, and the most characters of a topic's name or type; further and longer
/// ones are passed over.
inline constexpr std::size_t kMostTopics = 4096, kLongestName = 1000;

struct Topic {
  std::string name;  ///< "/velodyne_points"
  std::string type;  ///< "sensor_msgs/msg/PointCloud2"

  friend bool operator==(const Topic&, const Topic&) = default;
};

/// Where a message begins in its file.
struct Place {
  std::uint64_t block = 0;  ///< MCAP: offset of its chunk, 0 outside chunks. SQLite: 0.
  std::uint64_t item = 0;   ///< MCAP: offset in the chunk or file. SQLite: the row.
};

struct Message {
  std::size_t topic = 0;      ///< Index of the topic.
  std::int64_t stamp_ns = 0;  ///< When it was recorded, nanoseconds since 1970, not negative.
  Place place;
  std::span<const std::byte> bytes;  ///< In CDR; valid until the next call.
};

/// One file of a bag, read message by message in the order of recording. Not thread-safe; blocks
/// on the disk; no message or chunk takes more than kMostBytes. Errors name the file.
class BagFile {
 public:
  BagFile() = default;
  BagFile(const BagFile&) = delete;
  BagFile& operator=(const BagFile&) = delete;
  virtual ~BagFile() = default;

  /// Returns the topics with messages in CDR.
  [[nodiscard]] virtual const std::vector<Topic>& topics() const noexcept = 0;
  /// Returns the next message of the topics for which `wanted` is true; nothing at the end. Fails
  /// with kMalformed where the file breaks off, after all whole messages before that; every
  /// further call then fails in the same way, until seek().
  [[nodiscard]] virtual Expected<std::optional<Message>> next(const std::vector<bool>& wanted) = 0;
  /// Goes to a message that next() returned, or with Place{} to the beginning.
  [[nodiscard]] virtual Status seek(Place place) = 0;
};

using OpenedFile = Expected<std::unique_ptr<BagFile>>;

[[nodiscard]] bool begins_as_mcap(std::span<const std::byte> first_bytes) noexcept;
[[nodiscard]] bool begins_as_sqlite(std::span<const std::byte> first_bytes) noexcept;
/// Enough first bytes for both.
inline constexpr std::size_t kFirstBytes = 16;

/// Opens an MCAP file; `name` stands for its path in messages. Reads its summary, or the whole file
/// if it was not completed. Fails with kNotFound, kUnreadable or kMalformed.
[[nodiscard]] OpenedFile open_mcap(const std::filesystem::path& path, std::string name);
/// Reads an MCAP file from memory, which must outlive the result.
[[nodiscard]] OpenedFile open_mcap(std::span<const std::byte> bytes, std::string name);
/// Opens a file of rosbag2's sqlite3 storage. Fails as open_mcap() does, or with kUnsupported if
/// the program was built without SQLite.
[[nodiscard]] OpenedFile open_sqlite(const std::filesystem::path& path, std::string name);

}  // namespace terracut::bag
