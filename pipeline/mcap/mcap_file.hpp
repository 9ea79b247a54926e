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

/// A channel of messages, and the type they have.
struct Channel {
  std::string topic;
  std::string type, definition;  ///< Of its schema, encoding "ros2msg".
  std::string offered_qos;       ///< As rosbag2 has it (bag_metadata.hpp).
};

/// A recording in the format MCAP (mcap.dev/spec), for ROS 2: profile "ros2", messages in CDR;
/// chunks compressed by zstd, each with the sum of its content and followed by its index; at the
/// end statistics and an index of all chunks. It has a temporary name, NAME.part-PID-N, until
/// close(). Whole chunks are on the disk from when they are full: of a process that is killed,
/// the temporary file stays and can be read up to its last chunk. Not thread-safe; blocks on the
/// disk.
class McapFile {
 public:
  using Metadata = std::vector<std::pair<std::string, std::string>>;

  /// kWriteFailed. `metadata`: kept in the file under the name "terracut", where there is any.
  [[nodiscard]] static Expected<McapFile> create(std::filesystem::path path,
                                                 std::vector<Channel> channels,
                                                 const Metadata& metadata);
  McapFile(McapFile&&) noexcept = default;
  McapFile& operator=(McapFile&&) = delete;
  /// Without close() the temporary file is closed as far as it is and stays.
  ~McapFile();

  /// `channel`: index of create()'s. Times are CLOCK_REALTIME; before 1970 is 1970. kWriteFailed.
  [[nodiscard]] Status add_message(std::size_t channel, std::int64_t time_ns,
                                   std::span<const std::byte> message);
  /// Completes the file and gives it its name. kWriteFailed. Nothing may follow.
  [[nodiscard]] Status close();

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }
  /// On the disk, and waiting for their chunk to be full.
  [[nodiscard]] std::uint64_t bytes() const noexcept { return offset_ + chunk_.size(); }
  [[nodiscard]] std::uint64_t messages_of(std::size_t channel) const noexcept {
    return counts_[channel];
  }
  /// Of its messages; none yet: both 0.
  struct Span {
    std::uint64_t first_ns = 0, last_ns = 0;
  };
  [[nodiscard]] bool is_empty() const noexcept { return !span_; }
  [[nodiscard]] Span span() const noexcept { return span_.value_or(Span{}); }

 private:
  /// Content of a chunk from which on it is closed: a frame is more, so that each frame of a
  /// running recording is on the disk when the next one comes.
  static constexpr std::size_t kChunkBytes = 1 << 20;

  struct IndexEntry {
    std::uint64_t time_ns = 0, offset = 0;
  };
  struct ChunkPlace {
    Span span;
    std::uint64_t offset = 0, bytes = 0;
    std::vector<std::pair<std::uint16_t, std::uint64_t>> indexes{};  ///< Channel, offset.
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

  RecordWriter records_;  ///< Outside of chunks, to be written.
  RecordWriter chunk_;    ///< The content of the one that is being filled.
  std::optional<Span> chunk_span_, span_;
  std::vector<std::vector<IndexEntry>> index_;  ///< Of that chunk, by channel.
  std::vector<ChunkPlace> chunks_;
  std::vector<std::uint64_t> counts_;                                ///< Messages by channel.
  std::uint64_t offset_ = 0;                                         ///< Bytes written.
  std::uint32_t data_crc_ = 0;                                       ///< Of them.
  std::optional<std::pair<std::uint64_t, std::uint64_t>> metadata_;  ///< Offset and length.
};

}  // namespace terracut::mcap
