// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pcd_cloud.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <utility>

#include "firmware_io/scan/kitti_scan.hpp"

namespace terracut::datasets {

namespace fs = std::filesystem;
namespace {

constexpr std::uintmax_t kMostBytes = std::uintmax_t{1} << 28;  // 256 bytes a point of any frame

/// LZF: runs of bytes as they are (their count less one in a byte below 32), and runs that stood
/// before (length less two in the upper three bits, 7 adds the next byte; how far back less one in
/// the lower five and a byte). Nothing unless it makes exactly `bytes` bytes.
std::optional<std::string> lzf_unpacked(std::string_view packed, std::size_t bytes) {
  std::string data;
  data.reserve(bytes);
  const auto next = [&] {
    const auto byte = static_cast<std::size_t>(static_cast<unsigned char>(packed.front()));
    packed.remove_prefix(1);
    return byte;
  };
  while (!packed.empty()) {
    const std::size_t control = next();
    if (control < 32) {
      if (packed.size() < control + 1) return std::nullopt;
      data.append(packed.substr(0, control + 1));
      packed.remove_prefix(control + 1);
    } else {
      std::size_t length = (control >> 5) + 2;
      if (length == 9 && !packed.empty()) length += next();
      if (packed.empty()) return std::nullopt;
      const std::size_t back = ((control & 31) << 8) + next() + 1;
      if (back > data.size()) return std::nullopt;
      // Byte by byte: a run may overlap what it makes.
      for (std::size_t i = 0; i < length; ++i) data.push_back(data[data.size() - back]);
    }
    if (data.size() > bytes) return std::nullopt;
  }
  if (data.size() != bytes) return std::nullopt;
  return data;
}

}  // namespace

/// Reads one file; what is wrong with it ends the reading.
class PcdReader {
 public:
  PcdReader(std::string_view content, const std::string& name) : rest_(content), name_(name) {}

  Expected<PcdCloud> read() {
    if (const Status header = read_header(); !header) return tl::unexpected(header.error());
    if (const Status checked = check_header(); !checked) return tl::unexpected(checked.error());
    PcdCloud cloud;
    cloud.points_ = points_;
    for (const Field& field : fields_) {
      if (field.count != 1) continue;
      cloud.names_.push_back(field.name);
      cloud.values_.emplace_back();
    }
    const Status data = data_ == "ascii"    ? read_ascii(cloud)
                        : data_ == "binary" ? read_binary(cloud)
                                            : read_compressed(cloud);
    if (!data) return tl::unexpected(data.error());
    return cloud;
  }

 private:
  struct Field {
    std::string name;
    std::size_t bytes = 0;  ///< 1, 2, 4 or 8.
    char type = '\0';       ///< 'I', 'U' or 'F'.
    std::size_t count = 1;
  };

  static bool is_printable(char c) { return c >= ' ' && c <= '~'; }

  /// `what` may quote the file, which may hold anything.
  [[nodiscard]] tl::unexpected<Error> refuse(std::string what,
                                             ErrorCode code = ErrorCode::kMalformed) const {
    constexpr std::size_t kMostCharacters = 200;
    if (what.size() > kMostCharacters) what.replace(kMostCharacters, std::string::npos, "...");
    std::ranges::replace_if(
        what, [](char c) { return !is_printable(c); }, '?');
    return fail(code, name_ + ": " + what);
  }

  static std::vector<std::string_view> words_of(std::string_view line) {
    constexpr std::string_view kBlank = " \t\r";
    std::vector<std::string_view> words;
    while (true) {
      const std::size_t first = line.find_first_not_of(kBlank);
      if (first == std::string_view::npos) return words;
      line.remove_prefix(first);
      const std::size_t end = std::min(line.find_first_of(kBlank), line.size());
      words.push_back(line.substr(0, end));
      line.remove_prefix(end);
    }
  }

  std::string_view next_line() {
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    const std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++line_;
    return line;
  }

  static bool number(std::string_view word, std::size_t& value) {
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    return error == std::errc{} && end == word.data() + word.size();
  }

  Status read_header() {
    while (!rest_.empty()) {
      const auto words = words_of(next_line());
      if (words.empty() || words[0].starts_with('#')) continue;
      const std::span<const std::string_view> values(words.begin() + 1, words.end());
      if (const Status taken = take_header_line(words[0], values); !taken) return taken;
      if (!data_.empty()) return {};
    }
    return refuse("no PCD file: its header has no line DATA");
  }

