// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "tests/simulation/fault.hpp"
#include "tests/simulation/sensor_loop.hpp"

namespace terracut::simulation {

/// What is simulated with a seed.
struct Plan {
  std::uint64_t seed = 1;
  bool is_hdl64e = false;        ///< Else a VLP-16.
  bool has_real_method = false;  ///< Else cached labels.
  std::size_t room_packets = 0;  ///< Of the kernel's buffer.
  BlindPlaces blind;
  Faults faults;
};
/// Returns the plan of a seed: an HDL-64E for one seed in sixteen, the real method
/// for one in eight, a limited view for one in four.
[[nodiscard]] Plan plan_of(std::uint64_t seed);

struct Outcome {
  std::optional<std::string> broken;  ///< What did not hold first, and when.
  std::uint64_t digest = 0;           ///< The same for the same plan and version, on any machine.
  double simulated_s = 0;
  std::uint64_t frames = 0, frames_compared = 0;
};
/// Simulates a live run from its start until some turns after the last fault. The first call for a
/// sensor simulates its drive and takes some seconds.
[[nodiscard]] Outcome simulate(const Plan& plan);

/// Returns a plan that still fails with no fault to leave out and none that could be shorter or
/// smaller by half. `plan` must fail.
[[nodiscard]] Plan shrunk(Plan plan);

}  // namespace terracut::simulation
