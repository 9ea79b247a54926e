// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "calib/mount/ring_profile.hpp"
#include "firmware_io/frame/image_shape.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "pipeline/objects/object_finder.hpp"
#include "pipeline/points/labelled_point.hpp"
#include "pipeline/points/sector_record.hpp"
#include "pipeline/stage/cell_planes.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "terracut/frame.hpp"

namespace terracut::points {

/// Finds objects while the sensor turns, sector by sector: each as soon as no later return is near
/// enough to belong to it. Turns follow each other without a seam: an object where a turn ends is
/// seen whole with the beginning of the next one. What the first turn begins with is left out.
///
/// The obstacle returns of objects that may go on are put into an image at every few sectors, and
/// looked at again (objects::ObjectFinder). The sensor may turn either way round.
///
/// Takes its memory in the constructor; allocates nothing later. One thread at a time.
class CompleteObjects {
 public:
  /// How many sectors come between two looks.
  static constexpr int kSectorsALook = 3;
  /// An object that stretches over more of a turn comes in pieces.
  static constexpr double kMostWay_turns = 5.0 / 6;

  /// `profile` must have shape.rows rings; at most `most_points` obstacle returns are kept, further
  /// ones belong to no object.
  CompleteObjects(const mount::RingProfile& profile, frame::ImageShape shape,
                  std::size_t most_points);

  /// Takes the next sector and returns the objects that are complete now, valid until the next
  /// call. `heights_m` has the height of each point above the ground. A frame whose number does not
  /// follow begins anew: objects that were not complete are forgotten.
  std::span<const CompleteObject> take(const SectorRecord& sector,
                                       std::span<const LabelledPoint> points,
                                       std::span<const float> heights_m) noexcept;

 private:
  /// Where a kept return comes from.
  struct Origin {
    double way_rad;                ///< Angle by which the sensor had turned since the beginning.
    std::int64_t first_packet_ns;  ///< Of its sector.
    std::uint32_t frame, return_index;
    float height_m;
    bool is_handed_out;  ///< With an object.
  };
  /// What the returns of an object, or one return, lie between.
  struct Stretch {
    double begin_rad, end_rad;
    float nearest_m;
    std::uint32_t frame, first_return;  ///< The last frame, and the first return of it.
    bool is_closed;                     ///< Nothing is added to it any more.
    bool is_over;                       ///< And nothing that lies behind it goes on.
  };

  void begin() noexcept;
  /// Follows the sensor to a sector, of which the azimuths are known.
  void advance(std::span<const float> azimuths_rad) noexcept;
  /// Counts the way in the other direction.
  void turn_around() noexcept;
  void keep_obstacles(const SectorRecord& sector, std::span<const LabelledPoint> points,
                      std::span<const float> heights_m) noexcept;
  void look() noexcept;
  /// Finds where objects lie, and which of them are closed and over.
  void measure_objects() noexcept;
  /// Lists the objects that are complete and were not handed out before.
  void hand_out() noexcept;
  /// Forgets the returns of objects that are over, and those that can belong to none.
  void forget() noexcept;
  /// Returns the angle within which returns can belong to what is that far away.
  [[nodiscard]] float reach_rad(float range_m) const noexcept;
  [[nodiscard]] bool is_closed(double end_rad, float nearest_m) const noexcept {
    return end_rad + reach_rad(nearest_m) <= edge_rad_;
  }

  memory::FixedMemory memory_;
  frame::RangeImage image_;
  stage::CellPlanes planes_;
  objects::ObjectFinder::Config config_;
  objects::ObjectFinder finder_;

  std::uint32_t frame_ = 0;
  int sectors_ = 0;             ///< Since the beginning.
  float direction_ = 1;         ///< 1: clockwise, -1: counterclockwise.
  float last_azimuth_rad_ = 0;  ///< Of the middle point of the newest sector,
  double last_way_rad_ = 0;     ///< and the way to it.
  double begin_rad_ = 0;        ///< End of the first sector.
  double edge_rad_ = 0;         ///< All returns before it have come.

  std::vector<LabelledPoint> points_;  ///< Obstacle returns that are kept.
  std::vector<Origin> origins_;        ///< Of each of them.
  std::vector<frame::Label> labels_;   ///< Of each of them: obstacles all.

  std::vector<float> azimuths_rad_;  ///< Of the newest sector.
  std::vector<Stretch> stretches_;   ///< By object.
  std::vector<CompleteObject> complete_;
};

}  // namespace terracut::points
