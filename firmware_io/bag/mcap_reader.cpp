// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <map>
#include <system_error>
#include <utility>

#include "firmware_io/bag/bag_file.hpp"
#include "firmware_io/bag/mcap_records.hpp"
#include "firmware_io/bag/unpacked.hpp"
#include "rt/files/plain_file.hpp"

namespace terracut::bag {
namespace {

/// The bytes of a file, or of memory.
class ByteSource {
 public:
  explicit ByteSource(std::span<const std::byte> memory) : memory_(memory), size_(memory.size()) {}
  ByteSource(files::OwnedDescriptor file, std::uint64_t size)
      : file_(std::move(file)), size_(size) {}

  [[nodiscard]] std::uint64_t size() const noexcept { return size_; }

  /// Reads bytes from `offset` on into `bytes`; true if the source has all of them.
  [[nodiscard]] bool read(std::uint64_t offset, std::span<std::byte> bytes) const {
    if (offset > size_ || bytes.size() > size_ - offset) return false;
    if (!file_) {
      std::ranges::copy(memory_.subspan(offset, bytes.size()), bytes.begin());
      return true;
    }
    while (!bytes.empty()) {
      const ::ssize_t got =
          ::pread(file_.get(), bytes.data(), bytes.size(), static_cast<::off_t>(offset));
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) return false;
      bytes = bytes.subspan(static_cast<std::size_t>(got));
      offset += static_cast<std::uint64_t>(got);
    }
    return true;
  }

 private:
  std::span<const std::byte> memory_;
  files::OwnedDescriptor file_;
  std::uint64_t size_;
};

struct RecordHeader {
  Opcode opcode{};
  std::uint64_t bytes = 0;  ///< Of the content.
};

RecordHeader header_of(std::span<const std::byte, kRecordHeaderBytes> bytes) {
  FieldReader fields(bytes);
  const auto opcode = static_cast<Opcode>(fields.number<std::uint8_t>());
  return {opcode, fields.number<std::uint64_t>()};
}

class McapReader final : public BagFile {
 public:
  McapReader(ByteSource source, std::string name)
      : source_(std::move(source)), name_(std::move(name)) {}

  /// Finds the topics: in the summary, or in the whole file if it has no summary.
  Status begin() {
    std::array<std::byte, kMcapMagic.size()> magic{};
    if (!source_.read(0, magic) || !begins_as_mcap(magic)) {
      return fail(ErrorCode::kMalformed, name_ + ": is no MCAP file");
    }
    if (!read_summary()) {
      const std::vector<bool> none;
      (void)seek({});
      for (auto message = next(none); message && *message; message = next(none)) {
      }
    }
    knows_topics_ = true;
    return seek({});
  }

  [[nodiscard]] const std::vector<Topic>& topics() const noexcept override { return topics_; }

  [[nodiscard]] Expected<std::optional<Message>> next(const std::vector<bool>& wanted) override {
    while (!broke_off_) {
      const auto record = chunk_offset_ != 0 ? next_in_chunk() : next_in_file();
      if (!record) break;
      if (record->opcode == Opcode::kDataEnd || record->opcode == Opcode::kFooter) {
        return std::nullopt;
      }
      if (record->opcode == Opcode::kMessage) {
        if (auto message = message_in(*record, wanted)) return message;
      } else if (!knows_topics_) {
        learn(record->opcode, record->content);
      }
    }
    return tl::unexpected(*broke_off_);
  }

  [[nodiscard]] Status seek(Place place) override {
    broke_off_.reset();
    const bool is_in_this_chunk = place.block != 0 && place.block == loaded_offset_;
    if (place.block == 0) {
      chunk_offset_ = 0;
      offset_ = std::max<std::uint64_t>(place.item, kMcapMagic.size());
      return {};
    }
    offset_ = place.block;
    chunk_offset_ = 0;
    if (!is_in_this_chunk && !next_in_file()) return tl::unexpected(*broke_off_);
    chunk_offset_ = loaded_offset_ = place.block;
    offset_ = loaded_end_;
    in_chunk_ = place.item;
    return {};
  }

 private:
  struct Record {
    Opcode opcode{};
    std::uint64_t offset = 0;  ///< In the chunk, or in the file.
    std::span<const std::byte> content;
  };

  void break_off(std::string why) {
    broke_off_ = Error{ErrorCode::kMalformed,
                       fmt::format("{}: breaks off at byte {}: {}; what came before it is read",
                                   name_, offset_, why)};
  }

