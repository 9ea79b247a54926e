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

#include "rt/error.hpp"

namespace terracut::evaluation {

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
enum class Role : std::uint8_t { kIgnored, kGround, kOrdinaryObstacle, kKeyObstacle };

struct ClassEntry {
  std::uint16_t id = 0;  ///< In label files.
  std::string name;
  std::array<Role, kGroundDefinitions> roles{};  ///< By GroundDefinition.
  bool vegetation = false;

  [[nodiscard]] Role role(GroundDefinition definition) const noexcept {
    return roles[static_cast<std::size_t>(definition)];
  }
};

/// The tables that come with the program, as YAML text.
extern const char* const kSemanticKittiClasses;
extern const char* const kKoblenzClasses;

/// A dataset's classes and what they count as: a file users can copy and edit
/// (tools/eval/semantickitti_classes.yaml says how it is written).
class ClassTable {
 public:
  /// `name` stands for the text in messages. kMalformed, with the line: no list `classes`, an
  /// unknown key or role, an id out of [0, 65535] or twice.
  [[nodiscard]] static Expected<ClassTable> parse(std::string_view text, const std::string& name);
  [[nodiscard]] static Expected<ClassTable> read(const std::filesystem::path& path);

  /// In order of their ids.
  [[nodiscard]] const std::vector<ClassEntry>& entries() const noexcept { return entries_; }
  /// Null for an id the table does not have.
  [[nodiscard]] const ClassEntry* find(std::uint16_t id) const noexcept;

 private:
  std::vector<ClassEntry> entries_;
};

}  // namespace terracut::evaluation
