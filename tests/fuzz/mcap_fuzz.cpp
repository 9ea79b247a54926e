// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Whatever frames and figures come, with whatever stamps: each file is whole, and its chunks hold
// every message that was put into it.
#include <unistd.h>
#include <zlib.h>
#include <zstd.h>

#include <bit>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>

#include "input.hpp"
#include "pipeline/mcap/mcap_sink.hpp"

namespace {

namespace fs = std::filesystem;
using namespace terracut;
using fuzz::Input;
using fuzz::require;

constexpr unsigned char kMessage = 5, kChunk = 6, kFooter = 2;

/// The numbers and texts of a record, taken one after another.
class Fields {
 public:
  explicit Fields(std::string_view bytes) : bytes_(bytes) {}
  template <class Number>
  Number next() {
    Number number{};
    std::memcpy(&number, take(sizeof number).data(), sizeof number);
    return number;
  }
  std::string_view take(std::uint64_t count) {
    require(count <= bytes_.size(), "a record is shorter than its fields");
    const std::string_view part = bytes_.substr(0, count);
    bytes_.remove_prefix(count);
    return part;
  }
  [[nodiscard]] bool empty() const { return bytes_.empty(); }

 private:
  std::string_view bytes_;
};

std::uint64_t messages_in_chunk(Fields chunk) {
  chunk.take(16);  // first and last time
  const auto plain_bytes = chunk.next<std::uint64_t>();
  const auto crc = chunk.next<std::uint32_t>();
  require(chunk.take(chunk.next<std::uint32_t>()) == "zstd");
  const std::string_view packed = chunk.take(chunk.next<std::uint64_t>());
  std::string plain(plain_bytes, '\0');
  require(::ZSTD_decompress(plain.data(), plain.size(), packed.data(), packed.size()) ==
          plain_bytes);
  require(::crc32_z(0, reinterpret_cast<const Bytef*>(plain.data()), plain.size()) == crc);
  std::uint64_t messages = 0;
  for (Fields records(plain); !records.empty(); ++messages) {
    require(records.next<unsigned char>() == kMessage, "a chunk holds something else");
    records.take(records.next<std::uint64_t>());
  }
  return messages;
}

std::uint64_t messages_in_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string content{std::istreambuf_iterator<char>(file), {}};
  const std::string_view magic("\x89MCAP0\r\n", 8);
  require(content.size() > 16 && content.starts_with(magic) && content.ends_with(magic));
  std::uint64_t messages = 0;
  unsigned char kind = 0;
  for (Fields records(std::string_view(content).substr(8, content.size() - 16));
       !records.empty();) {
    kind = records.next<unsigned char>();
    const Fields record(records.take(records.next<std::uint64_t>()));
    if (kind == kChunk) messages += messages_in_chunk(record);
  }
  require(kind == kFooter, "the last record is another");
  return messages;
}

std::int64_t stamp_ns(Input& input) {
  const std::uint64_t high = input.next(4);
  return std::bit_cast<std::int64_t>(high << 32 | input.next(4));
}

publish::LabelledFrame frame_of(Input& input) {
  publish::LabelledFrame frame;
  frame.record.info.number = input.next(4);
  frame.record.info.first_packet_ns = stamp_ns(input);
  frame.record.info.last_packet_ns = stamp_ns(input);
  frame.record.labels_ns = stamp_ns(input);
  const auto bytes = input.take(sizeof(points::LabelledPoint) * input.next(1));
  frame.points.resize(bytes.size() / sizeof(points::LabelledPoint));
  if (!frame.points.empty()) {
    std::memcpy(frame.points.data(), bytes.data(),
                frame.points.size() * sizeof(points::LabelledPoint));
  }
  return frame;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fs::path folder =
      fs::temp_directory_path() / ("terracut_mcap_fuzz_" + std::to_string(::getpid()));
  fs::remove_all(folder);
  fs::create_directories(folder);
  Input input({data, size});
  const auto kind = input.next(1);
  const bool is_bag = (kind & 1) != 0, points_alone = (kind & 2) != 0,
             has_transform = (kind & 4) != 0;
  mcap::McapSink::Config config{.path = folder / (is_bag ? "bag" : "one.mcap")};
  config.points_alone = points_alone;
  if (is_bag) {
    config.split_bytes = input.next(2);
    config.split_ns = input.next(4);
  }
  const auto text = input.take(input.next(1));
  config.metadata = {{"key", std::string(text.begin(), text.end())}};
  publish::RunFacts stream;
  if (!has_transform) stream.sensor_frame_id.clear();
  auto sink = mcap::McapSink::open(std::move(config), stream);
  require(sink.has_value(), "a recording cannot be begun");
  std::uint64_t put = 0;
  while (!input.empty()) {
    if (input.next(1) % 4 == 0) {
      auto figures = std::make_unique<status::MonitorSnapshot>();
      figures->taken_ns = stamp_ns(input);
      require((*sink)->put_figures(*figures).has_value());
      put += 1;
    } else {
      require((*sink)->put(frame_of(input)).has_value());
      put += points_alone ? 1 : 3;
    }
  }
  require((*sink)->finish().has_value());
  std::uint64_t found = 0, files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".mcap") continue;
    found += messages_in_file(entry.path());
    ++files;
  }
  const std::uint64_t transforms = has_transform && put > 0 ? files : 0;
  require(found == put + transforms, "messages are missing, or too many");
  fs::remove_all(folder);
  return 0;
}