  /// Returns the next record of the file that is not skipped. Of a chunk, which it opens, it
  /// returns an empty record. Returns nothing, and breaks off, at a fault.
  std::optional<Record> next_in_file() {
    std::array<std::byte, kRecordHeaderBytes> head{};
    if (!source_.read(offset_, head)) {
      break_off(offset_ == source_.size() ? "it has no end, so its recording was interrupted"
                                          : "a record is cut off");
      return std::nullopt;
    }
    const RecordHeader header = header_of(head);
    const std::uint64_t begin = offset_ + kRecordHeaderBytes, left = source_.size() - begin;
    if (header.opcode == Opcode::kChunk) return open_chunk(begin, header.bytes, left);
    if (header.bytes > left) {
      break_off(fmt::format("a record of {} bytes, of which {} are there", header.bytes, left));
      return std::nullopt;
    }
    Record record{header.opcode, offset_, {}};
    const bool is_read = header.opcode == Opcode::kMessage || header.opcode == Opcode::kSchema ||
                         header.opcode == Opcode::kChannel;
    if (is_read) {
      if (header.bytes > kMostBytes) {
        break_off(
            fmt::format("a record of {} bytes, more than {} MiB", header.bytes, kMostBytes >> 20));
        return std::nullopt;
      }
      record_.resize(header.bytes);
      if (!source_.read(begin, record_)) {
        break_off("it cannot be read");
        return std::nullopt;
      }
      record.content = record_;
    }
    offset_ = begin + header.bytes;
    return record;
  }

  std::optional<Record> open_chunk(std::uint64_t begin, std::uint64_t bytes, std::uint64_t left) {
    if (std::min(bytes, left) > kMostBytes) {
      break_off(fmt::format("a chunk of {} bytes, more than {} MiB", bytes, kMostBytes >> 20));
      return std::nullopt;
    }
    record_.resize(std::min(bytes, left));
    if (!source_.read(begin, record_)) {
      break_off("it cannot be read");
      return std::nullopt;
    }
    FieldReader fields(record_);
    (void)fields.number<std::uint64_t>();  // times of the first and the last message
    (void)fields.number<std::uint64_t>();
    const auto plain_bytes = fields.number<std::uint64_t>();
    const auto crc = fields.number<std::uint32_t>();
    const std::string_view compression = fields.text();
    const auto packed_bytes = fields.number<std::uint64_t>();
    if (fields.failed() || (bytes <= left && packed_bytes > fields.rest().size())) {
      break_off(bytes > left ? "a chunk is cut off" : "a chunk with wrong lengths");
      return std::nullopt;
    }
    const auto packed = fields.rest().first(
        static_cast<std::size_t>(std::min<std::uint64_t>(packed_bytes, fields.rest().size())));
    chunk_fault_.clear();
    if (compression.empty()) {
      chunk_.assign(packed.begin(), packed.end());
    } else if (const Status unpacked = unpack(compression, packed, chunk_); !unpacked) {
      chunk_fault_ = "a chunk: " + unpacked.error().message;
    }
    if (bytes > left) {
      chunk_fault_ = "a chunk is cut off";
    } else if (chunk_fault_.empty() && chunk_.size() != plain_bytes) {
      chunk_fault_ =
          fmt::format("a chunk of {} bytes, not {} as it says", chunk_.size(), plain_bytes);
    } else if (chunk_fault_.empty() && crc != 0 && crc != checksum_of(chunk_)) {
      chunk_fault_ = "a chunk's checksum is wrong";
      chunk_.clear();
    }
    loaded_offset_ = chunk_offset_ = offset_;
    offset_ = loaded_end_ = begin + record_.size();
    in_chunk_ = 0;
    return Record{};
  }

