// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <lz4frame.h>
#include <zlib.h>
#include <zstd.h>

#include <cstdint>
#include <string>
#include <string_view>

#include "firmware_io/bag/mcap_records.hpp"

namespace terracut::test {

enum class Compression : std::uint8_t { kNone, kZstd, kLz4 };

/// Makes an MCAP file; its schemas and channels lie in the first chunk and, once it is finished, in
/// its summary.
class McapBytes {
 public:
  explicit McapBytes(Compression compression = Compression::kNone) : compression_(compression) {
    bytes_ += record(bag::Opcode::kHeader, text("ros2") + text("test"));
  }

  McapBytes& topic(std::string_view name, std::string_view type) {
    const auto id = static_cast<std::uint16_t>(topics_);
    const auto schema = static_cast<std::uint16_t>(++topics_);
    const std::string both =
        record(bag::Opcode::kSchema, number(schema) + text(type) + text("ros2msg") + text("")) +
        record(bag::Opcode::kChannel,
               number(id) + number(schema) + text(name) + text("cdr") + text(""));
    summary_ += both;
    chunk_ += both;
    return *this;
  }
  McapBytes& message(std::uint16_t topic, std::string_view content) {
    const std::uint64_t time_ns = 1'000'000'000 + ++messages_;
    chunk_ +=
        record(bag::Opcode::kMessage, number(topic) + number(std::uint32_t{0}) + number(time_ns) +
                                          number(time_ns) + std::string(content));
    return *this;
  }
  /// Ends a chunk.
  McapBytes& chunk() {
    const auto crc = static_cast<std::uint32_t>(
        ::crc32_z(0, reinterpret_cast<const unsigned char*>(chunk_.data()), chunk_.size()));
    const std::string packed_bytes = packed();
    constexpr std::string_view kNames[]{"", "zstd", "lz4"};
    bytes_ +=
        record(bag::Opcode::kChunk, number(std::uint64_t{0}) + number(std::uint64_t{0}) +
                                        number(std::uint64_t{chunk_.size()}) + number(crc) +
                                        text(kNames[static_cast<std::size_t>(compression_)]) +
                                        number(std::uint64_t{packed_bytes.size()}) + packed_bytes);
    chunk_.clear();
    return *this;
  }
  /// Returns the file with its end and summary.
  [[nodiscard]] std::string finished() const {
    const std::string data = bytes_ + record(bag::Opcode::kDataEnd, number(std::uint32_t{0}));
    return data + summary_ +
           record(bag::Opcode::kFooter, number(std::uint64_t{data.size()}) +
                                            number(std::uint64_t{0}) + number(std::uint32_t{0})) +
           std::string(bag::kMcapMagic);
  }

 private:
  template <class Number>
  static std::string number(Number value) {
    return {reinterpret_cast<const char*>(&value), sizeof value};
  }
  static std::string text(std::string_view value) {
    return number(static_cast<std::uint32_t>(value.size())) + std::string(value);
  }
  static std::string record(bag::Opcode opcode, const std::string& content) {
    return std::string(1, static_cast<char>(opcode)) + number(std::uint64_t{content.size()}) +
           content;
  }
  [[nodiscard]] std::string packed() const {
    std::string to;
    switch (compression_) {
      case Compression::kNone:
        return chunk_;
      case Compression::kZstd:
        to.resize(ZSTD_compressBound(chunk_.size()));
        to.resize(ZSTD_compress(to.data(), to.size(), chunk_.data(), chunk_.size(), 1));
        return to;
      case Compression::kLz4:
        to.resize(LZ4F_compressFrameBound(chunk_.size(), nullptr));
        to.resize(LZ4F_compressFrame(to.data(), to.size(), chunk_.data(), chunk_.size(), nullptr));
        return to;
    }
    return to;
  }

  Compression compression_;
  std::string bytes_{bag::kMcapMagic}, chunk_, summary_;
  std::size_t topics_ = 0;
  std::uint64_t messages_ = 0;
};

}  // namespace terracut::test
