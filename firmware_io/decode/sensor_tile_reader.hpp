// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware_io/decode/sensor_trait.hpp"
#include "firmware_io/decode/step_advances.hpp"
#include "firmware_io/packet/firing_returns.hpp"
#include "firmware_io/packet/packet_azimuths.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::decode {

/// Computes the points of tiles of one sensor model.
template <SensorTrait Sensor>
class SensorTileReader final : public frame::TileReader {
 public:
  SensorTileReader(const Sensor& sensor, memory::FixedMemory& memory)
      : sensor_(sensor),
        heads_(memory.take<packet::GroupHeads<Sensor::kGroups>>("decoder tables", 1)),
        advances_(memory) {}

  void open(const frame::TileHeads& heads,
            const frame::TileDistances& distances) noexcept TERRACUT_NONBLOCKING override {
    distances_ = distances;
    packet::GroupHeads<Sensor::kGroups>& found = heads_[0];
    found.sin_rotor = heads.sin_head;
    found.cos_rotor = heads.cos_head;
    advances_.spread(
        heads,
        [this](Directions& of, std::int32_t step_ticks, bool is_dual) noexcept {
          for (std::size_t group = 0; group < Sensor::kGroups; ++group) {
            const packet::SinCos advance =
                packet::small_advance(sensor_.advance_ticks(step_ticks, group, is_dual));
            of.sin[group] = advance.sin;
            of.cos[group] = advance.cos;
          }
        },
        [&found](const Directions& of) noexcept {
          packet::fill_rows(of.sin, found.sin_advance[0].data());
          packet::fill_rows(of.cos, found.cos_advance[0].data());
        },
        [&found](const Directions& of, const FiringMask& mask) noexcept {
          packet::spread_rows(of.sin, mask, found.sin_advance[0].data());
          packet::spread_rows(of.cos, mask, found.cos_advance[0].data());
        });
  }
  void compute_points(std::size_t laser,
                      const frame::PointsOut& out) noexcept TERRACUT_NONBLOCKING override {
    frame::TileRow<float> measured_m;
    const std::size_t at = laser * frame::kTileFirings;
    if constexpr (kHasFineDistancesOf<Sensor>) {
      packet::measure(distances_.raw + at, distances_.fine + at, sensor_.metres_per_count(),
                      measured_m.data());
    } else {
      packet::measure(distances_.raw + at, sensor_.metres_per_count(), measured_m.data());
    }
    sensor_.compute_points(laser, packet::heads_of_group(heads_[0], sensor_.group(laser)),
                           measured_m, out);
  }
  [[nodiscard]] std::span<const std::int32_t> rows() const noexcept TERRACUT_NONBLOCKING override {
    return sensor_.rows();
  }

 private:
  /// Sine and cosine of the head's advance from a firing's azimuth until each group of lasers
  /// fires.
  struct Directions {
    std::array<float, Sensor::kGroups> sin{}, cos{};
  };

  Sensor sensor_;
  std::span<packet::GroupHeads<Sensor::kGroups>> heads_;  ///< A span of one element.
  StepAdvances<Directions> advances_;
  frame::TileDistances distances_{};
};

}  // namespace terracut::decode
