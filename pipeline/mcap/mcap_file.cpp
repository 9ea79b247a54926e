// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/mcap/mcap_file.hpp"

#include <fmt/format.h>
#include <unistd.h>
#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

namespace terracut::mcap {
namespace {

using bag::Opcode;

constexpr std::string_view kProfile = "ros2";
constexpr std::string_view kLibrary = "terracut " TERRACUT_VERSION;
constexpr std::string_view kMetadataName = "terracut";
constexpr int kCompressionLevel = 1;  // the fastest: a chunk must be done within a frame's time

tl::unexpected<Error> write_failed(const std::filesystem::path& path, int error_number) {
  return fail(ErrorCode::kWriteFailed,
              fmt::format("{}: cannot be written: {}", path.string(), std::strerror(error_number)));
}

std::uint32_t crc_of(std::span<const std::byte> bytes, std::uint32_t so_far = 0) noexcept {
  return static_cast<std::uint32_t>(
      ::crc32_z(so_far, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

/// Returns a schema's or channel's id, which counts from 1: 0 means no schema.
std::uint16_t id_of(std::size_t index) noexcept {
  return static_cast<std::uint16_t>(index + 1);
}

template <class Span>
void widen(std::optional<Span>& span, std::uint64_t time_ns) noexcept {
  if (!span) span = Span{time_ns, time_ns};
  span->first_ns = std::min(span->first_ns, time_ns);
  span->last_ns = std::max(span->last_ns, time_ns);
}

}  // namespace

void McapFile::FreeCompressor::operator()(ZSTD_CCtx_s* compressor) const noexcept {
  ::ZSTD_freeCCtx(compressor);
}

Expected<McapFile> McapFile::create(std::filesystem::path path, std::vector<Channel> channels,
                                    const Metadata& metadata) {
  files::Part part = files::make_part_file(path);
  if (!part.lock) return write_failed(path, errno);
  McapFile file(std::move(path), std::move(part), std::move(channels));
  if (const Status begun = file.begin(metadata); !begun) {
    ::unlink(file.part_.path.c_str());
    return tl::unexpected(begun.error());
  }
  return file;
}

McapFile::McapFile(std::filesystem::path path, files::Part part, std::vector<Channel> channels)
    : path_(std::move(path)),
      part_(std::move(part)),
      channels_(std::move(channels)),
      compressor_(::ZSTD_createCCtx()),
      index_(channels_.size()),
      counts_(channels_.size()) {}

McapFile::~McapFile() {
  if (part_.lock) (void)end_chunk();
}

Status McapFile::begin(const Metadata& metadata) {
  if (const Status written = write(std::as_bytes(std::span(bag::kMcapMagic))); !written) return written;
  records_.begin(Opcode::kHeader);
  records_.add(kProfile);
  records_.add(kLibrary);
  records_.end();
  if (!metadata.empty()) {
    const std::size_t at = records_.size();
    records_.begin(Opcode::kMetadata);
    records_.add(kMetadataName);
    records_.begin_elements();
    for (const auto& [key, value] : metadata) {
      records_.add(std::string_view(key));
      records_.add(std::string_view(value));
    }
    records_.end_elements();
    records_.end();
    metadata_ = {offset_ + at, records_.size() - at};
  }
  add_schemas(records_);
  add_channels(records_);
  return flush_records();
}

void McapFile::add_schemas(RecordWriter& to) const {
  // Writes each message type's schema once, under the number of the first channel with that type.
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    const Channel& channel = channels_[i];
    const auto first = std::ranges::find(channels_, channel.type, &Channel::type);
    if (first - channels_.begin() != static_cast<std::ptrdiff_t>(i)) continue;
    to.begin(Opcode::kSchema);
    to.add(id_of(i));
    to.add(std::string_view(channel.type));
    to.add(std::string_view("ros2msg"));
    to.add(std::string_view(channel.definition));
    to.end();
  }
}

void McapFile::add_channels(RecordWriter& to) const {
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    const Channel& channel = channels_[i];
    const auto schema = std::ranges::find(channels_, channel.type, &Channel::type);
    to.begin(Opcode::kChannel);
    to.add(id_of(i));
    to.add(id_of(static_cast<std::size_t>(schema - channels_.begin())));
    to.add(std::string_view(channel.topic));
    to.add(std::string_view("cdr"));
    to.begin_elements();
    to.add(std::string_view("offered_qos_profiles"));
    to.add(std::string_view(channel.offered_qos));
    to.end_elements();
    to.end();
  }
}

Status McapFile::add_message(std::size_t channel, std::int64_t time_ns,
                             std::span<const std::byte> message) {
  const auto log_time_ns = static_cast<std::uint64_t>(std::max<std::int64_t>(time_ns, 0));
  index_[channel].push_back({log_time_ns, chunk_.size()});
  chunk_.begin(Opcode::kMessage);
  chunk_.add(id_of(channel));
  chunk_.add(static_cast<std::uint32_t>(counts_[channel]++));
  chunk_.add(log_time_ns);
  chunk_.add(log_time_ns);  // publish time
  chunk_.append(message);
  chunk_.end();
  widen(chunk_span_, log_time_ns);
  widen(span_, log_time_ns);
  return chunk_.size() >= kChunkBytes ? end_chunk() : Status{};
}

Status McapFile::end_chunk() {
  if (!chunk_span_) return {};
  compressed_.resize(::ZSTD_compressBound(chunk_.size()));
  const std::size_t bytes =
      ::ZSTD_compressCCtx(compressor_.get(), compressed_.data(), compressed_.size(),
                          chunk_.bytes().data(), chunk_.size(), kCompressionLevel);
  if (::ZSTD_isError(bytes) != 0) {
    return fail(ErrorCode::kWriteFailed, fmt::format("{}: cannot be compressed: {}", path_.string(),
                                                     ::ZSTD_getErrorName(bytes)));
  }
  ChunkPlace place{.span = *chunk_span_,
                   .offset = offset_,
                   .compressed_bytes = bytes,
                   .plain_bytes = chunk_.size()};
  records_.begin(Opcode::kChunk);
  records_.add(place.span.first_ns);
  records_.add(place.span.last_ns);
  records_.add(place.plain_bytes);
  records_.add(crc_of(chunk_.bytes()));
  records_.add(std::string_view("zstd"));
  records_.add(place.compressed_bytes);
  records_.append(std::span(compressed_).first(bytes));
  records_.end();
  place.bytes = records_.size();
  for (std::size_t channel = 0; channel < index_.size(); ++channel) {
    if (index_[channel].empty()) continue;
    place.indexes.emplace_back(id_of(channel), offset_ + records_.size());
    std::ranges::sort(index_[channel], {}, [](const IndexEntry& entry) {
      return std::pair(entry.time_ns, entry.offset);
    });
    records_.begin(Opcode::kMessageIndex);
    records_.add(id_of(channel));
    records_.begin_elements();
    for (const IndexEntry& entry : index_[channel]) {
      records_.add(entry.time_ns);
      records_.add(entry.offset);
    }
    records_.end_elements();
    records_.end();
    index_[channel].clear();
  }
  place.index_bytes = records_.size() - place.bytes;
  chunks_.push_back(std::move(place));
  chunk_.clear();
  chunk_span_.reset();
  return flush_records();
}

void McapFile::add_statistics(RecordWriter& to) const {
  std::uint64_t messages = 0;
  for (const std::uint64_t count : counts_) messages += count;
  std::uint16_t schemas = 0;
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    const auto first = std::ranges::find(channels_, channels_[i].type, &Channel::type);
    if (first - channels_.begin() == static_cast<std::ptrdiff_t>(i)) ++schemas;
  }
  to.begin(Opcode::kStatistics);
  to.add(messages);
  to.add(schemas);
  to.add(static_cast<std::uint32_t>(channels_.size()));
  to.add(std::uint32_t{0});  // attachments
  to.add(static_cast<std::uint32_t>(metadata_ ? 1 : 0));
  to.add(static_cast<std::uint32_t>(chunks_.size()));
  to.add(span().first_ns);
  to.add(span().last_ns);
  to.begin_elements();
  for (std::size_t channel = 0; channel < counts_.size(); ++channel) {
    to.add(id_of(channel));
    to.add(counts_[channel]);
  }
  to.end_elements();
  to.end();
}

void McapFile::add_chunk_index(const ChunkPlace& chunk, RecordWriter& to) {
  to.begin(Opcode::kChunkIndex);
  to.add(chunk.span.first_ns);
  to.add(chunk.span.last_ns);
  to.add(chunk.offset);
  to.add(chunk.bytes);
  to.begin_elements();
  for (const auto& [channel, offset] : chunk.indexes) {
    to.add(channel);
    to.add(offset);
  }
  to.end_elements();
  to.add(chunk.index_bytes);
  to.add(std::string_view("zstd"));
  to.add(chunk.compressed_bytes);
  to.add(chunk.plain_bytes);
  to.end();
}

Status McapFile::close() {
  if (const Status ended = end_chunk(); !ended) return ended;
  records_.begin(Opcode::kDataEnd);
  records_.add(data_crc_);
  records_.end();
  if (const Status written = flush_records(); !written) return written;

  const std::uint64_t summary_start = offset_;
  struct Group {
    Opcode opcode;
    std::uint64_t start, bytes;
  };
  std::vector<Group> groups;
  const auto add_group = [&](Opcode opcode, auto&& fill) {
    const std::uint64_t start = summary_start + records_.size();
    fill();
    const std::uint64_t bytes = summary_start + records_.size() - start;
    if (bytes > 0) groups.push_back({opcode, start, bytes});
  };
  add_group(Opcode::kSchema, [&] { add_schemas(records_); });
  add_group(Opcode::kChannel, [&] { add_channels(records_); });
  add_group(Opcode::kStatistics, [&] { add_statistics(records_); });
  add_group(Opcode::kChunkIndex, [&] {
    for (const ChunkPlace& chunk : chunks_) add_chunk_index(chunk, records_);
  });
  add_group(Opcode::kMetadataIndex, [&] {
    if (!metadata_) return;
    records_.begin(Opcode::kMetadataIndex);
    records_.add(metadata_->first);
    records_.add(metadata_->second);
    records_.add(kMetadataName);
    records_.end();
  });
  const std::uint64_t summary_offset_start = summary_start + records_.size();
  for (const Group& group : groups) {
    records_.begin(Opcode::kSummaryOffset);
    records_.add(static_cast<std::uint8_t>(group.opcode));
    records_.add(group.start);
    records_.add(group.bytes);
    records_.end();
  }
  // The footer ends with a checksum over the summary and the footer itself, including the length of
  // the footer's record.
  constexpr std::uint64_t kFooterBytes = 8 + 8 + 4;
  records_.add(static_cast<std::uint8_t>(Opcode::kFooter));
  records_.add(kFooterBytes);
  records_.add(summary_start);
  records_.add(summary_offset_start);
  records_.add(crc_of(records_.bytes()));
  records_.append(std::as_bytes(std::span(bag::kMcapMagic)));
  if (const Status written = flush_records(); !written) return written;

  // A network file system may report only now that there was no room.
  if (::close(::dup(part_.lock.get())) != 0 ||
      std::rename(part_.path.c_str(), path_.c_str()) != 0) {
    return write_failed(path_, errno);
  }
  part_.lock.close();
  return {};
}

Status McapFile::flush_records() {
  const Status written = write(records_.bytes());
  records_.clear();
  return written;
}

Status McapFile::write(std::span<const std::byte> bytes) {
  data_crc_ = crc_of(bytes, data_crc_);
  offset_ += bytes.size();
  while (!bytes.empty()) {
    const ::ssize_t written = ::write(part_.lock.get(), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return write_failed(path_, errno);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return {};
}

}  // namespace terracut::mcap
