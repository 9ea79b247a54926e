// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "calib/mount/ring_profile.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "pipeline/stage/cell_planes.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::visibility {

/// Sectors of 10 degrees, clockwise as columns are; the first begins straight ahead.
inline constexpr std::size_t kSectors = 36;

/// What the beams of one sector brought back in one turn. Shares are in [0, 1].
struct SectorSight {
  /// How far beams that would meet level ground return, from whatever they meet: the distance at
  /// which the last row meets it of which half of the beams that used to return still do.
  float visible_m = 0;
  float lost = 0;      ///< Of the beams to near ground that used to return, how many did not.
  float stuck = 0;     ///< Of these beams, how many have not returned for kStuckTurns.
  float returned = 0;  ///< Of all beams, how many returned.
  float far = 0;       ///< Of all beams, how many returned from farther than kFar_m.
  float alone = 0;     ///< Of all beams, how many met something that hangs alone in the near air.
};

/// Looks at a turn's sectors, and learns which beams return. Takes its memory in the constructor;
/// all else is real-time safe.
class SectorSights {
 public:
  /// Ground nearer than this returns nearly every beam.
  static constexpr double kNear_m = 15;
  /// A visible range is no farther than this: dark ground returns little beyond.
  static constexpr double kFarthest_m = 40;
  static constexpr float kFar_m = 20;
  /// A beam that has returned in so many turns, one after the other, is one that used to return.
  static constexpr int kUsualTurns = 5;
  static constexpr int kStuckTurns = 4;

  /// `profile` must have shape.rows rings.
  SectorSights(const mount::RingProfile& profile, frame::ImageShape shape,
               memory::FixedMemory& memory);

  /// Looks at the next turn, an image of the shape given at construction; `planes` has the label of
  /// each cell and its height above the ground. Returns the sectors, valid until the next call.
  [[nodiscard]] std::span<const SectorSight> look(const frame::RangeImage& image,
                                                  const stage::CellPlanes& planes) noexcept
      TERRACUT_NONBLOCKING;

  /// Forgets which beams used to return.
  void forget() noexcept TERRACUT_NONBLOCKING;

 private:
  /// What is known of a beam to the ground.
  struct Beam {
    std::uint8_t returned = 0, lost = 0;  ///< For how many turns now, up to 255.
    bool is_usual = false;                ///< It used to return.
  };
  /// Beams of one row of a sector that used to return.
  struct RowCount {
    int usual = 0, lost = 0, stuck = 0;
  };

  [[nodiscard]] SectorSight look_at(frame::ColumnRange columns, const frame::RangeImage& image,
                                    const stage::CellPlanes& planes) noexcept;
  RowCount look_at_beams(int row, frame::ColumnRange columns,
                         const stage::CellPlanes& planes) noexcept;
  /// True if a return has no other one beside, above or below it within reach.
  [[nodiscard]] bool is_alone(int row, int column, const frame::RangeImage& image) const noexcept;

  frame::ImageShape shape_;
  int near_rows_ = 0, ground_rows_ = 0;  // rows that meet ground nearer than kNear_m, kFarthest_m
  std::span<float> ground_m_;            // by row: where it meets level ground
  std::span<float> alone_by_range_;      // by row: how far apart, by their range, alone returns are
  std::span<Beam> beams_;                // by cell of the ground rows
  std::span<SectorSight> sectors_;
};

}  // namespace terracut::visibility
