// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <new>
#include <span>
#include <stdexcept>

#include "firmware_io/frame/each_return.hpp"
#include "firmware_io/frame/frame_info.hpp"
#include "terracut/frame.hpp"

/// Converts internal frames to public ones; not installed.
namespace terracut {

/// Writes the returns of `image` to the beginning of `points`, in order of arrival. `points` must
/// be large enough for all returns.
inline void copy_points(const frame::RangeImage& image, std::span<Point> points) noexcept {
  frame::for_each_return(image, [&](const frame::PlacedReturn& placed) noexcept {
    points[placed.return_index] = {placed.point.x_m, placed.point.y_m, placed.point.z_m,
                                   static_cast<std::uint16_t>(placed.row), placed.point.intensity};
  });
}

/// Converts a frame. Its points are stored in `room`, which must be large enough for the returns of
/// any frame.
[[nodiscard]] inline Frame public_frame(const frame::FrameInfo& info,
                                        const frame::RangeImage& image,
                                        std::span<Point> room) noexcept {
  copy_points(image, room);
  return {.number = info.number,
          .first_packet_ns = info.first_packet_ns,
          .last_packet_ns = info.last_packet_ns,
          .complete = info.complete,
          .deskewed = info.deskew.state == frame::DeskewState::kDone,
          .packets_lost = info.losses.network_gap_packets,
          .points = room.first(info.returns),
          .labels = {}};
}

/// Runs `make`, which constructs an object that takes all its memory at once, and converts an
/// exception into an error.
template <class Make>
[[nodiscard]] auto made(Make&& make) -> Expected<decltype(make())> {
  try {
    return make();
  } catch (const std::invalid_argument& error) {
    return fail(ErrorCode::kInvalidArgument, error.what());
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kCapacityExceeded, "not enough memory");
  }
}

}  // namespace terracut
