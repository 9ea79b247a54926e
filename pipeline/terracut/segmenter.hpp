// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <memory>
#include <span>

#include "terracut/calibration.hpp"
#include "terracut/error.hpp"
#include "terracut/frame.hpp"

namespace terracut {

/// The method's parameters by name; docs/reference/method.md has their effect.
enum class Profile : std::uint8_t {
  kTerracut,  ///< The default.
  kPaper,     ///< The published method, as it was published.
};

/// A point of a cloud in the sensor frame: x ahead, y left, z up.
struct CloudPoint {
  float x_m = 0, y_m = 0, z_m = 0;
  float remission = 0;  ///< 0..1
};

/// Labels clouds of a 64-ring sensor in the order of KITTI's .bin files: ring after ring from the
/// top, each counter-clockwise from straight ahead.
///
/// The first cloud decides which elevation each ring has; it allocates, and so may a cloud that is
/// larger than all before. One thread; not for threads with a deadline.
class Segmenter {
 public:
  struct Config {
    Mount mount;
    Profile profile = Profile::kTerracut;
  };

  /// kInvalidArgument on a mount out of range.
  [[nodiscard]] static Expected<Segmenter> make(const Config& config);
  Segmenter(Segmenter&&) noexcept;
  Segmenter& operator=(Segmenter&&) noexcept;
  ~Segmenter();

  /// One label a point, in the cloud's order, valid until the next call; kNone for points that are
  /// no return (not finite, null). kMalformed or kUnsupported where the order is another one.
  [[nodiscard]] Expected<std::span<const Label>> label(std::span<const CloudPoint> cloud);

 private:
  struct Engine;
  explicit Segmenter(std::unique_ptr<Engine> engine) noexcept;
  std::unique_ptr<Engine> engine_;
};

}  // namespace terracut
