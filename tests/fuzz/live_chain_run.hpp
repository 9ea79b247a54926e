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
#include <vector>

#include "calib/mount/mount.hpp"
#include "calib/mount/ring_profile.hpp"
#include "firmware_io/frame/each_return.hpp"
#include "firmware_io/frame/frame_info.hpp"
#include "firmware_io/frame/frame_points.hpp"
#include "firmware_io/frame/point_image.hpp"
#include "firmware_io/packet/datagram.hpp"
#include "firmware_io/vehicle/ego_motion.hpp"
#include "input.hpp"
#include "packet_account.hpp"
#include "pipeline/ground/coarse_stages.hpp"
#include "pipeline/ground/fine_stages.hpp"
#include "pipeline/ground/profile.hpp"
#include "pipeline/live/frame_exchange.hpp"
#include "pipeline/live/live_pipeline.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "tests/support/allocation_counter.hpp"
#include "tests/support/hand_out.hpp"

namespace terracut::fuzz {

/// The way of packets through a live run, tracker to labels, on one thread and with frames of few
/// columns, and what must hold after every packet, whatever came:
/// - every packet is decoded, rejected for one named reason, told about the device, or in doubt;
/// - a packet hands over kMostFramesAPacket frames at most;
/// - frames have the numbers that follow, stamps of packets that came, and returns at finite
/// places;
/// - every return of a packet that was decoded is in a frame or counted as lost;
/// - a frame that the segmenter takes is as it was handed over, and has a label for each return;
/// - memory stays what it was, and nothing is allocated.
template <class Decoder, class Calibration>
class LiveChainRun {
 public:
  /// Two open frames that a restart ends, and two that end within the frame that was in doubt.
  static constexpr int kMostFramesAPacket = 4;

  struct Config {
    int columns = 64;
    int reorder_packets = 0;
    bool deskew = false;
  };
  /// `returns_in(payload)`: how many returns a decoded payload carries.
  using ReturnsIn = std::uint64_t (*)(std::span<const std::uint8_t> payload);

  LiveChainRun(const Calibration& calibration, ReturnsIn returns_in, const Config& config)
      : returns_in_(returns_in),
        decoder_(calibration, {}, decoder_config(config, motion_), memory_),
        exchange_(decoder_.buffers()),
        coarse_points_(decoder_.shape(), decoder_.make_reader(memory_), memory_),
        fine_points_(decoder_.shape(), decoder_.make_reader(memory_), memory_),
        all_points_(decoder_.point_image(memory_)),
        coarse_(ground::terracut_profile(), ring_profile(calibration, mount::Mount{}),
                decoder_.shape(), memory_, &coarse_points_),
        fine_(ground::terracut_profile(), ring_profile(calibration, mount::Mount{}),
              decoder_.shape(), decoder_.return_capacity(), memory_, &fine_points_) {
    planes_.reserve(decoder_.buffers().size());
    for (std::size_t i = 0; i < decoder_.buffers().size(); ++i) {
      planes_.emplace_back(decoder_.shape(), memory_);
    }
    handed_over_.resize(decoder_.buffers().size());
    memory_bytes_ = memory_.total_bytes();
  }

  void feed(std::span<const std::uint8_t> payload, std::int64_t stamp_ns) {
    const std::uint64_t allocations = test::allocations_of_this_thread();
    first_stamp_ns_ = std::min(first_stamp_ns_, stamp_ns);
    last_stamp_ns_ = std::max(last_stamp_ns_, stamp_ns);
    frames_of_packet_ = 0;
    account_.feed(
        decoder_,
        [&] {
          return test::decode(decoder_, packet::Datagram{.payload = payload, .stamp_ns = stamp_ns},
                              hand_over());
        },
        [&] { return returns_in_(payload); });
    const frame::ArrivingFrame arriving = decoder_.arriving();
    if (arriving.returns != nullptr) {
      coarse_.advance(*arriving.returns, arriving.complete_columns, planes_of(*arriving.returns));
    }
    require(frames_of_packet_ <= kMostFramesAPacket, "one packet hands over too many frames");
    require(memory_.total_bytes() == memory_bytes_, "memory was taken after the start");
    if (segmenter_away_ == 0) segment();
    if (test::allocations_are_counted()) {
      require(allocations == test::allocations_of_this_thread(), "a packet allocated memory");
    }
  }

  /// The vehicle's motion at this stamp of the host's clock.
  void move(const vehicle::MotionSample& sample) { (void)motion_.add(sample); }
  /// The segmenter does not take any of the next frames.
  void keep_segmenter_away(int frames) { segmenter_away_ = frames; }
  void flush() {
    account_.flush(decoder_, [&] { test::end_stream(decoder_, hand_over()); });
    segmenter_away_ = 0;
    segment();
    const frame::LossCounters losses = decoder_.losses();
    account_.require_all_returns(handed_returns_ + losses.overflow_full_returns +
                                 losses.late_returns);
  }

