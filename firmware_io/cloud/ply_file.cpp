// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/cloud/ply_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <utility>

#include "firmware_io/cloud/cloud_bytes.hpp"
#include "firmware_io/cloud/header_lines.hpp"
#include "firmware_io/scan/kitti_scan.hpp"

namespace terracut::cloud {
namespace {

/// Type and size of a property, by both of the names that are in use.
struct TypeName {
  std::string_view name, other_name;
  char type;
  std::size_t bytes;
};
constexpr TypeName kTypes[] = {
    {"char", "int8", 'I', 1},     {"uchar", "uint8", 'U', 1},    {"short", "int16", 'I', 2},
    {"ushort", "uint16", 'U', 2}, {"int", "int32", 'I', 4},      {"uint", "uint32", 'U', 4},
    {"float", "float32", 'F', 4}, {"double", "float64", 'F', 8},
};

/// Reads one file; what is wrong with it ends the reading.
class PlyReader {
 public:
  PlyReader(std::string_view content, const std::string& name) : lines_{content}, name_(name) {}

  Expected<FieldTable> read() {
    if (const Status header = read_header(); !header) return tl::unexpected(header.error());
    if (const Status checked = check_header(); !checked) return tl::unexpected(checked.error());
    FieldTable table;
    table.points = points_;
    for (const Property& property : properties_) table.names.push_back(property.name);
    table.values.resize(properties_.size());
    const Status data = is_text_ ? read_text(table) : read_binary(table);
    if (!data) return tl::unexpected(data.error());
    return table;
  }

 private:
  struct Property {
    std::string name;
    char type;
    std::size_t bytes;
  };

  [[nodiscard]] tl::unexpected<Error> refuse(std::string what,
                                             ErrorCode code = ErrorCode::kMalformed) const {
    return fail(code, name_ + ": " + quotable(std::move(what)));
  }

  Status read_header() {
    if (words_of(lines_.next()) != std::vector<std::string_view>{"ply"}) {
      return refuse("no PLY file: it does not begin with the line ply");
    }
    while (!lines_.rest.empty()) {
      const auto words = words_of(lines_.next());
      if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
      if (words[0] == "end_header") return {};
      if (const Status taken = take_header_line(words); !taken) return taken;
    }
    return refuse("no PLY file: its header has no line end_header");
  }

  Status take_header_line(const std::vector<std::string_view>& words) {
    if (words[0] == "format" && words.size() == 3) {
      is_text_ = words[1] == "ascii";
      order_ = words[1] == "binary_big_endian" ? std::endian::big : std::endian::little;
      has_format_ =
          is_text_ || words[1] == "binary_big_endian" || words[1] == "binary_little_endian";
      if (has_format_ && words[2] == "1.0") return {};
      return refuse(fmt::format("line {}: format {} {}; expected ascii, binary_little_endian or "
                                "binary_big_endian, 1.0",
                                lines_.number, words[1], words[2]),
                    ErrorCode::kUnsupported);
    }
    if (words[0] == "element" && words.size() == 3) {
      ++elements_;
      if (elements_ > 1) return {};
      if (words[1] != "vertex") {
        return refuse(fmt::format("line {}: its first element is '{}', expected vertex",
                                  lines_.number, words[1]),
                      ErrorCode::kUnsupported);
      }
      const auto points = whole_number(words[2]);
      if (!points)
        return refuse(fmt::format("line {}: the vertices' number is none", lines_.number));
      points_ = *points;
      return {};
    }
    if (words[0] == "property" && elements_ > 1) return {};
    if (words[0] == "property" && words.size() == 3) return take_property(words[1], words[2]);
    if (words[0] == "property" && words.size() == 5 && words[1] == "list") {
      return refuse(fmt::format("line {}: a vertex has the list '{}'; expected numbers",
                                lines_.number, words[4]),
                    ErrorCode::kUnsupported);
    }
    return refuse(fmt::format("no PLY file: line {} of its header is none", lines_.number));
  }

  Status take_property(std::string_view type, std::string_view property) {
    const auto* known = std::ranges::find_if(kTypes, [&](const TypeName& candidate) {
      return type == candidate.name || type == candidate.other_name;
    });
    if (known == std::end(kTypes)) {
      return refuse(fmt::format("line {}: '{}' is no type of a property", lines_.number, type));
    }
    if (property.size() > kLongestFieldName || !std::ranges::all_of(property, is_printable)) {
      return refuse(fmt::format("line {}: a property is named '{}'", lines_.number, property));
    }
    properties_.push_back({std::string(property), known->type, known->bytes});
    return {};
  }

  [[nodiscard]] Status check_header() const {
    if (!has_format_) return refuse("its header has no line format");
    if (points_ == 0) return refuse("no points");
    if (points_ > scan::kMaxScanPoints) {
      return refuse(
          fmt::format("{} points, expected at most {}, one frame", points_, scan::kMaxScanPoints));
    }
    if (properties_.empty() || properties_.size() > kMostFields) {
      return refuse(fmt::format("a vertex has {} properties, expected 1 to {}", properties_.size(),
                                kMostFields));
    }
    return {};
  }

  Status read_binary(FieldTable& table) const {
    std::size_t point_bytes = 0;
    for (const Property& property : properties_) point_bytes += property.bytes;
    if (lines_.rest.size() < points_ * point_bytes) {
      return refuse(
          fmt::format("truncated: {} bytes of data, expected {} for {} points of {} bytes",
                      lines_.rest.size(), points_ * point_bytes, points_, point_bytes));
    }
    const char* first = lines_.rest.data();
    for (std::size_t i = 0; i < properties_.size(); ++i) {
      const Property& property = properties_[i];
      table.values[i].reserve(points_);
      for (std::size_t point = 0; point < points_; ++point) {
        table.values[i].push_back(
            binary_value(first + point * point_bytes, property.type, property.bytes, order_));
      }
      first += property.bytes;
    }
    return {};
  }

  Status read_text(FieldTable& table) {
    // A digit and what separates it from the next, but for the last.
    if (lines_.rest.size() + 1 < points_ * properties_.size() * 2) {
      return refuse(fmt::format("truncated: {} bytes of data cannot hold {} points of {} values",
                                lines_.rest.size(), points_, properties_.size()));
    }
    for (std::size_t point = 0; point < points_; ++point) {
      const auto words = words_of(lines_.next());
      if (words.size() != properties_.size()) {
        return refuse(fmt::format("line {}: {} values, expected {}", lines_.number, words.size(),
                                  properties_.size()));
      }
      for (std::size_t i = 0; i < words.size(); ++i) {
        const auto value = number(words[i]);
        if (!value) {
          return refuse(fmt::format("line {}: {} is '{}', no number", lines_.number,
                                    properties_[i].name, words[i]));
        }
        table.values[i].push_back(*value);
      }
    }
    return {};
  }

  HeaderLines lines_;
  const std::string& name_;
  std::vector<Property> properties_;
  int elements_ = 0;
  std::size_t points_ = 0;
  bool has_format_ = false, is_text_ = false;
  std::endian order_ = std::endian::little;
};

}  // namespace

Expected<FieldTable> read_ply(const std::filesystem::path& path) {
  const auto content = read_cloud_bytes(path);
  if (!content) return tl::unexpected(content.error());
  return parse_ply(*content, path.string());
}

Expected<FieldTable> parse_ply(std::string_view content, const std::string& name) {
  return PlyReader(content, name).read();
}

}  // namespace terracut::cloud