  Status take_header_line(std::string_view key, std::span<const std::string_view> values) {
    if (key == "FIELDS") {
      for (const std::string_view value : values) {
        if (value.size() > kLongestName || !std::ranges::all_of(value, is_printable)) {
          return refuse(fmt::format("line {}: a field is named '{}'", line_, value));
        }
        fields_.push_back({.name = std::string(value)});
      }
      return {};
    }
    if (key == "SIZE" || key == "TYPE" || key == "COUNT") return take_field_line(key, values);
    if (key == "POINTS") {
      has_points_ = values.size() == 1 && number(values[0], points_);
      if (!has_points_) return refuse(fmt::format("line {}: POINTS is no number", line_));
      return {};
    }
    if (key == "DATA") {
      data_ = values.size() == 1 ? std::string(values[0]) : "";
      if (data_ == "ascii" || data_ == "binary" || data_ == "binary_compressed") return {};
      return refuse(fmt::format("line {}: DATA {}; expected ascii, binary or binary_compressed",
                                line_, fmt::join(values, " ")),
                    ErrorCode::kUnsupported);
    }
    for (const std::string_view known : {"VERSION", "WIDTH", "HEIGHT", "VIEWPOINT"}) {
      if (key == known) return {};
    }
    return refuse(fmt::format("no PCD file: line {} of its header is none", line_));
  }

  Status take_field_line(std::string_view key, std::span<const std::string_view> values) {
    if (values.size() != fields_.size()) {
      return refuse(fmt::format("line {}: {} has {} entries for {} fields", line_, key,
                                values.size(), fields_.size()));
    }
    for (std::size_t i = 0; i < fields_.size(); ++i) {
      Field& field = fields_[i];
      bool good = false;
      if (key == "TYPE") {
        field.type = values[i].front();
        good = values[i] == "I" || values[i] == "U" || values[i] == "F";
      } else if (key == "SIZE") {
        good =
            number(values[i], field.bytes) && field.bytes <= 8 && std::has_single_bit(field.bytes);
      } else {
        good = number(values[i], field.count) && field.count >= 1 && field.count <= kMostValues;
      }
      if (!good) {
        return refuse(
            fmt::format("line {}: {} of field {} is '{}'", line_, key, field.name, values[i]));
      }
    }
    return {};
  }

  Status check_header() const {
    if (fields_.empty()) return refuse("its header names no FIELDS");
    if (fields_.size() > kMostFields) {
      return refuse(fmt::format("{} FIELDS, expected at most {}", fields_.size(), kMostFields));
    }
    if (!has_points_) return refuse("its header has no line POINTS");
    if (points_ == 0) return refuse("no points");
    if (points_ > scan::kMaxScanPoints) {
      return refuse(
          fmt::format("{} points, expected at most {}, one frame", points_, scan::kMaxScanPoints));
    }
    for (const Field& field : fields_) {
      if (field.bytes == 0 || field.type == '\0') {
        return refuse(fmt::format("its header lacks SIZE or TYPE of field {}", field.name));
      }
      if (field.type == 'F' && field.bytes < 4) {
        return refuse(fmt::format("field {} is a float of {} bytes", field.name, field.bytes));
      }
    }
    return {};
  }

  [[nodiscard]] std::size_t point_bytes() const {
    std::size_t bytes = 0;
    for (const Field& field : fields_) bytes += field.bytes * field.count;
    return bytes;
  }

  template <class T>
  static double value_of(const char* at) {
    T value;
    std::memcpy(&value, at, sizeof(T));
    return static_cast<double>(value);
  }

  static double binary_value(const Field& field, const char* at) {
    static_assert(std::endian::native == std::endian::little, "values are used as they stand");
    if (field.type == 'F') return field.bytes == 4 ? value_of<float>(at) : value_of<double>(at);
    const bool is_signed = field.type == 'I';
    switch (field.bytes) {
      case 1:
        return is_signed ? value_of<std::int8_t>(at) : value_of<std::uint8_t>(at);
      case 2:
        return is_signed ? value_of<std::int16_t>(at) : value_of<std::uint16_t>(at);
      case 4:
        return is_signed ? value_of<std::int32_t>(at) : value_of<std::uint32_t>(at);
      default:
        return is_signed ? value_of<std::int64_t>(at) : value_of<std::uint64_t>(at);
    }
  }

  /// Values that stand point by point, or all of a field before those of the next.
  enum class Order { kByPoint, kByField };

  void take_values(std::string_view data, Order order, PcdCloud& cloud) const {
    const char* first = data.data();
    std::size_t kept = 0;
    for (const Field& field : fields_) {
      const std::size_t bytes = field.bytes * field.count;
      const std::size_t step = order == Order::kByPoint ? point_bytes() : bytes;
      if (field.count == 1) {
        std::vector<double>& values = cloud.values_[kept++];
        for (std::size_t i = 0; i < points_; ++i) {
          values.push_back(binary_value(field, first + i * step));
        }
      }
      first += order == Order::kByPoint ? bytes : bytes * points_;
    }
  }