 private:
  using Exchange = live::FrameExchange;

  /// What is remembered of a buffer that was handed over.
  struct HandedOver {
    std::uint64_t sum = 0;
    std::uint32_t number = 0;
  };

  static typename Decoder::Config decoder_config(const Config& config, vehicle::EgoMotion& motion) {
    typename Decoder::Config result;
    result.columns = config.columns;
    result.reorder_packets = config.reorder_packets;
    result.buffers = Exchange::kBuffers;
    result.returns_per_cell = 3;
    if (config.deskew) result.motion = &motion;
    return result;
  }
  [[nodiscard]] std::size_t number_of(const frame::MeasuredReturns& returns) const {
    return static_cast<std::size_t>(&returns - first_buffer_);
  }
  [[nodiscard]] stage::CellPlanes& planes_of(const frame::MeasuredReturns& returns) {
    return planes_[number_of(returns)];
  }

  static void require_places(const frame::RangeImage& image, std::uint32_t returns) {
    std::uint32_t seen = 0;
    frame::for_each_return(image, [&](const frame::PlacedReturn& placed) {
      require(std::isfinite(placed.point.x_m) && std::isfinite(placed.point.y_m) &&
                  placed.point.ground_range_m >= 0.0F && placed.point.ground_range_m < 1'000.0F,
              "a return lies nowhere");
      ++seen;
    });
    require(seen == returns, "points are not as many as returns");
  }

  /// Of all that a frame holds.
  static std::uint64_t sum_of(const frame::MeasuredReturns& returns) {
    std::uint64_t sum = returns.returns(), owned = 0;
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
          sum = sum * 31 + static_cast<std::uint64_t>(column);
        }
        sum = sum * 31 + row.owned;
      }
    }
    require(owned <= returns.returns() && owned > 0, "cells have more owners than returns");
    return sum;
  }

  [[nodiscard]] auto hand_over() {
    return [this](const frame::FrameInfo& info,
                  frame::MeasuredReturns& returns) noexcept -> frame::MeasuredReturns* {
      ++frames_of_packet_;
      require(info.number == frames_++, "a frame has not the number that follows");
      require(info.returns > 0 && info.returns == returns.returns(),
              "a frame miscounts its returns");
      require(info.first_packet_ns <= info.last_packet_ns &&
                  info.first_packet_ns >= first_stamp_ns_ && info.last_packet_ns <= last_stamp_ns_,
              "a frame's stamps are of no packet");
      packets_in_frames_ += info.packets;
      require(packets_in_frames_ <= decoder_.packets_decoded() + 1, "frames of too many packets");
      handed_returns_ += info.returns;
      handed_over_[number_of(returns)] = {sum_of(returns), info.number};
      coarse_.finish(returns, planes_of(returns));
      if (segmenter_away_ > 0) --segmenter_away_;
      status::FrameRecord record;
      record.info = info;
      return exchange_.hand_over({&returns, {}, nullptr, record},
                                 [](const run::Frame&) noexcept {});
    };
  }

  void segment() {
    const run::Frame* frame = exchange_.take_if_new();
    if (frame == nullptr) return;
    const frame::MeasuredReturns& returns = *frame->returns;
    const HandedOver& expected = handed_over_[number_of(returns)];
    require(frame->record.info.number == expected.number && sum_of(returns) == expected.sum,
            "a frame changed after it was handed over");
    require(frame->record.info.number + 1 > segmented_, "a frame is segmented after a newer one");
    segmented_ = frame->record.info.number + 1;
    (void)fine_.refine(returns, planes_of(returns));
    require_places(all_points_.make(returns), returns.returns());
    const auto labels = fine_.labels();
    require(labels.size() == frame->record.info.returns, "not every return has a label");
    require(std::ranges::count(labels, frame::Label::kNone) == 0, "a return has no label");
  }

  ReturnsIn returns_in_;
  memory::FixedMemory memory_;
  vehicle::EgoMotion motion_{{.waiting = 16, .kept = 64}, memory_};
  Decoder decoder_;
  const frame::MeasuredReturns* first_buffer_ = decoder_.buffers().data();
  Exchange exchange_;
  frame::FramePoints coarse_points_, fine_points_;
  frame::PointImage all_points_;
  ground::CoarseStages coarse_;
  ground::FineStages fine_;
  std::vector<stage::CellPlanes> planes_;
  std::vector<HandedOver> handed_over_;  ///< By buffer.
  std::size_t memory_bytes_ = 0;

  std::int64_t first_stamp_ns_ = std::numeric_limits<std::int64_t>::max();
  std::int64_t last_stamp_ns_ = std::numeric_limits<std::int64_t>::min();
  PacketAccount account_;
  std::uint64_t handed_returns_ = 0, packets_in_frames_ = 0;
  std::uint32_t frames_ = 0, segmented_ = 0;
  int frames_of_packet_ = 0, segmenter_away_ = 0;
};

}  // namespace terracut::fuzz
