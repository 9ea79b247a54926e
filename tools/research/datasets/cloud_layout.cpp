// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "cloud_layout.hpp"

#include <fmt/format.h>

#include <array>
#include <set>
#include <string_view>
#include <utility>

#include "calib/text/yaml_document.hpp"
#include "layout_yaml.hpp"

namespace terracut::datasets {
namespace {

/// The names that each key accepts, in the order of the key's enumeration.
constexpr std::array kPointFormats{"kitti_bin", "nuscenes_bin", "pcd"};
constexpr std::array kLabelFormats{"uint32", "uint8"};
constexpr std::array kRingSources{"order", "field"};

template <class Enum, std::size_t kValues>
bool decode(const std::array<const char*, kValues>& values, std::string_view text, Enum& to) {
  for (std::size_t i = 0; i < kValues; ++i) {
    if (text == values[i]) {
      to = static_cast<Enum>(i);
      return true;
    }
  }
  return false;
}

bool decode(std::string_view text, FilePattern& to) {
  const auto pattern = FilePattern::parse(text);
  if (pattern) to = *pattern;
  return pattern.has_value();
}

bool decode(const YAML::Node& node, int least, int most, int& to) {
  return YAML::convert<int>::decode(node, to) && least <= to && to <= most;
}

/// Sets a key. Returns an empty text if the value is valid, the expected values if it is not, and
/// nothing if the key is unknown.
std::optional<std::string> take(CloudLayout& layout, std::string_view key, const YAML::Node& node) {
  constexpr const char* kPattern = "a relative path with one `*`, in its last part";
  const std::string text = node.IsScalar() ? node.Scalar() : "";
  const auto unless = [](bool taken, std::string expected) {
    return taken ? std::string() : std::move(expected);
  };
  if (key == "sequences") return unless(decode(text, layout.sequences), kPattern);
  if (key == "points") return unless(decode(text, layout.points), kPattern);
  if (key == "labels") return unless(decode(text, layout.labels.emplace()), kPattern);
  if (key == "point_format") {
    return unless(decode(kPointFormats, text, layout.point_format),
                  "kitti_bin, nuscenes_bin or pcd");
  }
  if (key == "label_format") {
    return unless(decode(kLabelFormats, text, layout.label_format), "uint32 or uint8");
  }
  if (key == "rings") {
    return unless(decode(node, 16, 128, layout.rings), "a whole number from 16 to 128");
  }
  if (key == "columns") {
    return unless(decode(node, 256, 8192, layout.columns), "a whole number from 256 to 8192");
  }
  if (key == "rings_from") {
    return unless(decode(kRingSources, text, layout.rings_from), "order or field");
  }
  return std::nullopt;
}

}  // namespace

Expected<CloudLayout> layout_from_yaml(const YAML::Node& node, const std::string& name) {
  const auto refuse = [&](const YAML::Node& at, const std::string& what) {
    return fail(ErrorCode::kMalformed, text::where_is(at, name) + ": " + what);
  };
  if (!node.IsMap()) return refuse(node, "expected `layout:` with sequences, points, ...");
  CloudLayout layout;
  std::set<std::string> found;
  for (const auto& entry : node) {
    const std::string key = entry.first.Scalar();
    const auto expected = take(layout, key, entry.second);
    if (!expected) return refuse(entry.first, "there is no key '" + key + "' in a layout");
    if (!expected->empty()) {
      return refuse(entry.second, fmt::format("{}: expected {}", key, *expected));
    }
    found.insert(key);
  }
  for (const char* key : {"sequences", "points", "point_format", "rings", "rings_from"}) {
    if (!found.contains(key)) return refuse(node, fmt::format("a layout needs '{}'", key));
  }
  if (layout.labels.has_value() != found.contains("label_format")) {
    return refuse(node, "labels and label_format belong together");
  }
  if (!layout.labels && layout.point_format != PointFormat::kPcd) {
    return refuse(node, "only a pcd has a field for labels; `labels` is missing");
  }
  if (layout.rings_from == RingSource::kField && layout.point_format == PointFormat::kKittiBin) {
    return refuse(node, "the points of a kitti_bin have no field for their ring");
  }
  return layout;
}

std::string to_string(const CloudLayout& layout) {
  return fmt::format("{};{};{};{};{};{};{};{}", layout.sequences.text(), layout.points.text(),
                     kPointFormats[static_cast<std::size_t>(layout.point_format)],
                     layout.labels ? layout.labels->text() : "",
                     kLabelFormats[static_cast<std::size_t>(layout.label_format)], layout.rings,
                     layout.columns, kRingSources[static_cast<std::size_t>(layout.rings_from)]);
}

}  // namespace terracut::datasets
