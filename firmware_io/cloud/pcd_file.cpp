// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/cloud/pcd_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "firmware_io/cloud/cloud_bytes.hpp"
#include "firmware_io/cloud/header_lines.hpp"
#include "firmware_io/scan/kitti_scan.hpp"

namespace terracut::cloud {
namespace {

/// Unpacks LZF. A control byte below 32 is the length - 1 of a run of literal bytes. Any other
/// control byte begins a copy of earlier bytes: its upper three bits are the length - 2 (7: add the
/// next byte), its lower five bits and one more byte are the distance - 1. Returns nothing unless
/// the result has exactly `bytes` bytes.
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
      // Copies byte by byte: a run may overlap its own result.
      for (std::size_t i = 0; i < length; ++i) data.push_back(data[data.size() - back]);
    }
    if (data.size() > bytes) return std::nullopt;
  }
  if (data.size() != bytes) return std::nullopt;
  return data;
}

/// Reads one PCD file; the first error ends the reading.
class PcdReader {
 public:
  PcdReader(std::string_view content, const std::string& name) : lines_(content), name_(name) {}

  Expected<FieldTable> read() {
    if (const Status header = read_header(); !header) return tl::unexpected(header.error());
    if (const Status checked = check_header(); !checked) return tl::unexpected(checked.error());
    FieldTable cloud;
    cloud.points = points_;
    cloud.rows = rows_;
    cloud.viewpoint = viewpoint_;
    for (const Field& field : fields_) {
      if (!field.is_kept()) continue;
      cloud.names.push_back(field.name);
      cloud.values.emplace_back().reserve(points_);
    }
    if (points_ == 0) return cloud;
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

    /// False for padding (named _) and for fields that do not hold exactly one value.
    [[nodiscard]] bool is_kept() const { return count == 1 && name != "_"; }
  };

  [[nodiscard]] tl::unexpected<Error> refuse(std::string what,
                                             ErrorCode code = ErrorCode::kMalformed) const {
    return fail(code, name_ + ": " + quotable(std::move(what)));
  }

  Status read_header() {
    std::vector<std::string_view> words;
    while (lines_.next_words(kMostHeaderWords, words)) {
      const std::span<const std::string_view> values(words.begin() + 1, words.end());
      if (const Status taken = take_header_line(words[0], values); !taken) return taken;
      if (!data_.empty()) return {};
    }
    return refuse("no PCD file: its header has no line DATA");
  }

  Status take_header_line(std::string_view key, std::span<const std::string_view> values) {
    if (key == "FIELDS" || key == "COLUMNS") {  // version 0.5 says COLUMNS
      if (fields_.size() + values.size() > kMostFields) {
        return refuse(fmt::format("line {}: more than {} FIELDS", lines_.number, kMostFields));
      }
      for (const std::string_view value : values) {
        if (value.size() > kLongestFieldName || !std::ranges::all_of(value, is_printable)) {
          return refuse(fmt::format("line {}: a field is named '{}'", lines_.number, value));
        }
        fields_.push_back({.name = std::string(value)});
      }
      return {};
    }
    if (key == "SIZE" || key == "TYPE" || key == "COUNT") return take_field_line(key, values);
    if (key == "POINTS") {
      const auto points = values.size() == 1 ? whole_number(values[0]) : std::nullopt;
      if (!points) return refuse(fmt::format("line {}: POINTS is no number", lines_.number));
      points_ = *points;
      has_points_ = true;
      return {};
    }
    if (key == "DATA") {
      data_ = values.size() == 1 ? std::string(values[0]) : "";
      if (data_ == "ascii" || data_ == "binary" || data_ == "binary_compressed") return {};
      return refuse(fmt::format("line {}: DATA {}; expected ascii, binary or binary_compressed",
                                lines_.number, fmt::join(values, " ")),
                    ErrorCode::kUnsupported);
    }
    if (key == "WIDTH" || key == "HEIGHT") {
      std::optional<std::size_t>& side = key == "WIDTH" ? width_ : height_;
      side = values.size() == 1 ? whole_number(values[0]) : std::nullopt;
      if (!side) return refuse(fmt::format("line {}: {} is no number", lines_.number, key));
      return {};
    }
    if (key == "VIEWPOINT") take_viewpoint(values);
    if (key == "VERSION" || key == "VIEWPOINT") return {};
    return refuse(fmt::format("no PCD file: line {} of its header is none", lines_.number));
  }

