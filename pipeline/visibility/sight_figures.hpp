// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>

#include "pipeline/visibility/visibility.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::visibility {

/// The directions in which people are told of sectors, clockwise.
enum class Direction : std::uint8_t {
  kAhead,
  kAheadRight,
  kRight,
  kBehindRight,
  kBehind,
  kBehindLeft,
  kLeft,
  kAheadLeft,
  kCount,
};
inline constexpr std::size_t kDirections = static_cast<std::size_t>(Direction::kCount);

/// Returns a stable lower_snake_case name; "unknown" for anything else.
[[nodiscard]] constexpr std::string_view to_string(Direction direction) noexcept {
  constexpr std::array<std::string_view, kDirections> kNames{
      "ahead",  "ahead_right", "right", "behind_right",
      "behind", "behind_left", "left",  "ahead_left"};
  return direction < Direction::kCount ? kNames[static_cast<std::size_t>(direction)] : "unknown";
}

/// Returns the direction in whose 45 degrees the middle of a sector lies; `sector` < kSectors.
[[nodiscard]] constexpr Direction direction_of(std::size_t sector) noexcept {
  constexpr std::size_t kSectorWide_ddeg = 3600 / kSectors, kWide_ddeg = 3600 / kDirections;
  const std::size_t middle_ddeg = sector * kSectorWide_ddeg + kSectorWide_ddeg / 2;
  return static_cast<Direction>((middle_ddeg + kWide_ddeg / 2) / kWide_ddeg % kDirections);
}

/// What is told of a sensor's view, to people and to other processes. A plain value, part of
/// status::MonitorSnapshot. If it comes from another process it may have any bytes; all functions
/// are safe even then.
struct SightFigures {
  static constexpr std::size_t kCauses = static_cast<std::size_t>(Cause::kCount);

  /// What is told of a sector.
  struct Sector {
    Condition condition;
    std::uint8_t has_view = 0;  ///< 0: this sector has never returned much, and is not judged.
    float visible_m = 0;        ///< SectorSight::visible_m of the last turn.
  };
  /// What is told of the sectors of one direction.
  struct Of {
    int troubled = 0;   ///< Sectors that are not clear.
    int with_view = 0;  ///< Sectors that are judged.
    /// The median of the visible ranges of the sectors that are judged: glass beside the vehicle
    /// takes a single sector's away for a moment.
    float visible_m = 0;
  };

  std::uint8_t is_watched = 0;  ///< 1: turns are looked at.
  std::uint8_t has_learnt = 0;  ///< 0: the view is being learnt; no condition is named.
  std::uint64_t learning_turns = 0;
  std::uint64_t left_out_turns = 0;  ///< Not looked at, because too many packets are missing.
  /// The other turns, by the cause of their worst condition.
  std::array<std::uint64_t, kCauses> turns{};
  std::array<Sector, kSectors> sectors{};  ///< Of the last turn, as Visibility::sectors().

  [[nodiscard]] Condition worst() const noexcept { return worst_of(sectors); }
  [[nodiscard]] int troubled_sectors() const noexcept { return troubled_of(sectors); }
  [[nodiscard]] Of in(Direction direction) const noexcept TERRACUT_NONBLOCKING;
};
static_assert(std::is_trivially_copyable_v<SightFigures>);

/// Returns the state of the view in words for people: "clear", "learning", or the conditions from
/// the worst on, each with its sectors of ten degrees: "blocked, covered: 3 sectors, ahead left and
/// left; reduced, airborne: 5 sectors, ahead". Where all sectors that see anything are meant, it
/// says "all around".
[[nodiscard]] std::string sight_text(const SightFigures& figures);

}  // namespace terracut::visibility
