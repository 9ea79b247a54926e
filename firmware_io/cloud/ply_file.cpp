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

/// The type and size of a property; each type has two names in PLY files.
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

/// Reads one PLY file; the first error ends the reading.
class PlyReader {
 public:
  PlyReader(std::string_view content, const std::string& name) : lines_(content), name_(name) {}

  Expected<FieldTable> read() {
    if (const Status header = read_header(); !header) return tl::unexpected(header.error());
    if (const Status checked = check_header(); !checked) return tl::unexpected(checked.error());
    FieldTable table;
    table.points = points_;
    for (const Property& property : properties_) {
      if (property.is_list()) continue;
      table.names.push_back(property.name);
      table.values.emplace_back().reserve(points_);
    }
    const bool has_lists = table.names.size() < properties_.size();
    const Status data = is_text_    ? read_text(table, has_lists)
                        : has_lists ? read_binary_with_lists(table)
                                    : read_binary(table);
    if (!data) return tl::unexpected(data.error());
    return table;
  }

 private:
  struct Property {
    std::string name;
    char type;
    std::size_t bytes;
    /// The type of a list's length; set only if the property is a list. Lists are skipped.
    char count_type = '\0';
    std::size_t count_bytes = 0;

    [[nodiscard]] bool is_list() const { return count_bytes != 0; }
  };

  [[nodiscard]] tl::unexpected<Error> refuse(std::string what,
                                             ErrorCode code = ErrorCode::kMalformed) const {
    return fail(code, name_ + ": " + quotable(std::move(what)));
  }

  Status read_header() {
    if (words_of(lines_.next(), 2) != std::vector<std::string_view>{"ply"}) {
      return refuse("no PLY file: it does not begin with the line ply");
    }
    while (!lines_.rest.empty()) {
      const auto words = words_of(lines_.next(), kMostHeaderWords);
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
    if (words[0] == "property" && words.size() == 3) return take_property({}, words[1], words[2]);
    if (words[0] == "property" && words.size() == 5 && words[1] == "list") {
      return take_property(words[2], words[3], words[4]);
    }
    return refuse(fmt::format("no PLY file: line {} of its header is none", lines_.number));
  }

  /// `count_type` is the type of a list's length; empty for a single value.
  Status take_property(std::string_view count_type, std::string_view type,
                       std::string_view property) {
    const auto known_as = [](std::string_view name) {
      return std::ranges::find_if(kTypes, [&](const TypeName& candidate) {
        return name == candidate.name || name == candidate.other_name;
      });
    };
    const auto* known = known_as(type);
    const auto* count = known_as(count_type);
    const bool is_list = !count_type.empty();
    if (known == std::end(kTypes) ||
        (is_list && (count == std::end(kTypes) || count->type == 'F'))) {
      return refuse(fmt::format("line {}: '{}' is no type of a property", lines_.number,
                                known == std::end(kTypes) ? type : count_type));
    }
    if (properties_.size() == kMostFields) {
      return refuse(
          fmt::format("line {}: a vertex has more than {} properties", lines_.number, kMostFields));
    }
    if (property.size() > kLongestFieldName || !std::ranges::all_of(property, is_printable)) {
      return refuse(fmt::format("line {}: a property is named '{}'", lines_.number, property));
    }
    properties_.push_back({std::string(property), known->type, known->bytes});
    if (!is_list) return {};
    properties_.back().count_type = count->type;
    properties_.back().count_bytes = count->bytes;
    return {};
  }

  [[nodiscard]] Status check_header() const {
    if (!has_format_) return refuse("its header has no line format");
    if (points_ > scan::kMaxScanPoints) {
      return refuse(
          fmt::format("{} points, expected at most {}, one frame", points_, scan::kMaxScanPoints));
    }
    if (properties_.empty()) return refuse("a vertex has no properties");
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
      for (std::size_t point = 0; point < points_; ++point) {
        table.values[i].push_back(
            binary_value(first + point * point_bytes, property.type, property.bytes, order_));
      }
      first += property.bytes;
    }
    return {};
  }

  Status read_binary_with_lists(FieldTable& table) const {
    std::string_view data = lines_.rest;
    for (std::size_t point = 0; point < points_; ++point) {
      std::size_t kept = 0;
      for (const Property& property : properties_) {
        std::size_t bytes = property.bytes;
        if (property.is_list() && data.size() >= property.count_bytes) {
          const double values =
              binary_value(data.data(), property.count_type, property.count_bytes, order_);
          data.remove_prefix(property.count_bytes);
          // A length that is negative or beyond the data counts as truncated.
          const bool fits = values >= 0 && values <= static_cast<double>(data.size());
          bytes = fits ? static_cast<std::size_t>(values) * property.bytes : data.size() + 1;
        }
        if (data.size() < bytes) {
          return refuse(fmt::format("truncated: its data end in vertex {} of {}", point, points_));
        }
        if (!property.is_list()) {
          table.values[kept++].push_back(
              binary_value(data.data(), property.type, property.bytes, order_));
        }
        data.remove_prefix(bytes);
      }
    }
    return {};
  }

  Status read_text(FieldTable& table, bool has_lists) {
    // Each value takes at least a digit and a separator; only the last needs no separator.
    if (lines_.rest.size() + 1 < points_ * properties_.size() * 2) {
      return refuse(fmt::format("truncated: {} bytes of data cannot hold {} points of {} values",
                                lines_.rest.size(), points_, properties_.size()));
    }
    constexpr std::size_t kMostListed = 4096;
    const std::size_t most = properties_.size() + (has_lists ? kMostListed : 1);
    std::vector<std::string_view> words;
    for (std::size_t point = 0; point < points_; ++point) {
      if (!lines_.next_words(most, words)) {
        return refuse(fmt::format("truncated: {} lines of data, expected {}", point, points_));
      }
      std::size_t word = 0, kept = 0;
      for (const Property& property : properties_) {
        if (word >= words.size()) {
          word = words.size() + 1;
          break;
        }
        const auto value = number(words[word]);
        if (!value) {
          return refuse(fmt::format("line {}: {} is '{}', no number", lines_.number, property.name,
                                    words[word]));
        }
        ++word;
        if (!property.is_list()) {
          table.values[kept++].push_back(*value);
        } else if (*value >= 0 && *value <= static_cast<double>(words.size() - word)) {
          word += static_cast<std::size_t>(*value);
        } else {
          word = words.size() + 1;
        }
      }
      if (kept != table.values.size() || word != words.size()) {
        return refuse(has_lists
                          ? fmt::format("line {}: {} values are not those of its {} properties",
                                        lines_.number, words.size(), properties_.size())
                          : fmt::format("line {}: {} values, expected {}", lines_.number,
                                        count_of(words, properties_.size()), properties_.size()));
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
