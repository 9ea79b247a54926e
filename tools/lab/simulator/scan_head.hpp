// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "drive.hpp"
#include "echo.hpp"
#include "object_index.hpp"
#include "tools/lab/drive/firing_plan.hpp"
#include "tools/lab/packets/encoder_traits.hpp"
#include "tools/lab/world/terrain.hpp"

namespace terracut::simulator {

/// The world at the time of one beam.
struct Moment {
  const ObjectIndex* objects = nullptr;
  double after_s = 0;  ///< Time since the objects' update().
  Eigen::Isometry3d T_world_lidar = Eigen::Isometry3d::Identity();
};

/// The simulated sensor: casts the beams of a firing and returns their measurements in units of the
/// wire, through the inverse of the unit's calibration.
///
/// Immutable; any thread may cast.
template <class EncoderTraits>
class ScanHead {
 public:
  using Column = SimulatedColumn<EncoderTraits>;

  /// All arguments must outlive this object.
  ScanHead(const SimulationConfig<EncoderTraits>& config, const world::Terrain& terrain,
           const drive::FiringPlan<EncoderTraits>& plan);

  /// `moments` has one element for even and one for odd frames of the beams; they differ if the
  /// world stands still during each frame. Fills in all fields of `columns`, one for each return of
  /// a firing.
  void cast(const drive::Firing& firing, const std::array<Moment, 2>& moments,
            std::span<Column> columns) const;

 private:
  /// A laser at the time when it fires.
  struct Beam {
    int laser = 0;
    double azimuth_rad = 0;
    std::uint64_t ray_key = 0;
    Eigen::Vector3d origin, direction;  ///< Ray in the sensor's frame.
  };
  /// The surface that a beam meets along one line of sight.
  struct Sighting {
    world::Hit hit;
    Echo echo;
    double cos_incidence = 0;
  };
  struct Measured {
    packets::LabelledReturn wire;
    beams::Point exact;
  };

  [[nodiscard]] std::optional<world::Hit> look(const world::SightLine& line, const Moment& moment,
                                               std::uint64_t ray_key) const;
  [[nodiscard]] std::optional<Sighting> echo_of(const world::SightLine& line,
                                                const std::optional<world::Hit>& hit,
                                                std::uint64_t ray_key, double share) const;
  /// Returns the echo in units of the wire. The sensor assumes that all light comes along the
  /// beam's axis.
  [[nodiscard]] std::optional<Measured> measure(const Beam& beam, const Moment& moment,
                                                const Sighting& sighting) const;
  /// Measures as measure() does, but ignores the beam's bend; for surfaces of which only the range
  /// matters.
  [[nodiscard]] std::optional<Measured> measure_along(const Beam& beam, const Sighting& sighting,
                                                      const Eigen::Vector3d& normal) const;
  void cast_single(const Beam& beam, const Moment& moment, Column& column) const;
  void cast_dual(const Beam& beam, const Moment& moment, std::span<Column> columns) const;
  static void put(const Measured& measured, int laser, Column& column);

  const SimulationConfig<EncoderTraits>* config_;
  const world::Terrain* terrain_;
  const drive::FiringPlan<EncoderTraits>* plan_;
  typename EncoderTraits::Geometry geometry_;
  typename EncoderTraits::Offsets offsets_;
};

}  // namespace terracut::simulator
