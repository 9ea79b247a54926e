// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
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

/// How the laser of a point is found; the sources are tried in this order.
enum class RowSource : std::uint8_t {
  kLaserNumbers,   ///< Each point has a laser number.
  kOrganisation,   ///< The cloud is organised in rows.
  kKittiOrder,     ///< Points come ring after ring from the top, as in KITTI's files; 64 rings.
  kElevations,     ///< The points form rows by elevation.
  kElevationBins,  ///< Nothing tells lasers; a row is a bin of elevation (elevation_bins.hpp).
};

/// Returns the source in words, such as "the field of the laser's number".
[[nodiscard]] std::string_view description_of(RowSource source) noexcept;

/// What was learnt about a sensor from its first clouds.
struct SensorRows {
  RowSource source = RowSource::kKittiOrder;
  scan::FittedRings rings{};    ///< One ring per laser, or per bin.
  RingOfLaser ring_of_laser{};  ///< Empty unless kLaserNumbers or kOrganisation.
  int columns = 0;              ///< Firings in one revolution, or cells of a row of bins.
  /// The place from which the rows are seen, this far above the points' origin; the sensor's mount
  /// is that of this place. 0 unless kElevationBins.
  double viewpoint_above_m = 0;
  std::string no_lasers{};  ///< With kElevationBins: why there are no lasers' rows, for people.

  [[nodiscard]] frame::ImageShape shape() const noexcept {
    return {static_cast<int>(rings.table.size()), columns};
  }
};

/// Returns a cloud of a sequence, valid until the next call.
using ReadCloud = std::function<Expected<CloudView>(std::size_t index)>;

/// The order and the elevations of a sensor's lasers. fit_numbered_lasers() finds both from clouds
/// whose points have laser numbers, in any numbering: `name_lasers` returns the clouds with `laser`
/// filled, each number below `lasers`. Fails with kMalformed if the points of a laser lie on no
/// cone around the origin, as in a map's frame.
struct NumberedLasers {
  RingOfLaser ring_of_laser;
  scan::FittedRings rings;
};
[[nodiscard]] Expected<NumberedLasers> fit_numbered_lasers(std::size_t lasers, std::size_t clouds,
                                                           const ReadCloud& name_lasers);

/// Learns a sensor's rows from at most 40 of its clouds. Leaves out clouds without any valid
/// position. Fails with kUnsupported or kMalformed if nothing tells the lasers apart, if most
/// lasers have the same elevation, or if check_reach() fails; the message says what was found. If
/// no cloud can be read, fails with the error of one of them. Start-up: allocates, takes up to a
/// second.
[[nodiscard]] Expected<SensorRows> learn_rows(std::size_t clouds, const ReadCloud& read);

/// Finds the ring of each point in further clouds of the same sensor.
class RowFinder {
 public:
  explicit RowFinder(SensorRows rows);

  /// Fills `found`. Points without a valid position and those of unknown lasers get kNoRing; a
  /// cloud with no valid position at all is never an error. Fails with kMalformed if a cloud lacks
  /// the information that tells its lasers. Allocates only for a cloud with more points than every
  /// cloud before, and if the rings of a cloud in KITTI's order are incomplete.
  [[nodiscard]] Status find(const CloudView& cloud, scan::RingRecovery& found) const;

  [[nodiscard]] const SensorRows& rows() const noexcept { return rows_; }

 private:
  SensorRows rows_;
  std::optional<NearestRing> nearest_;
};

}  // namespace terracut::cloud
