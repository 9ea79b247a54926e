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

/// What counts as ground. Both are always reported, because they are not comparable.
enum class GroundDefinition : std::uint8_t {
  kAll,   ///< Every physical ground.
  kRoad,  ///< The road alone: what the paper's figures imply.
};
inline constexpr std::size_t kGroundDefinitions = 2;

/// "all", "road"
[[nodiscard]] constexpr std::string_view to_string(GroundDefinition definition) noexcept {
  return definition == GroundDefinition::kAll ? "all" : "road";
}

/// What points of a class count as.
using Role = quality::TruthClass;

struct ClassEntry {
  std::uint16_t id = 0;  ///< In label files.
  std::string name;
  std::array<Role, kGroundDefinitions> roles{};  ///< By GroundDefinition.
  bool vegetation = false;

  [[nodiscard]] Role role(GroundDefinition definition) const noexcept {
    return roles[static_cast<std::size_t>(definition)];
  }
};

/// A dataset's files, its classes and what they count as: a file users can copy and edit
/// (tools/research/datasets/semantickitti_classes.yaml says how it is written).
class ClassTable {
 public:
  /// `name` stands for the text in messages. kMalformed, with the line: no list `classes`, an
  /// unknown key or role, an id out of [0, 65535] or twice, or a layout that is none.
  [[nodiscard]] static Expected<ClassTable> parse(std::string_view text, const std::string& name);
  [[nodiscard]] static Expected<ClassTable> read(const std::filesystem::path& path);

  /// None where the table has classes alone.
  [[nodiscard]] const std::optional<CloudLayout>& layout() const noexcept { return layout_; }
  /// What users of the dataset have to know; mostly empty.
  [[nodiscard]] const std::string& note() const noexcept { return note_; }
  /// Layout and note of `other`, unless it has a layout of its own.
  void take_layout(const ClassTable& other);
  /// In order of their ids.
  [[nodiscard]] const std::vector<ClassEntry>& entries() const noexcept { return entries_; }
  /// Null for an id the table does not have.
  [[nodiscard]] const ClassEntry* find(std::uint16_t id) const noexcept;
  /// kIgnored for an id the table does not have.
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
