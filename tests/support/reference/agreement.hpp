// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calib/mount/mount.hpp"
#include "firmware_io/frame/frame_info.hpp"
#include "firmware_io/frame/loss_counters.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "reference_return.hpp"

namespace terracut::reference {

/// What a reference calls the product's reason to refuse a packet; kNone for those reasons that lie
/// in the stream and not in the packet.
[[nodiscard]] Refusal as_refusal(std::optional<frame::Reject> reason);

/// A return and its place, in the vehicle frame (calib/mount/mount.hpp).
struct PlacedReturn {
  int row = 0, column = 0;
  double x_m = 0, y_m = 0, z_m = 0, ground_range_m = 0;
  double range_m = 0;  ///< From the sensor.
  int intensity = 0;
  bool on_border = false;  ///< Between two columns: `column` may be off by one.
};

/// The frames that a stream should give by a reference decoder.
class ExpectedFrames {
 public:
  /// `elevations`: of each laser, in any unit.
  ExpectedFrames(const std::vector<double>& elevations, const mount::Mount& mount, int columns)
      : rows_(rank_of_elevation(elevations)), mount_(mount), columns_(columns) {}

  /// The next packet, whose azimuths grow by `unwrap_deg` (Frames).
  void add(const Packet& packet, double unwrap_deg);

  /// Frame -> its returns in order of arrival; frames without any do not appear.
  [[nodiscard]] const std::map<std::int64_t, std::vector<PlacedReturn>>& frames() const {
    return frames_;
  }

 private:
  std::vector<int> rows_;
  mount::Mount mount_;
  int columns_;
  std::map<std::int64_t, std::vector<PlacedReturn>> frames_;
};

/// The frames that the product handed over, copied, returns in order of arrival.
class HandedFrames {
 public:
  /// The callable to hand frames over to.
  [[nodiscard]] auto keep() {
    return [this](const frame::FrameInfo& info, const frame::RangeImage& image) noexcept {
      add(info, image);
    };
  }
  [[nodiscard]] const std::vector<std::vector<PlacedReturn>>& frames() const { return frames_; }
  [[nodiscard]] std::size_t returns() const;

 private:
  void add(const frame::FrameInfo& info, const frame::RangeImage& image);

  std::vector<std::vector<PlacedReturn>> frames_;
};

/// The first difference between what should be and what is: frames, their returns in number, order,
/// row, column and intensity, and in place by more than 1 mm + 1e-6 of the range. Empty when there
/// is none.
[[nodiscard]] std::string first_difference(const ExpectedFrames& expected,
                                           const HandedFrames& handed, int columns);

}  // namespace terracut::reference