  Status read_binary(PcdCloud& cloud) const {
    if (rest_.size() < points_ * point_bytes()) {
      return refuse(
          fmt::format("truncated: {} bytes of data, expected {} for {} points of {} bytes",
                      rest_.size(), points_ * point_bytes(), points_, point_bytes()));
    }
    take_values(rest_, Order::kByPoint, cloud);
    return {};
  }

  /// The sizes of the data as they stand and as they were, as uint32, then the data.
  Status read_compressed(PcdCloud& cloud) const {
    std::array<std::uint32_t, 2> sizes{};
    if (rest_.size() < sizeof(sizes)) return refuse("truncated: its data have no sizes");
    std::memcpy(sizes.data(), rest_.data(), sizeof(sizes));
    const std::string_view packed = rest_.substr(sizeof(sizes));
    if (packed.size() < sizes[0]) {
      return refuse(
          fmt::format("truncated: {} bytes of data, expected {}", packed.size(), sizes[0]));
    }
    if (sizes[1] != points_ * point_bytes() || sizes[1] > kMostBytes) {
      return refuse(fmt::format("{} bytes unpacked, expected {} for {} points of {} bytes",
                                sizes[1], points_ * point_bytes(), points_, point_bytes()));
    }
    const auto data = lzf_unpacked(packed.substr(0, sizes[0]), sizes[1]);
    if (!data) return refuse("its compressed data are broken");
    take_values(*data, Order::kByField, cloud);
    return {};
  }

  Status read_ascii(PcdCloud& cloud) {
    std::size_t values = 0;
    for (const Field& field : fields_) values += field.count;
    // A digit and what separates it from the next, but for the last.
    if (rest_.size() + 1 < points_ * values * 2) {
      return refuse(fmt::format("truncated: {} bytes of data cannot hold {} points of {} values",
                                rest_.size(), points_, values));
    }
    for (std::size_t i = 0; i < points_; ++i) {
      if (rest_.empty()) {
        return refuse(fmt::format("truncated: {} lines of data, expected {}", i, points_));
      }
      const auto words = words_of(next_line());
      if (words.size() != values) {
        return refuse(fmt::format("line {}: {} values, expected {}", line_, words.size(), values));
      }
      std::size_t word = 0, kept = 0;
      for (const Field& field : fields_) {
        if (field.count == 1) {
          double value = 0;
          const std::string_view text = words[word];
          const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
          if (error != std::errc{} || end != text.data() + text.size()) {
            return refuse(fmt::format("line {}: {} is '{}', no number", line_, field.name, text));
          }
          cloud.values_[kept++].push_back(value);
        }
        word += field.count;
      }
    }
    return {};
  }

  static constexpr std::size_t kLongestName = 64;
  static constexpr std::size_t kMostFields = 64;
  static constexpr std::size_t kMostValues = 4096;  ///< Of one field; a histogram has hundreds.

  std::string_view rest_;
  const std::string& name_;
  std::size_t line_ = 0;
  std::vector<Field> fields_;
  std::size_t points_ = 0;
  bool has_points_ = false;
  std::string data_;
};

Expected<PcdCloud> PcdCloud::read(const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) {
    return fail(ErrorCode::kNotFound, path.string() + ": no such file");
  }
  const std::uintmax_t bytes = fs::file_size(path, error);
  if (error) return fail(ErrorCode::kUnreadable, path.string() + ": " + error.message());
  if (bytes > kMostBytes) {
    return fail(ErrorCode::kMalformed, fmt::format("{}: {} bytes, expected at most {}, one frame",
                                                   path.string(), bytes, kMostBytes));
  }
  std::ifstream file(path, std::ios::binary);
  const std::string content{std::istreambuf_iterator<char>(file), {}};
  if (!file || content.size() != bytes) {
    return fail(ErrorCode::kUnreadable, path.string() + ": cannot be read; check its permissions");
  }
  return parse(content, path.string());
}

Expected<PcdCloud> PcdCloud::parse(std::string_view content, const std::string& name) {
  return PcdReader(content, name).read();
}

std::optional<std::span<const double>> PcdCloud::field(std::string_view name) const {
  const auto found = std::ranges::find(names_, name);
  if (found == names_.end()) return std::nullopt;
  return values_[static_cast<std::size_t>(found - names_.begin())];
}

}  // namespace terracut::datasets
