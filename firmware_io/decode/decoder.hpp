// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <variant>

#include "calib/mount/mount.hpp"
#include "calib/sensor_calibration.hpp"
#include "firmware_io/decode/blind_sector.hpp"
#include "firmware_io/decode/deskewer.hpp"
#include "firmware_io/decode/frame_builder.hpp"
#include "firmware_io/decode/host_clock.hpp"
#include "firmware_io/decode/packet_returns.hpp"
#include "firmware_io/decode/packets_in_doubt.hpp"
#include "firmware_io/decode/sensors.hpp"
#include "firmware_io/decode/stream_tracker.hpp"
#include "firmware_io/frame/frame_info.hpp"
#include "firmware_io/frame/measured_returns.hpp"
#include "firmware_io/frame/point_image.hpp"
#include "firmware_io/packet/datagram.hpp"
#include "firmware_io/packet/packet_azimuths.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::decode {

/// Turns data packets of one spinning sensor into frames of returns, as measured
/// (frame::MeasuredReturns). A few packets at a time are placed: their columns and the owners of
/// cells are found; all of a frame's returns are placed before it is handed out. Points are made of
/// them where they are needed: with make_reader(), or by a point_image(). Everything that differs
/// between models is in a trait (sensor_trait.hpp).
///
/// Returns of a frame are numbered in order of arrival: packet, block, laser. Every return of a
/// decoded packet is placed or counted (overflow_full_returns, late_returns); a packet is decoded
/// whole or rejected whole, for a named reason. Memory is fixed and a call takes bounded time,
/// whatever arrives. Frames end only by the head's azimuth.
///
///   decoder.push(datagram);
///   while (frame::Frame* frame = decoder.next()) { ... }
///
/// One thread. The constructor takes all memory (throws std::invalid_argument on a bad setting);
/// nothing else allocates, locks or throws (rt/threads/nonblocking.hpp).
class Decoder {
 public:
  struct Config {
    /// Firings per frame at the sensor's spin rate; 0: those at 10 Hz, of an Ouster those of its
    /// mode.
    int columns = 0;
    /// Memory for this many firings per column on average, each a return per cell at most; returns
    /// of further firings are counted and lost. 0: enough for single return at 10 Hz, with a
    /// margin.
    int returns_per_cell = 0;
    /// In dual return, which of the two returns owns the cell. Both are placed and labelled.
    frame::CellOwner dual_owner = frame::CellOwner::kStrongest;
    /// A packet that arrives up to this many packets late still reaches its frame: a frame is
    /// handed over only when the hindmost beam of a later packet begins past the seam and this many
    /// more packets have come. The latency grows by the time of that many packets, plus one; with
    /// 0, a frame is handed over with its last packet. Of packets that are later still, only the
    /// returns of frames already handed over are lost, and counted.
    int reorder_packets = 2;
    /// If set, every frame comes with the motions that deskew its points (Frame::motions). The
    /// decoder's thread becomes the reader of the motion, which must outlive the decoder.
    vehicle::EgoMotion* motion = nullptr;
    frame::FrameInstant deskew_at = frame::FrameInstant::kEnd;
    hdl64e::Hdl64eSensor::Config hdl64e;
    ruby128::Ruby128Sensor::Config ruby128;
    velodyne::VelodyneConfig velodyne;
    hesai::HesaiConfig hesai;
    ouster::OusterConfig ouster;
  };

  /// Makes a decoder for the sensor that the calibration belongs to.
  Decoder(const calib::SensorCalibration& calibration, const mount::Mount& mount,
          const Config& config, memory::FixedMemory& memory);

  /// Takes one datagram, whose payload must stay as it is until next() has returned null.
  ///
  /// A packet that contradicts the stream is kept (packets_kept()) until enough packets agree with
  /// it to begin another stream, or until the old stream continues. Then the packet is decoded, or
  /// rejected and counted.
  void push(const packet::Datagram& datagram) noexcept TERRACUT_NONBLOCKING;
  /// Ends the stream, at its end or before the source jumps (a replay that loops). next() then
  /// hands out the open frames, marked incomplete if any azimuth is missing. Resets the stream's
  /// state, but not the counters.
  void end_stream() noexcept TERRACUT_NONBLOCKING;

