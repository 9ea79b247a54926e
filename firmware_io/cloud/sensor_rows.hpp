// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>

#include "firmware_io/cloud/cloud.hpp"
#include "firmware_io/cloud/laser_order.hpp"
#include "firmware_io/cloud/nearest_ring.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "firmware_io/scan/ring_recovery.hpp"
#include "firmware_io/scan/ring_table.hpp"
#include "firmware_io/scan/ring_table_fit.hpp"
#include "rt/error.hpp"

namespace terracut::cloud {

/// What tells which laser measured a point, in the order in which it is looked for.
enum class RowSource : std::uint8_t {
  kLaserNumbers,  ///< A number each point has.
  kOrganisation,  ///< The rows of an organised cloud.
  kKittiOrder,    ///< Ring after ring from the top, as in KITTI's files; 64 rings.
  kElevations,    ///< The elevations of the points.
};

/// "the field of the laser's number"
[[nodiscard]] std::string_view description_of(RowSource source) noexcept;

/// What the first clouds tell of a sensor.
struct SensorRows {
  RowSource source = RowSource::kKittiOrder;
  scan::FittedRings rings;    ///< One for each laser.
  RingOfLaser ring_of_laser;  ///< kLaserNumbers and kOrganisation.
  int columns = 0;            ///< Firings in one revolution.

  [[nodiscard]] frame::ImageShape shape() const noexcept {
    return {static_cast<int>(rings.table.size()), columns};
  }
};

/// A cloud of a sequence, valid until the next one is asked for.
using ReadCloud = std::function<Expected<CloudView>(std::size_t index)>;

/// The order and elevations of lasers that each point names, whatever their numbers. `name_lasers`
/// answers the clouds with `laser`, one below `lasers` a point. kMalformed where the points of a
/// laser lie on no cone around the origin, as in a map's frame.
struct NumberedLasers {
  RingOfLaser ring_of_laser;
  scan::FittedRings rings;
};
[[nodiscard]] Expected<NumberedLasers> fit_numbered_lasers(std::size_t lasers, std::size_t clouds,
                                                           const ReadCloud& name_lasers);

/// Learns from at most 40 of some clouds of one sensor. Start-up: allocates, takes up to a second.
/// Clouds without a place are left out. kUnsupported or kMalformed, with what was found, where
/// nothing tells the lasers apart, where most of them look the same way, or where the points are no
/// metres from the sensor (check_reach()); where no cloud can be read the error of one.
[[nodiscard]] Expected<SensorRows> learn_rows(std::size_t clouds, const ReadCloud& read);

/// Finds the ring of each point of clouds of the sensor that was learnt.
class RowFinder {
 public:
  explicit RowFinder(SensorRows rows);

  /// Fills `found`; of a cloud without a place whatever else it lacks. Points that are no place,
  /// and those of lasers that nothing is known of, get kNoRing. kMalformed where a cloud lacks what
  /// tells its lasers. Allocates nothing beyond the largest cloud so far, except where the rings of
  /// a cloud in KITTI's order are not whole.
  [[nodiscard]] Status find(const CloudView& cloud, scan::RingRecovery& found) const;

  [[nodiscard]] const SensorRows& rows() const noexcept { return rows_; }

 private:
  SensorRows rows_;
  std::optional<NearestRing> nearest_;
};

}  // namespace terracut::cloud
