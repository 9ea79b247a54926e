// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cloud_layout.hpp"
#include "rt/error.hpp"
#include "tools/lab/quality/quality.hpp"

namespace terracut::datasets {

/// The definitions of ground. Both are always reported, because they are not comparable.
enum class GroundDefinition : std::uint8_t {
  kAll,   ///< Every physical ground.
  kRoad,  ///< The road alone, as the paper's figures imply.
};
inline constexpr std::size_t kGroundDefinitions = 2;

/// Returns "all" or "road".
[[nodiscard]] constexpr std::string_view to_string(GroundDefinition definition) noexcept {
  return definition == GroundDefinition::kAll ? "all" : "road";
}

/// The role of a class's points.
using Role = quality::TruthClass;

struct ClassEntry {
  std::uint16_t id = 0;  ///< Number of the class in label files.
  std::string name;
  std::array<Role, kGroundDefinitions> roles{};  ///< Indexed by GroundDefinition.
  bool vegetation = false;

  [[nodiscard]] Role role(GroundDefinition definition) const noexcept {
    return roles[static_cast<std::size_t>(definition)];
  }
};

/// Describes a dataset: where its files lie, its classes, and the role of each class. Read from a
/// YAML file that users can copy and edit (format:
/// tools/research/datasets/semantickitti_classes.yaml).
class ClassTable {
 public:
  /// Parses a table; `name` stands for the text in messages. Fails with kMalformed, and the line,
  /// if there is no list `classes`, a key or role is unknown, an id is repeated or out of [0,
  /// 65535], or the layout is invalid.
  [[nodiscard]] static Expected<ClassTable> parse(std::string_view text, const std::string& name);
  [[nodiscard]] static Expected<ClassTable> read(const std::filesystem::path& path);

  /// Returns where the dataset's files lie; nothing if the table states only classes.
  [[nodiscard]] const std::optional<CloudLayout>& layout() const noexcept { return layout_; }
  /// Returns a note to users of the dataset; mostly empty.
  [[nodiscard]] const std::string& note() const noexcept { return note_; }
  /// Takes layout and note from `other` if this table has no layout.
  void take_layout(const ClassTable& other);
  /// Returns the entries in order of ids.
  [[nodiscard]] const std::vector<ClassEntry>& entries() const noexcept { return entries_; }
  /// Returns the class with that id; null if the id is unknown.
  [[nodiscard]] const ClassEntry* find(std::uint16_t id) const noexcept;
  /// Returns the role of a class; kIgnored for an unknown id.
  [[nodiscard]] Role role(std::uint16_t id, GroundDefinition definition) const noexcept {
    const ClassEntry* const entry = find(id);
    return entry == nullptr ? Role::kIgnored : entry->role(definition);
  }

 private:
  std::optional<CloudLayout> layout_;
  std::string note_;
  std::vector<ClassEntry> entries_;
};

}  // namespace terracut::datasets