  /// Returns the next frame completed by push() or end_stream(); null if there is none and all
  /// pushed packets are decoded. Call this until it returns null. The frame is valid until the next
  /// call, its returns and motions as long as FrameBuilder::next() says.
  [[nodiscard]] frame::Frame* next() noexcept TERRACUT_NONBLOCKING;
  /// Returns why the last datagram was rejected (and counted, unless kDeviceInfo); nothing if it
  /// was not rejected. Valid once next() has returned null.
  [[nodiscard]] std::optional<frame::Reject> rejected() const noexcept { return rejected_; }

  /// Returns the oldest frame not handed over yet, so that work on its columns can start before it
  /// is complete.
  [[nodiscard]] frame::ArrivingFrame arriving() noexcept {
    if (!frames_.started()) return {};
    return {&frames_.returns_of(frames_.oldest()), complete_columns()};
  }

  /// Returns the losses since construction. Missing packets that may still come late are counted as
  /// lost only a few packets later.
  [[nodiscard]] frame::LossCounters losses() const noexcept { return frames_.total_losses(); }
  [[nodiscard]] std::uint64_t packets_decoded() const noexcept { return packets_; }
  /// Returns the number of packets neither decoded nor rejected yet.
  [[nodiscard]] std::size_t packets_kept() const noexcept { return in_doubt_.size(); }
  [[nodiscard]] std::uint64_t columns_decoded() const noexcept { return columns_; }
  [[nodiscard]] std::uint32_t frames() const noexcept { return frames_.frames(); }
  [[nodiscard]] const frame::ImageShape& shape() const noexcept { return frames_.shape(); }
  /// Returns the most returns a frame may have, as MeasuredReturns::return_capacity() does.
  [[nodiscard]] std::size_t return_capacity() const noexcept { return frames_.return_capacity(); }
  /// Returns for each row the azimuth of its beam minus the head's when it fires, in revolutions.
  [[nodiscard]] std::span<const float> beam_turns() const noexcept { return beam_turns_; }
  /// Returns the measured device time between packets; 0 until about 15 packets have been decoded.
  [[nodiscard]] std::int64_t packet_period_ns() const noexcept { return tracker_.period_ns(); }
  /// Returns the device stamp of the last packet that passed the sensor's checks (PacketAzimuths).
  [[nodiscard]] std::int64_t device_stamp_us() const noexcept { return azimuths_.device_stamp_us; }
  /// True if the last decoded packet carried two returns per firing.
  [[nodiscard]] bool dual_return() const noexcept { return azimuths_.dual_return; }
  /// Returns how an RS-Ruby128's stamps are read; null for another sensor.
  [[nodiscard]] const ruby128::RubyTimestampDetector* ruby_timestamp() const noexcept {
    const auto* ruby128 = std::get_if<PacketReturns<ruby128::Ruby128Sensor>>(&sensor_);
    return ruby128 == nullptr ? nullptr : &ruby128->trait().timestamp();
  }
  /// Returns where the sensor is blind, as far as learnt (blind_sector.hpp).
  [[nodiscard]] frame::BlindAzimuths blind() const noexcept {
    return blind_azimuths(blind_.sector());
  }
  /// Makes a reader of the frames. Takes memory; the reader must not outlive this decoder.
  [[nodiscard]] std::unique_ptr<frame::TileReader> make_reader(memory::FixedMemory& memory) const;
  /// Makes an object that makes points of the frames. Takes memory; must not outlive this decoder.
  [[nodiscard]] frame::PointImage point_image(memory::FixedMemory& memory) const {
    return {shape(), return_capacity(), make_reader(memory), memory};
  }
  /// Returns all buffers, for handing frames over by exchange (FrameBuilder); the first two are
  /// open at the start.

 private:
  template <class... Sensor>
  using ReturnsOf = std::variant<PacketReturns<Sensor>...>;
  using SensorReturns = Sensors::In<ReturnsOf>;

  /// Sizes that depend on the sensor.
  struct Model {
    int rows;
    std::size_t lasers;
    int columns, returns_per_cell;
    std::size_t packet_bytes;
    std::int64_t clock_wrap_us;
    bool has_fine;
  };
  [[nodiscard]] static Model model_of(const calib::SensorCalibration& calibration,
                                      const Config& config);
  [[nodiscard]] static SensorReturns sensor_of(const calib::SensorCalibration& calibration,
                                               const mount::Mount& mount, const Config& config,
                                               int columns, memory::FixedMemory& memory);
  [[nodiscard]] static FrameBuilder::Config frame_config(const Model& model);
  Decoder(const Model& model, const calib::SensorCalibration& calibration,
          const mount::Mount& mount, const Config& config, memory::FixedMemory& memory);