  void take_viewpoint(std::span<const std::string_view> values) {
    std::array<double, 7> viewpoint{};
    if (values.size() != viewpoint.size()) return;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const auto value = number(values[i]);
      if (!value || !std::isfinite(*value)) return;
      viewpoint[i] = *value;
    }
    if (viewpoint == std::array<double, 7>{0, 0, 0, 1, 0, 0, 0}) return;
    if (std::all_of(viewpoint.begin() + 3, viewpoint.end(), [](double q) { return q == 0; })) {
      return;
    }
    viewpoint_ = viewpoint;
  }

  Status take_field_line(std::string_view key, std::span<const std::string_view> values) {
    if (values.size() != fields_.size()) {
      return refuse(fmt::format("line {}: {} has {} entries for {} fields", lines_.number, key,
                                values.size(), fields_.size()));
    }
    for (std::size_t i = 0; i < fields_.size(); ++i) {
      Field& field = fields_[i];
      bool good = false;
      if (key == "TYPE") {
        const std::size_t type = std::string_view("IiUuFf").find(values[i]);
        good = values[i].size() == 1 && type != std::string_view::npos;
        if (good) field.type = "IIUUFF"[type];
      } else if (key == "SIZE") {
        field.bytes = whole_number(values[i]).value_or(0);
        good = field.bytes <= 8 && std::has_single_bit(field.bytes);
      } else {
        field.count = whole_number(values[i]).value_or(kMostValues + 1);
        good = field.count <= kMostValues;
      }
      if (!good) {
        return refuse(fmt::format("line {}: {} of field {} is '{}'; expected {}", lines_.number,
                                  key, field.name, values[i],
                                  key == "TYPE"   ? "I, U or F"
                                  : key == "SIZE" ? "1, 2, 4 or 8"
                                                  : "the number of its values"));
      }
    }
    return {};
  }

  Status check_header() {
    if (fields_.empty()) return refuse("its header names no FIELDS");
    if (!has_points_ && width_ && height_) {
      const std::size_t most = scan::kMaxScanPoints + 1;  // keeps the product from overflowing
      points_ = std::min(*width_, most) * std::min(*height_, most);
      has_points_ = true;
    }
    if (!has_points_) return refuse("its header has neither a line POINTS nor WIDTH and HEIGHT");
    if (points_ > scan::kMaxScanPoints) {
      return refuse(
          fmt::format("{} points, expected at most {}, one frame", points_, scan::kMaxScanPoints));
    }
    if (width_ && height_ && points_ > 0) {
      const bool fits = *height_ > 0 && points_ % *height_ == 0 && points_ / *height_ == *width_;
      if (!fits) {
        return refuse(
            fmt::format("{} POINTS, but WIDTH {} and HEIGHT {}", points_, *width_, *height_));
      }
      rows_ = *height_;
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

  static double binary_value(const Field& field, const char* at) {
    return cloud::binary_value(at, field.type, field.bytes);
  }

  /// Whether values are stored point by point or field by field.
  enum class Order { kByPoint, kByField };

  void take_values(std::string_view data, Order order, FieldTable& cloud) const {
    const char* first = data.data();
    std::size_t kept = 0;
    for (const Field& field : fields_) {
      const std::size_t bytes = field.bytes * field.count;
      const std::size_t step = order == Order::kByPoint ? point_bytes() : bytes;
      if (field.is_kept()) {
        std::vector<double>& values = cloud.values[kept++];
        for (std::size_t i = 0; i < points_; ++i) {
          values.push_back(binary_value(field, first + i * step));
        }
      }
      first += order == Order::kByPoint ? bytes : bytes * points_;
    }
  }

  Status read_binary(FieldTable& cloud) const {
    if (lines_.rest.size() < points_ * point_bytes()) {
      return refuse(
          fmt::format("truncated: {} bytes of data, expected {} for {} points of {} bytes",
                      lines_.rest.size(), points_ * point_bytes(), points_, point_bytes()));
    }
    take_values(lines_.rest, Order::kByPoint, cloud);
    return {};
  }

  /// Reads the packed and unpacked sizes as uint32, then the data.
  Status read_compressed(FieldTable& cloud) const {
    std::array<std::uint32_t, 2> sizes{};
    if (lines_.rest.size() < sizeof(sizes)) return refuse("truncated: its data have no sizes");
    std::memcpy(sizes.data(), lines_.rest.data(), sizeof(sizes));
    const std::string_view packed = lines_.rest.substr(sizeof(sizes));
    if (packed.size() < sizes[0]) {
      return refuse(
          fmt::format("truncated: {} bytes of data, expected {}", packed.size(), sizes[0]));
    }
    if (sizes[1] != points_ * point_bytes() || sizes[1] > kMostCloudBytes) {
      return refuse(fmt::format("{} bytes unpacked, expected {} for {} points of {} bytes",
                                sizes[1], points_ * point_bytes(), points_, point_bytes()));
    }
    const auto data = lzf_unpacked(packed.substr(0, sizes[0]), sizes[1]);
    if (!data) return refuse("its compressed data are broken");
    take_values(*data, Order::kByField, cloud);
    return {};
  }

  Status read_ascii(FieldTable& cloud) {
    std::size_t values = 0;
    for (const Field& field : fields_) values += field.count;
    // Each value takes at least a digit and a separator; only the last needs no separator.
    if (lines_.rest.size() + 1 < points_ * values * 2) {
      return refuse(fmt::format("truncated: {} bytes of data cannot hold {} points of {} values",
                                lines_.rest.size(), points_, values));
    }
    std::vector<std::string_view> words;
    for (std::size_t i = 0; i < points_; ++i) {
      if (!lines_.next_words(values + 1, words)) {
        return refuse(fmt::format("truncated: {} lines of data, expected {}", i, points_));
      }
      if (words.size() != values) {
        return refuse(fmt::format("line {}: {} values, expected {}", lines_.number,
                                  count_of(words, values), values));
      }
      std::size_t word = 0, kept = 0;
      for (const Field& field : fields_) {
        if (field.is_kept()) {
          const auto value = number(words[word]);
          if (!value) {
            return refuse(fmt::format("line {}: {} is '{}', no number", lines_.number, field.name,
                                      words[word]));
          }
          cloud.values[kept++].push_back(*value);
        }
        word += field.count;
      }
    }
    return {};
  }

  /// The most values that one field may have; histograms have hundreds.
  static constexpr std::size_t kMostValues = 4096;

  HeaderLines lines_;
  const std::string& name_;
  std::vector<Field> fields_;
  std::size_t points_ = 0;
  bool has_points_ = false;
  std::optional<std::size_t> width_, height_;
  std::size_t rows_ = 1;
  std::optional<std::array<double, 7>> viewpoint_;
  std::string data_;
};

}  // namespace

Expected<FieldTable> read_pcd(const std::filesystem::path& path) {
  const auto content = read_cloud_bytes(path);
  if (!content) return tl::unexpected(content.error());
  return parse_pcd(*content, path.string());
}

Expected<FieldTable> parse_pcd(std::string_view content, const std::string& name) {
  return PcdReader(content, name).read();
}

}  // namespace terracut::cloud
