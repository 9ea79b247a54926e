// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "class_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "built_in_tables.hpp"
#include "calib/text/bounded_file.hpp"
#include "calib/text/yaml_document.hpp"
#include "layout_yaml.hpp"

namespace terracut::datasets {
namespace {

std::optional<Role> role_of(const std::string& text) {
  if (text == "ground") return Role::kGround;
  if (text == "ordinary") return Role::kOrdinaryObstacle;
  if (text == "key") return Role::kKeyObstacle;
  if (text == "ignored") return Role::kIgnored;
  return std::nullopt;
}

class Reader {
 public:
  explicit Reader(const std::string& name) : name_(name) {}

  Expected<std::vector<ClassEntry>> read(const YAML::Node& root) const {
    const YAML::Node list = root.IsMap() ? root["classes"] : YAML::Node();
    if (!list || !list.IsSequence() || list.size() == 0) {
      return refuse(root, "expected a list under `classes:`");
    }
    std::vector<ClassEntry> entries;
    for (const YAML::Node& node : list) {
      auto entry = read_entry(node);
      if (!entry) return tl::unexpected(entry.error());
      for (const ClassEntry& before : entries) {
        if (before.id == entry->id) {
          return refuse(node, fmt::format("class {} stands here a second time", entry->id));
        }
      }
      entries.push_back(*std::move(entry));
    }
    std::ranges::sort(entries, {}, &ClassEntry::id);
    return entries;
  }

 private:
  [[nodiscard]] tl::unexpected<Error> refuse(const YAML::Node& node,
                                             const std::string& what) const {
    return fail(ErrorCode::kMalformed, text::where_is(node, name_) + ": " + what);
  }

  Expected<ClassEntry> read_entry(const YAML::Node& node) const {
    if (!node.IsMap()) return refuse(node, "expected {id: .., name: .., all: .., road: ..}");
    ClassEntry entry;
    int found = 0;
    for (const auto& field : node) {
      const std::string key = field.first.Scalar();
      const std::string value = field.second.IsScalar() ? field.second.Scalar() : "";
      if (key == "id") {
        if (!YAML::convert<std::uint16_t>::decode(field.second, entry.id)) {
          return refuse(field.second, "expected an id from 0 to 65535, found '" + value + "'");
        }
      } else if (key == "name") {
        entry.name = value;
      } else if (key == "all" || key == "road") {
        const auto role = role_of(value);
        if (!role) {
          return refuse(field.second,
                        "expected ground, ordinary, key or ignored, found '" + value + "'");
        }
        entry.roles[key == "all" ? 0 : 1] = *role;
      } else if (key == "vegetation") {
        if (!YAML::convert<bool>::decode(field.second, entry.vegetation)) {
          return refuse(field.second, "expected true or false, found '" + value + "'");
        }
        continue;
      } else {
        return refuse(field.first, "there is no key '" + key + "' here");
      }
      ++found;
    }
    if (found < 4) return refuse(node, "a class needs id, name, all and road");
    return entry;
  }

  const std::string& name_;
};

}  // namespace

Expected<ClassTable> ClassTable::parse(std::string_view text, const std::string& name) {
  const auto root = text::load_yaml_document(text, name);
  if (!root) return tl::unexpected(root.error());
  auto entries = Reader(name).read(*root);
  if (!entries) return tl::unexpected(entries.error());
  ClassTable table;
  table.entries_ = *std::move(entries);
  for (const auto& entry : *root) {
    const std::string key = entry.first.Scalar();
    if (key != "layout" && key != "note" && key != "classes") {
      return fail(ErrorCode::kMalformed,
                  text::where_is(entry.first, name) + ": there is no key '" + key + "'");
    }
  }
  if (const YAML::Node node = (*root)["layout"]) {
    auto layout = layout_from_yaml(node, name);
    if (!layout) return tl::unexpected(layout.error());
    table.layout_ = *std::move(layout);
  }
  if (const YAML::Node note = (*root)["note"]; note && note.IsScalar()) {
    table.note_ = note.Scalar();
  }
  return table;
}

Expected<ClassTable> ClassTable::read(const std::filesystem::path& path) {
  const auto text = text::read_bounded_file(path, "a class table");
  if (!text) return tl::unexpected(text.error());
  return parse(*text, path.string());
}

void ClassTable::take_layout(const ClassTable& other) {
  if (layout_) return;
  layout_ = other.layout_;
  note_ = other.note_;
}

const ClassEntry* ClassTable::find(std::uint16_t id) const noexcept {
  const auto found = std::ranges::lower_bound(entries_, id, {}, &ClassEntry::id);
  return found != entries_.end() && found->id == id ? &*found : nullptr;
}

Expected<ClassTable> built_in_table(std::string_view dataset) {
  std::vector<std::string_view> names;
  for (const BuiltInTable& table : built_in_tables()) {
    if (table.dataset == dataset) {
      return ClassTable::parse(std::string(table.yaml), "built-in class table");
    }
    names.push_back(table.dataset);
  }
  return fail(ErrorCode::kInvalidArgument, fmt::format("there is no dataset '{}'; there are: {}",
                                                       dataset, fmt::join(names, ", ")));
}

}  // namespace terracut::datasets
