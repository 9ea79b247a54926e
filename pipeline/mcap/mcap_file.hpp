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
#include <utility>
#include <vector>

#include "pipeline/mcap/record_writer.hpp"
#include "rt/error.hpp"
#include "rt/files/part_file.hpp"

struct ZSTD_CCtx_s;  // libzstd's ZSTD_CCtx

namespace terracut::mcap {

/// A channel of messages with their type.
struct Channel {
  std::string topic;
  std::string type, definition;  ///< Of the message type, with encoding "ros2msg".
  std::string offered_qos;       ///< In rosbag2's form (bag_metadata.hpp).
};

/// A recording in the format MCAP (mcap.dev/spec), for ROS 2: profile "ros2", messages in CDR;
/// chunks compressed by zstd, each with a checksum and followed by its index; statistics and an
/// index of all chunks at the end. Until close() the file has a temporary name, NAME.part-PID-N.
/// Full chunks are written to disk at once: if the process is killed, the temporary file stays and
/// can be read up to its last chunk. Not thread-safe; blocks on the disk.
class McapFile {
 public:
  using Metadata = std::vector<std::pair<std::string, std::string>>;

  /// Stores `metadata` under the name "terracut" unless it is empty. Fails with kWriteFailed.
  [[nodiscard]] static Expected<McapFile> create(std::filesystem::path path,
                                                 std::vector<Channel> channels,
                                                 const Metadata& metadata);
  McapFile(McapFile&&) noexcept = default;
  McapFile& operator=(McapFile&&) = delete;
  /// Without an earlier close(), the temporary file stays as it is.
  ~McapFile();

  /// Adds a message to the channel with this index in create()'s channels. Times are
  /// CLOCK_REALTIME; negative ones count as 1970. Fails with kWriteFailed.
  [[nodiscard]] Status add_message(std::size_t channel, std::int64_t time_ns,
                                   std::span<const std::byte> message);
  /// Completes the file and renames it; no call may follow. Fails with kWriteFailed.
  [[nodiscard]] Status close();

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }
  /// Returns the number of bytes on the disk and in the open chunk.
  [[nodiscard]] std::uint64_t bytes() const noexcept { return offset_ + chunk_.size(); }
  [[nodiscard]] std::uint64_t messages_of(std::size_t channel) const noexcept {
    return counts_[channel];
  }
  /// The first and the last time of the messages; both are 0 if there is no message.
  struct Span {
    std::uint64_t first_ns = 0, last_ns = 0;
  };
  [[nodiscard]] bool is_empty() const noexcept { return !span_; }
  [[nodiscard]] Span span() const noexcept { return span_.value_or(Span{}); }

 private:
  /// A chunk that reaches this size is closed. A frame is larger, so each frame of a running
  /// recording is on the disk when the next frame comes.
  static constexpr std::size_t kChunkBytes = 1 << 20;

  struct IndexEntry {
    std::uint64_t time_ns = 0, offset = 0;
  };
  struct ChunkPlace {
    Span span;
    std::uint64_t offset = 0, bytes = 0;
    std::vector<std::pair<std::uint16_t, std::uint64_t>> indexes{};  ///< Channel and offset.
    std::uint64_t index_bytes = 0, compressed_bytes = 0, plain_bytes = 0;
  };
  struct FreeCompressor {
    void operator()(ZSTD_CCtx_s* compressor) const noexcept;
  };

  McapFile(std::filesystem::path path, files::Part part, std::vector<Channel> channels);
  [[nodiscard]] Status begin(const Metadata& metadata);
  void add_schemas(RecordWriter& to) const;
  void add_channels(RecordWriter& to) const;
  void add_statistics(RecordWriter& to) const;
  static void add_chunk_index(const ChunkPlace& chunk, RecordWriter& to);
  [[nodiscard]] Status end_chunk();
  [[nodiscard]] Status write(std::span<const std::byte> bytes);
  [[nodiscard]] Status flush_records();

  std::filesystem::path path_;
  files::Part part_;
  std::vector<Channel> channels_;
  std::unique_ptr<ZSTD_CCtx_s, FreeCompressor> compressor_;
  std::vector<std::byte> compressed_;

  RecordWriter records_;  ///< Records outside chunks that are not written yet.
  RecordWriter chunk_;    ///< The content of the open chunk.
  std::optional<Span> chunk_span_, span_;
  std::vector<std::vector<IndexEntry>> index_;  ///< Index of the open chunk, by channel.
  std::vector<ChunkPlace> chunks_;
  std::vector<std::uint64_t> counts_;  ///< Number of messages by channel.
  std::uint64_t offset_ = 0;           ///< Bytes written.
  std::uint32_t data_crc_ = 0;         ///< Checksum of the bytes written.
  std::optional<std::pair<std::uint64_t, std::uint64_t>> metadata_;  ///< Offset and length.
};

}  // namespace terracut::mcap
