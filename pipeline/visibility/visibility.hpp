// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "calib/mount/ring_profile.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "pipeline/stage/cell_planes.hpp"
#include "pipeline/visibility/sector_sight.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::visibility {

/// How much of the learnt view is there; the later the worse.
enum class State : std::uint8_t { kClear, kReduced, kBlocked, kCount };

/// Why a view is not clear.
enum class Cause : std::uint8_t {
  kNone,
  kAirborne,  ///< Returns hang alone in the near air: rain, snow, spray, dust.
  kDirt,      ///< Beams are lost all around that used to return: spots on the lens.
  kFog,       ///< Nothing returns from afar, in nearly every direction.
  kCovered,   ///< Nothing returns at all, in some directions: mud, a hand, a bag.
  kCount,
};

/// The names of both in reports, in lower_snake_case.
inline constexpr std::array<std::string_view, static_cast<std::size_t>(State::kCount)> kStateNames{
    "clear", "reduced", "blocked"};
inline constexpr std::array<std::string_view, static_cast<std::size_t>(Cause::kCount)> kCauseNames{
    "none", "airborne", "dirt", "fog", "covered"};
[[nodiscard]] constexpr std::string_view to_string(State state) noexcept {
  return state < State::kCount ? kStateNames[static_cast<std::size_t>(state)] : "unknown";
}
[[nodiscard]] constexpr std::string_view to_string(Cause cause) noexcept {
  return cause < Cause::kCount ? kCauseNames[static_cast<std::size_t>(cause)] : "unknown";
}

/// A state with its cause.
struct Condition {
  State state = State::kClear;
  Cause cause = Cause::kNone;

  friend bool operator==(const Condition&, const Condition&) = default;
};
[[nodiscard]] constexpr bool is_worse(const Condition& one, const Condition& other) noexcept {
  return one.state > other.state || (one.state == other.state && one.cause > other.cause);
}

/// Returns the worst condition of any sector; of equal states the graver cause.
template <class Sectors>
[[nodiscard]] constexpr Condition worst_of(const Sectors& sectors) noexcept {
  Condition worst;
  for (const auto& sector : sectors) {
    if (is_worse(sector.condition, worst)) worst = sector.condition;
  }
  return worst;
}
/// Returns how many sectors are not clear.
template <class Sectors>
[[nodiscard]] constexpr int troubled_of(const Sectors& sectors) noexcept {
  int troubled = 0;
  for (const auto& sector : sectors) troubled += sector.condition.state != State::kClear ? 1 : 0;
  return troubled;
}

/// Judges turn by turn how far a sensor sees in each direction, against the view that it has learnt
/// of this sensor on this vehicle.
///
/// The first `learning_turns` turns are the view, and turns without any sign of trouble go on
/// teaching it slowly. So a wall beside the sensor, a roof box, or beams that always miss are no
/// trouble; neither is what is already there at the start. A sign of trouble is named once it
/// has been there for `turns_to_name` turns more than not, until it has been away as long.
///
/// All memory is taken in the constructor; look() does not allocate, lock, throw or look at a
/// clock. The same turns give the same conditions on every machine. One thread at a time.
class Visibility {
 public:
  struct Config {
    int learning_turns = 10;  ///< More than SectorSights::kUsualTurns.
    int turns_to_name = 4;    ///< With those of a stuck beam, within a second at 10 Hz.
    float seen_share = 0.1F;  ///< A sector is judged if so many of all its beams used to return.

    float covered_lost = 0.9F;      ///< Sector: so many of the usual beams to near ground are lost,
    float covered_returned = 0.1F;  ///< and no more returns than this part of the usual ones.

    float airborne_share = 0.02F;  ///< Sector: so many more beams end alone in the air.

    float dirt_share = 0.06F;    ///< Turn: so many of the usual beams to near ground are stuck,
    float dirt_sector = 0.02F;   ///< at least so many in a sector,
    float dirt_sectors = 0.67F;  ///< in such a part of the sectors.

    /// Sectors that used to return `fog_view` of all beams from afar can tell of fog, unless what
    /// they return less from afar returns from something near, but for less than `fog_lost` of it.
    float fog_view = 0.05F, fog_lost = 0.3F;
    float fog_far = 0.2F;      ///< Such a sector is foggy if this part of it or less is left, and
    float fog_range = 0.6F;    ///< the visible range is less than this part of the usual one, or
    float fog_alone = 0.08F;   ///< such a part of what is lost ends alone in the air, at droplets.
    float fog_sectors = 0.6F;  ///< Turn: such a part of these sectors is foggy,
    int fog_fewest = 6;        ///< of which there are so many.
  };

  /// What is known of a sector.
  struct Sector {
    SectorSight now;       ///< Of the last turn.
    SectorSight expected;  ///< The learnt view.
    Condition condition;
    bool has_view = false;  ///< False: this sector has never returned much, and is not judged.
  };

  /// `profile` must have shape.rows rings.
  Visibility(const Config& config, const mount::RingProfile& profile, frame::ImageShape shape,
             memory::FixedMemory& memory);

  /// Looks at the next turn, an image of the shape given at construction; `planes` has the label of
  /// each cell and its height above the ground. Real-time safe.
  void look(const frame::RangeImage& image,
            const stage::CellPlanes& planes) noexcept TERRACUT_NONBLOCKING;

  /// Forgets the learnt view and all conditions; for a stream that begins anew with another sensor
  /// or mount.
  void forget() noexcept TERRACUT_NONBLOCKING;

  /// Returns the sectors, clockwise as columns are; the first begins straight ahead.
  [[nodiscard]] std::span<const Sector> sectors() const noexcept { return sectors_; }
  [[nodiscard]] Condition worst() const noexcept { return worst_of(sectors_); }
  [[nodiscard]] int troubled_sectors() const noexcept { return troubled_of(sectors_); }
  /// False as long as the view is being learnt: no condition is named.
  [[nodiscard]] bool has_learnt() const noexcept { return turns_ >= config_.learning_turns; }

 private:
  /// A sign of trouble.
  struct Sign {
    int turns = 0;  ///< It has been there so many turns more than not; [0, turns_to_name].
    bool is_named = false;

    void count(bool is_there, int turns_to_name) noexcept;
  };
  /// The signs of a sector.
  struct Signs {
    Sign covered, airborne;
  };

  [[nodiscard]] bool is_covered(const Sector& sector) const noexcept;
  /// True if so many more beams of a sector than usual end alone in the air.
  [[nodiscard]] static bool has_more_alone(const Sector& sector, float share) noexcept;
  [[nodiscard]] bool is_fog() const noexcept;
  [[nodiscard]] bool is_dirt() const noexcept;
  void judge() noexcept;

  Config config_;
  SectorSights sights_;
  std::span<Sector> sectors_;
  std::span<Signs> signs_;  // by sector
  Sign fog_, dirt_;         // of the turn
  int turns_ = 0;
};

}  // namespace terracut::visibility