  /// Calls `function` with the sensor: by a switch, instead of virtual functions.
  template <std::size_t kIndex = 0, class Function>
  decltype(auto) with_sensor(Function&& function) noexcept {
    auto* sensor = std::get_if<kIndex>(&sensor_);
    if constexpr (kIndex + 1 < std::variant_size_v<SensorReturns>) {
      if (sensor == nullptr) return with_sensor<kIndex + 1>(function);
    }
    return function(*sensor);
  }

  [[nodiscard]] static std::int64_t frame_of(std::int64_t ticks) noexcept {
    const std::int64_t frame = ticks / packet::kRevolution_ticks;
    return ticks % packet::kRevolution_ticks < 0 ? frame - 1 : frame;
  }

  /// Returns the mean step from firing to firing over some hundred packets. One packet's step is
  /// rounded to hundredths of a degree, too coarse to count the firings of a wide gap.
  [[nodiscard]] std::int64_t mean_step(std::int32_t step_ticks) noexcept {
    constexpr std::int64_t kMost_packets = 512;
    steps_ticks_ += step_ticks;
    if (++steps_ == kMost_packets) {
      steps_ticks_ /= 2;
      steps_ /= 2;
    }
    return mean_step_ticks();
  }
  [[nodiscard]] std::int64_t mean_step_ticks() const noexcept {
    return steps_ == 0 ? 0 : steps_ticks_ / steps_;
  }

  /// Returns the number of complete columns of the oldest frame, minus one because beam azimuths
  /// are rounded to columns.
  [[nodiscard]] int complete_columns() const noexcept {
    const std::int64_t complete_ticks =
        placed_ticks_ - frames_.oldest() * packet::kRevolution_ticks;
    const std::int64_t columns =
        complete_ticks * frames_.shape().columns / packet::kRevolution_ticks - 1;
    return static_cast<int>(std::clamp<std::int64_t>(columns, 0, frames_.shape().columns));
  }

