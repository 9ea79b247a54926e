// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "calib/mount/mount.hpp"
#include "calib/mount/ring_profile.hpp"
#include "firmware_io/frame/each_return.hpp"
#include "firmware_io/frame/frame_info.hpp"
#include "firmware_io/frame/point_image.hpp"
#include "firmware_io/packet/datagram.hpp"
#include "firmware_io/vehicle/ego_motion.hpp"
#include "input.hpp"
#include "packet_account.hpp"
#include "pipeline/ground/profile.hpp"
#include "pipeline/ground/stream_segmenter.hpp"
#include "pipeline/run/labelled_turns.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "tests/support/allocation_counter.hpp"

namespace terracut::fuzz {

/// The way of packets through a live run, tracker to labels, on one thread and with frames of few
/// columns, and what must hold after every packet, whatever came:
/// - every packet is decoded, rejected for one named reason, told about the device, or in doubt;
/// - a packet completes kMostFramesAPacket frames at most;
/// - frames have the numbers that follow, stamps of packets that came, and returns at finite
/// places;
/// - every return of a packet that was decoded is in a frame or counted as lost;
/// - a frame has a label for each return;
/// - memory stays what it was, and nothing is allocated.
template <class Decoder, class Calibration>
class LiveChainRun {
 public:
  /// One that waited for its successor, two open frames that a restart ends, and two that end
  /// within the frame that was in doubt.
  static constexpr int kMostFramesAPacket = 5;

  struct Config {
    int columns = 64;
    int reorder_packets = 0;
    bool deskew = false;
  };
  /// `returns_in(payload)`: how many returns a decoded payload carries.
  using ReturnsIn = std::uint64_t (*)(std::span<const std::uint8_t> payload);

  LiveChainRun(const Calibration& calibration, ReturnsIn returns_in, const Config& config)
      : returns_in_(returns_in),
        turns_(calibration, ring_profile(calibration, mount::Mount{}),
               decoder_config(config, motion_), ground::turn_maker_of(ground::terracut_profile()),
               memory_),
        points_(turns_.decoder().point_image(memory_)) {
    memory_bytes_ = memory_.total_bytes();
  }

  void feed(std::span<const std::uint8_t> payload, std::int64_t stamp_ns) {
    const std::uint64_t allocations = test::allocations_of_this_thread();
    first_stamp_ns_ = std::min(first_stamp_ns_, stamp_ns);
    last_stamp_ns_ = std::max(last_stamp_ns_, stamp_ns);
    frames_of_packet_ = 0;
    account_.feed(
        turns_.decoder(),
        [&] {
          turns_.push({.payload = payload, .stamp_ns = stamp_ns});
          take_frames();
          return turns_.decoder().rejected();
        },
        [&] { return returns_in_(payload); });
    require(frames_of_packet_ <= kMostFramesAPacket, "one packet completes too many frames");
    require(memory_.total_bytes() == memory_bytes_, "memory was taken after the start");
    if (test::allocations_are_counted()) {
      require(allocations == test::allocations_of_this_thread(), "a packet allocated memory");
    }
  }

  /// The vehicle's motion at this stamp of the host's clock.
  void move(const vehicle::MotionSample& sample) { (void)motion_.add(sample); }
  /// The newest turn is waited for no longer: its successor does not come.
  void wait_no_longer() {
    turns_.wait_no_longer();
    take_frames();
  }
  void flush() {
    account_.flush(turns_.decoder(), [&] {
      turns_.end_stream();
      take_frames();
    });
    const frame::LossCounters losses = turns_.decoder().losses();
    account_.require_all_returns(labelled_returns_ + losses.overflow_full_returns +
                                 losses.late_returns);
  }

 private:
  static typename Decoder::Config decoder_config(const Config& config, vehicle::EgoMotion& motion) {
    typename Decoder::Config result;
    result.columns = config.columns;
    result.reorder_packets = config.reorder_packets;
    result.returns_per_cell = 3;
    if (config.deskew) result.motion = &motion;
    return result;
  }
  static void require_places(const frame::RangeImage& image, std::uint32_t returns) {
    std::uint32_t seen = 0;
    frame::for_each_return(image, [&](const frame::PlacedReturn& placed) {
      require(std::isfinite(placed.point.x_m) && std::isfinite(placed.point.y_m) &&
                  placed.point.ground_range_m >= 0.0F && placed.point.ground_range_m < 1'100.0F,
              "a return lies nowhere");
      ++seen;
    });
    require(seen == returns, "points are not as many as returns");
  }

  static void require_owners(const frame::MeasuredReturns& returns) {
    std::uint64_t owned = 0;
    for (std::size_t tile = 0; tile < returns.tiles(); ++tile) {
      for (std::size_t laser = 0; laser < returns.lasers(); ++laser) {
        const frame::MeasuredReturns::LaserRow& row = returns.row(tile, laser);
        require((row.owned & ~row.returns) == 0, "what is no return owns a cell");
        owned += static_cast<std::uint64_t>(std::popcount(row.owned));
        for (std::uint32_t left = row.returns; left != 0; left &= left - 1) {
          const auto firing = static_cast<std::size_t>(std::countr_zero(left));
          const int column = returns.column(tile, laser, firing);
          require(column >= row.least && column <= row.most && column >= 0 &&
                      column < returns.shape().columns,
                  "a return lies nowhere");
        }
      }
    }
    require(owned <= returns.returns() && owned > 0, "cells have more owners than returns");
  }

  void take_frames() {
    while (const frame::Frame* const frame = turns_.next({}, nullptr)) {
      const frame::FrameInfo& info = frame->info;
      ++frames_of_packet_;
      require(info.number == frames_++, "a frame has not the number that follows");
      require(info.returns > 0 && info.returns == frame->returns->returns(),
              "a frame miscounts its returns");
      require(info.first_packet_ns <= info.last_packet_ns &&
                  info.first_packet_ns >= first_stamp_ns_ && info.last_packet_ns <= last_stamp_ns_,
              "a frame's stamps are of no packet");
      packets_in_frames_ += info.packets;
      require(packets_in_frames_ <= turns_.decoder().packets_decoded() + 1,
              "frames of too many packets");
      labelled_returns_ += info.returns;
      require_owners(*frame->returns);
      require_places(points_.make(*frame->returns, frame->motions), info.returns);
      require(turns_.labels().size() == info.returns, "not every return has a label");
      require(std::ranges::count(turns_.labels(), frame::Label::kNone) == 0,
              "a return has no label");
      require(turns_.report().labelled() == info.returns, "labels are miscounted");
    }
  }

  ReturnsIn returns_in_;
  memory::FixedMemory memory_;
  vehicle::EgoMotion motion_{{.waiting = 16, .kept = 64}, memory_};
  run::LabelledTurns turns_;
  frame::PointImage points_;
  std::size_t memory_bytes_ = 0;

  std::int64_t first_stamp_ns_ = std::numeric_limits<std::int64_t>::max();
  std::int64_t last_stamp_ns_ = std::numeric_limits<std::int64_t>::min();
  PacketAccount account_;
  std::uint64_t labelled_returns_ = 0, packets_in_frames_ = 0;
  std::uint32_t frames_ = 0;
  int frames_of_packet_ = 0;
};

}  // namespace terracut::fuzz