  static std::uint32_t checksum_of(std::span<const std::byte> bytes) {
    return static_cast<std::uint32_t>(
        ::crc32_z(0, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
  }

  /// Returns the chunk's next record; an empty one at its end, which closes it.
  std::optional<Record> next_in_chunk() {
    const std::span<const std::byte> chunk(chunk_);
    if (in_chunk_ >= chunk.size()) {
      if (!chunk_fault_.empty()) {
        offset_ = chunk_offset_;
        break_off(chunk_fault_);
        return std::nullopt;
      }
      chunk_offset_ = 0;
      return Record{};
    }
    const std::span<const std::byte> rest = chunk.subspan(in_chunk_);
    const bool has_header = rest.size() >= kRecordHeaderBytes;
    const RecordHeader header =
        has_header ? header_of(rest.first<kRecordHeaderBytes>()) : RecordHeader{};
    if (!has_header || header.bytes > rest.size() - kRecordHeaderBytes) {
      offset_ = chunk_offset_;
      break_off(chunk_fault_.empty() ? "a record in a chunk is cut off" : chunk_fault_);
      return std::nullopt;
    }
    const Record record{header.opcode, in_chunk_, rest.subspan(kRecordHeaderBytes, header.bytes)};
    in_chunk_ += kRecordHeaderBytes + header.bytes;
    // Only these may be in a chunk; any other is no end of the file.
    const bool is_expected = record.opcode == Opcode::kMessage ||
                             record.opcode == Opcode::kSchema || record.opcode == Opcode::kChannel;
    return is_expected ? record : Record{};
  }

  std::optional<Message> message_in(const Record& record, const std::vector<bool>& wanted) {
    FieldReader fields(record.content);
    const auto channel = fields.number<std::uint16_t>();
    (void)fields.number<std::uint32_t>();  // sequence
    const auto time_ns = fields.number<std::uint64_t>();
    (void)fields.number<std::uint64_t>();  // when it was published
    const auto known = topic_of_.find(channel);
    if (fields.failed() || known == topic_of_.end()) return std::nullopt;
    if (known->second >= wanted.size() || !wanted[known->second]) return std::nullopt;
    return Message{known->second,
                   static_cast<std::int64_t>(std::min<std::uint64_t>(time_ns, INT64_MAX)),
                   {chunk_offset_, record.offset},
                   fields.rest()};
  }

  /// Takes schemas and channels; ignores other records.
  void learn(Opcode opcode, std::span<const std::byte> content) {
    FieldReader fields(content);
    const auto id = fields.number<std::uint16_t>();
    if (opcode == Opcode::kSchema) {
      const std::string_view name = fields.text();
      if (!fields.failed() && name.size() <= kLongestName) types_[id] = name;
    }
    if (opcode != Opcode::kChannel || topic_of_.contains(id)) return;
    const auto schema = fields.number<std::uint16_t>();
    const std::string_view name = fields.text(), encoding = fields.text();
    const auto type = types_.find(schema);
    if (fields.failed() || encoding != "cdr" || type == types_.end()) return;
    if (name.size() > kLongestName) return;
    const Topic topic{std::string(name), type->second};
    const auto known = std::ranges::find(topics_, topic);
    if (known == topics_.end() && topics_.size() == kMostTopics) return;
    topic_of_[id] = static_cast<std::size_t>(known - topics_.begin());
    if (known == topics_.end()) topics_.push_back(topic);
  }

  /// Learns schemas and channels from the summary; false if there is none.
  bool read_summary() {
    constexpr std::size_t kFooterBytes = 20;
    constexpr std::size_t kEndBytes = kRecordHeaderBytes + kFooterBytes + kMcapMagic.size();
    std::array<std::byte, kEndBytes> end{};
    if (source_.size() < kEndBytes || !source_.read(source_.size() - kEndBytes, end)) return false;
    const std::span<const std::byte, kEndBytes> bytes(end);
    const RecordHeader header = header_of(bytes.first<kRecordHeaderBytes>());
    if (header.opcode != Opcode::kFooter || header.bytes != kFooterBytes ||
        !begins_as_mcap(bytes.last<kMcapMagic.size()>())) {
      return false;
    }
    const auto summary =
        FieldReader(bytes.subspan<kRecordHeaderBytes, kFooterBytes>()).number<std::uint64_t>();
    if (summary == 0) return false;
    offset_ = summary;
    while (const auto record = next_in_file()) {
      if (record->opcode == Opcode::kFooter) break;
      learn(record->opcode, record->content);
    }
    chunk_offset_ = 0;
    const bool is_whole = !broke_off_ && !topics_.empty();
    broke_off_.reset();
    return is_whole;
  }

  ByteSource source_;
  std::string name_;
  std::vector<Topic> topics_;
  bool knows_topics_ = false;                         ///< Once begin() has found them all.
  std::map<std::uint16_t, std::string> types_;        ///< By the id of the schema.
  std::map<std::uint16_t, std::size_t> topic_of_;     ///< By the id of the channel.
  std::uint64_t offset_ = 0;                          ///< Of the next record outside chunks.
  std::uint64_t chunk_offset_ = 0;                    ///< Of the chunk that is read; 0: none is.
  std::uint64_t loaded_offset_ = 0, loaded_end_ = 0;  ///< Where chunk_ came from.
  std::uint64_t in_chunk_ = 0;                        ///< Offset in chunk_.
  std::vector<std::byte> record_, chunk_;
  std::string chunk_fault_;  ///< Why the chunk ends before its end; empty if it does not.
  std::optional<Error> broke_off_;
};

OpenedFile opened(ByteSource source, std::string name) {
  auto reader = std::make_unique<McapReader>(std::move(source), std::move(name));
  if (Status begun = reader->begin(); !begun) return tl::unexpected(begun.error());
  return reader;
}

}  // namespace

bool begins_as_mcap(std::span<const std::byte> first_bytes) noexcept {
  const auto magic = std::as_bytes(std::span(kMcapMagic));
  return first_bytes.size() >= magic.size() &&
         std::ranges::equal(first_bytes.first(magic.size()), magic);
}

OpenedFile open_mcap(const std::filesystem::path& path, std::string name) {
  auto file = files::open_plain_file(path);
  if (!file) return tl::unexpected(file.error());
  struct stat status{};
  if (::fstat(file->get(), &status) != 0) {
    return fail(ErrorCode::kUnreadable,
                fmt::format("{}: {}", name, std::generic_category().message(errno)));
  }
  const auto size = static_cast<std::uint64_t>(status.st_size);
  return opened(ByteSource(*std::move(file), size), std::move(name));
}

OpenedFile open_mcap(std::span<const std::byte> bytes, std::string name) {
  return opened(ByteSource(bytes), std::move(name));
}

}  // namespace terracut::bag