  /// Returns where a packet begins that nothing is missing before.
  [[nodiscard]] std::int64_t next_packet_cdeg() const noexcept {
    return blind_.next_packet(frontier_ticks_) / packet::kTicksPerCdeg;
  }
  /// Returns how many of `packets` missing packets, over many frames, the sensor would have sent:
  /// it sends none while its head passes the blind sector.
  [[nodiscard]] std::int64_t seen_share(std::int64_t packets) const noexcept {
    return packets - packets * (blind_.sector().once.ticks() / packet::kTicksPerCdeg) /
                         beams::kRevolution_cdeg;
  }
  void count_rejected(frame::Reject reason) noexcept {
    ++frames_.losses().rejected[static_cast<std::size_t>(reason)];
  }
  void reject(frame::Reject reason) noexcept {
    count_rejected(reason);
    rejected_ = reason;
  }
  /// Returns the host's time of the first firing of a packet with a blind sector inside. The device
  /// stamps the first firing, the host the arrival, and the sector lies between the two. A
  /// capture's stamps may be anything, so the result may wrap.
  [[nodiscard]] std::int64_t host_began_ns(std::int64_t stamp_ns) const noexcept {
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(stamp_ns) -
                                     static_cast<std::uint64_t>(azimuths_.sector_ns()));
  }
  /// The packet being decoded; azimuths_ holds its azimuths.
  struct Job {
    std::span<const std::uint8_t> payload;
    std::int64_t stamp_ns = 0;
    Placement placed;
    packet::BeamSpread spread;
    /// Azimuths that the head swept in the packet, without late columns.
    packet::RotorInterval swept;
    int late_columns = 0;
    std::int64_t first_frame = 0, last_frame = 0;  ///< Frames that the packet's beams may touch.
    BlindSector::Stride stride;
    std::int64_t step_ticks = 0;
  };
  /// The step that follows once all finished frames are handed out.
  enum class Step : std::uint8_t {
    kNothing,
    kTakeKept,  ///< Decode the kept packets as a new stream.
    kRestart,   ///< Start the stream; the frames of the old one are handed out.
    kPlace,     ///< Place the packet's returns; there is room for all of them.
    kEnd,       ///< End the stream.
  };
  /// Does one step; false if none is left.
  bool go_on() noexcept;
  /// Begins a new stream with the packets in doubt, if any; `then` is the step after that.
  void begin_anew(Step then) noexcept;
  void take_kept() noexcept;
  /// Decodes the packet that the tracker has placed, in two or three steps.
  void take(std::span<const std::uint8_t> payload, std::int64_t stamp_ns,
            const Placement& placed) noexcept;
  void restart() noexcept;
  /// Updates the stream's state, and ends the frames that must end before the packet is placed.
  void judge() noexcept;
  void place() noexcept;
  void end_frames_before(std::int64_t frame) noexcept;
  /// Places the returns of packets collected so far.
  void place_rest() noexcept;
  void end() noexcept;

  /// Judges the gap between the last packet and the present one, which came in order.
  void judge_gap(const Placement& placed, const packet::RotorInterval& swept,
                 const BlindSector::Stride& stride, const packet::BeamSpread& spread,
                 std::int64_t step_ticks) noexcept;
  /// Judges a blind sector inside the packet.
  void cross_sector(const packet::RotorInterval& swept, const BlindSector::Stride& stride,
                    const packet::BeamSpread& spread, std::int64_t step_ticks) noexcept;
  /// Returns how many packets are missing by their stamps. Around a packet with a blind sector
  /// inside, stamps include the time of the sector, so the loss after such a packet is counted by
  /// azimuth.
  [[nodiscard]] std::int64_t missing_before(const Placement& placed,
                                            const packet::RotorInterval& swept) const noexcept {
    if (!has_crossed_) return placed.missing;
    const packet::RotorInterval gap{frontier_ticks_, swept.from_ticks};
    return std::min(placed.missing,
                    (gap.ticks() + azimuths_.pace_ticks / 2) / azimuths_.pace_ticks);
  }
  /// Returns how many columns of a packet are too late. A packet with a blind sector inside arrives
  /// when the head is back in view. Its columns from before the sector may belong to a frame that
  /// was handed over, or that must be handed over to make room for the columns after the sector, as
  /// only two frames are open.
  [[nodiscard]] int columns_too_late(const Placement& placed, const packet::BeamSpread& spread,
                                     std::int64_t last_frame) const noexcept {
    const std::int64_t hindmost_ticks =
        placed.rotor_cdeg * packet::kTicksPerCdeg + spread.hindmost_ticks;
    const bool is_restart = placed.arrival == Arrival::kRestart;
    const std::int64_t open =
        is_restart ? last_frame - 1 : std::max(frames_.oldest(), last_frame - 1);
    return frame_of(hindmost_ticks) < open ? azimuths_.behind_sector : 0;
  }
  /// Counts the pending gaps that have turned out to be lost.
  void count_due() noexcept {
    const BlindSector::Loss due = blind_.take_due();
    const std::int64_t step_ticks = std::max<std::int64_t>(1, mean_step_ticks());
    frames_.losses().network_gap_packets += static_cast<std::uint64_t>(due.packets);
    frames_.losses().azimuth_hole_columns +=
        static_cast<std::uint64_t>((due.ticks + step_ticks / 2) / step_ticks);
  }
  int reorder_packets_;
  frame::CellOwner dual_owner_;
  SensorReturns sensor_;
  StreamTracker tracker_;
  FrameBuilder frames_;
  BlindSector blind_{packet::kRevolution_ticks};
  HostClock clock_;
  std::span<float> beam_turns_;
  std::optional<Deskewer> deskewer_;
  PacketsInDoubt in_doubt_;
  packet::PacketAzimuths azimuths_;
  Step step_ = Step::kNothing;
  Step after_packet_ = Step::kNothing;  ///< The step that follows when the packet is decoded.
  Job job_;
  struct {
    bool has_begun = false;
    Step then = Step::kNothing;
  } anew_;  ///< Set while packets that were in doubt become the stream.
  std::optional<frame::Reject> rejected_;
  std::int64_t frontier_ticks_ = 0;  ///< The head has been seen up to this azimuth.
  std::int64_t crossed_ticks_ = 0;   ///< The end of the blind sector met last.
  std::int64_t complete_ticks_ = 0;  ///< No more returns are expected up to this azimuth.
  std::int64_t placed_ticks_ = 0;    ///< All returns are placed up to this azimuth.
  std::int64_t steps_ticks_ = 0, steps_ = 0;
  bool has_crossed_ = false;  ///< True if the last packet has a sector inside.
  std::uint64_t packets_ = 0, columns_ = 0;
};

}  // namespace terracut::decode
