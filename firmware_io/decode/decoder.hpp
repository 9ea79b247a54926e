// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "calib/mount/mount.hpp"
#include "firmware_io/decode/blind_sector.hpp"
#include "firmware_io/decode/column_returns.hpp"
#include "firmware_io/decode/datagram.hpp"
#include "firmware_io/decode/deskewer.hpp"
#include "firmware_io/decode/frame_builder.hpp"
#include "firmware_io/decode/host_clock.hpp"
#include "firmware_io/decode/packet_azimuths.hpp"
#include "firmware_io/decode/stream_tracker.hpp"
#include "firmware_io/frame/frame_info.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "rt/memory/fixed_memory.hpp"

namespace terracut::decode {

/// Data packets of one spinning sensor in, frames of returns out. A return goes straight into its
/// cell while its packet is read.
///
/// `Sensor` is a trait: all that differs from model to model, resolved at compile time. It has
/// - `Calibration`, `Config`; `kRows` lasers; `kPacketBytes`, the size of a data packet;
///   `kClockWrap_us`, where the device clock wraps;
///   `kDefaultColumns`, `kDefaultReturnsPerCell`: Decoder::Config for single return at 10 Hz;
/// - a constructor (const Calibration&, const mount::Mount&, const Config&, int columns,
///   memory::FixedMemory&);
/// - `check(payload, PacketAzimuths&)`: the reason to reject a payload, or nothing and its heads;
/// - `spread(step_ticks)`: the BeamSpread around the head;
/// - `beam_ticks(laser)`: azimuth of a laser's beam minus the head's when it fires;
/// - `begin_packet(azimuths)`, then `read_column(payload, azimuths, column, found)` for each column
/// in
///   frame, which fills in its ColumnReturns<kRows>;
/// - `rows()`: the range image row of each laser.
/// All but the constructor are noexcept. See hdl64e/hdl64e_sensor.hpp, ruby128/ruby128_sensor.hpp.
///
/// Returns of a frame are numbered in order of arrival: packet, block, laser. Every return of a
/// decoded packet is placed or counted (overflow_full_returns, late_returns); a packet is decoded
/// whole or rejected whole, for a named reason. Whatever arrives, memory stays fixed and a call
/// takes a bounded time: frames are handed over by azimuth progress only.
///
///   decoder.push(datagram);
///   while (frame::Frame* frame = decoder.next()) { ... }
///
/// One thread. The constructor takes all memory (throws std::invalid_argument on a bad setting);
/// all else allocates nothing, locks nothing and throws nothing (rt/threads/nonblocking.hpp).
template <class Sensor>
class Decoder {
 public:
  struct Config {
    /// Firings per frame at the sensor's spin rate.
    int columns = Sensor::kDefaultColumns;
    /// Room for so many returns a cell on average; beyond, they are counted and lost.
    int returns_per_cell = Sensor::kDefaultReturnsPerCell;
    /// In dual return: which return owns a cell. All of them are placed and labelled.
    frame::CellOwner dual_owner = frame::CellOwner::kStrongest;
    int images = 3;  ///< FrameBuilder::Config::images
    /// Packets that come late by so many still find their frame: it is handed over when the
    /// hindmost beam of the packet so many before the newest begins past the seam. Costs their time
    /// as latency, and that of the packet that shows it. 0: with the frame's last packet. Of those
    /// that come late all the same, only what belongs to a frame handed over is lost, and counted.
    int reorder_packets = 2;
    /// Deskews every frame before it is handed over (FrameInfo::deskew).
    /// This decoder's thread is its reader, and the motion must outlive the decoder. Null: returns
    /// are handed over as seen.
    vehicle::EgoMotion* motion = nullptr;
    frame::FrameInstant deskew_at = frame::FrameInstant::kEnd;
    typename Sensor::Config sensor;
  };

  Decoder(const typename Sensor::Calibration& calibration, const mount::Mount& mount,
          const Config& config, memory::FixedMemory& memory)
      : reorder_packets_(config.reorder_packets),
        dual_owner_(config.dual_owner),
        return_capacity_(frame::ImageShape{kRows, config.columns}.cells() +
                         frame_config(config).overflow_capacity),
        sensor_(calibration, mount, config.sensor, config.columns, memory),
        tracker_(Sensor::kClockWrap_us, memory),
        frames_(frame_config(config), memory),
        clock_(Sensor::kClockWrap_us),
        kept_(memory.take<KeptPacket>("packets in doubt", kMostKept)) {
    if (config.motion == nullptr) return;
    std::array<std::int32_t, kLasers> beam_ticks{};
    for (std::size_t i = 0; i < kLasers; ++i) {
      beam_ticks[static_cast<std::size_t>(sensor_.rows()[i])] =
          sensor_.beam_ticks(static_cast<int>(i));
    }
    deskewer_.emplace(
        Deskewer::Config{config.motion, config.deskew_at, frames_.shape(), kRevolution_ticks},
        beam_ticks, memory);
  }

  /// Takes one datagram, whose payload must stay as it is until next() has returned null.
  ///
  /// A packet that contradicts the stream before it is kept (packets_kept()) until so many agree
  /// with it that it is the beginning of another stream, or until the stream goes on. It is decoded
  /// then, or rejected and counted.
  void push(const Datagram& datagram) noexcept TERRACUT_NONBLOCKING;
  /// The stream ends, or the source will jump (a replay loop): what is open is handed out, marked
  /// incomplete unless it was seen whole, and the stream's state is reset, but not its
  /// counters.
  void end_stream() noexcept TERRACUT_NONBLOCKING;

  /// The next frame that was completed by what was pushed, or that the stream's end left; null:
  /// there is none, and all that was pushed is decoded. Must be called until then. Valid until the
  /// next call; how long the image is, and `in_exchange`: FrameBuilder::next().
  [[nodiscard]] frame::Frame* next(frame::RangeImage* in_exchange = nullptr) noexcept
      TERRACUT_NONBLOCKING;
  /// Why the datagram pushed last was rejected (and counted, other than kDeviceInfo), if it was;
  /// known when next() has returned null.
  [[nodiscard]] std::optional<frame::Reject> rejected() const noexcept { return rejected_; }

  /// The oldest frame that was not handed over yet, for whoever wants to begin with its columns
  /// before it is whole. None of them is complete where the frame will be deskewed.
  [[nodiscard]] frame::ArrivingFrame arriving() noexcept {
    if (!frames_.started()) return {};
    const RotorInterval to_come{
        complete_ticks_ + completes_behind_ticks_,
        (frames_.oldest() + 1) * kRevolution_ticks + completes_behind_ticks_};
    return {&frames_.image(frames_.oldest()), deskewer_ ? 0 : complete_columns(),
            static_cast<float>(blind_.sector().outside_ticks(to_come)) /
                static_cast<float>(kRevolution_ticks)};
  }

  /// Since construction. Packets still expected out of order become losses a few packets later.
  [[nodiscard]] frame::LossCounters losses() const noexcept { return frames_.total_losses(); }
  [[nodiscard]] std::uint64_t packets_decoded() const noexcept { return packets_; }
  /// Neither decoded nor rejected yet.
  [[nodiscard]] std::size_t packets_kept() const noexcept { return kept_packets_; }
  [[nodiscard]] std::uint64_t columns_decoded() const noexcept { return columns_; }
  [[nodiscard]] std::uint32_t frames() const noexcept { return frames_.frames(); }
  [[nodiscard]] const frame::ImageShape& shape() const noexcept { return frames_.shape(); }
  /// The most returns a frame may have, as RangeImage::return_capacity().
  [[nodiscard]] std::size_t return_capacity() const noexcept { return return_capacity_; }
  /// Device time between packets, measured; 0 until about 15 packets have been decoded.
  [[nodiscard]] std::int64_t packet_period_ns() const noexcept { return tracker_.period_ns(); }
  /// Device clock of the last packet that passed the sensor's checks (PacketAzimuths).
  [[nodiscard]] std::int64_t device_stamp_us() const noexcept { return azimuths_.device_stamp_us; }
  /// The last packet decoded carried two returns per firing.
  [[nodiscard]] bool dual_return() const noexcept { return azimuths_.dual_return; }
  /// From firing to firing, mean of the last packets; 0 before the first.
  [[nodiscard]] double step_deg() const noexcept {
    return steps_ == 0 ? 0 : static_cast<double>(steps_ticks_) / static_cast<double>(steps_) * 1e-5;
  }
  [[nodiscard]] const Sensor& sensor() const noexcept { return sensor_; }
  /// Where the sensor is blind, as far as that has been learnt (blind_sector.hpp).
  [[nodiscard]] frame::BlindAzimuths blind() const noexcept {
    return blind_azimuths(blind_.sector());
  }
  /// All images, for a hand-over by exchange (FrameBuilder); the first two are open at the start.
  [[nodiscard]] std::span<frame::RangeImage> images() noexcept { return frames_.images(); }

 private:
  static constexpr int kRows = Sensor::kRows;
  static constexpr auto kLasers = static_cast<std::size_t>(kRows);

  [[nodiscard]] static FrameBuilder::Config frame_config(const Config& config) {
    const frame::ImageShape shape{kRows, config.columns};
    const auto spare = static_cast<std::size_t>(std::max(0, config.returns_per_cell - 1));
    return {shape, spare * static_cast<std::size_t>(kRows * config.columns), config.images,
            kRevolution_ticks};
  }

  [[nodiscard]] static std::int64_t frame_of(std::int64_t ticks) noexcept {
    const std::int64_t frame = ticks / kRevolution_ticks;
    return ticks % kRevolution_ticks < 0 ? frame - 1 : frame;
  }

  /// From firing to firing, over some hundred packets: one packet's own step is rounded to the
  /// wire's hundredths, too coarse to count the firings of a wide gap.
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

  /// Of the oldest frame. Beams' columns are rounded, each by less than one.
  [[nodiscard]] int complete_columns() const noexcept {
    const std::int64_t complete_ticks = complete_ticks_ - frames_.oldest() * kRevolution_ticks;
    const std::int64_t columns = complete_ticks * frames_.shape().columns / kRevolution_ticks - 1;
    return static_cast<int>(std::clamp<std::int64_t>(columns, 0, frames_.shape().columns));
  }

  /// Of packets missing over many frames, those that a sensor sends while it is not blind.
  [[nodiscard]] std::int64_t seen_share(std::int64_t packets) const noexcept {
    return packets -
           packets * (blind_.sector().once.ticks() / kTicksPerCdeg) / beams::kRevolution_cdeg;
  }
  void count_rejected(frame::Reject reason) noexcept {
    ++frames_.losses().rejected[static_cast<std::size_t>(reason)];
  }
  void reject(frame::Reject reason) noexcept {
    count_rejected(reason);
    rejected_ = reason;
  }
  /// A packet that contradicts the stream.
  struct KeptPacket {
    std::array<std::uint8_t, Sensor::kPacketBytes> bytes;
    PacketAzimuths azimuths;
    std::int64_t stamp_ns;
    std::int64_t rotor_cdeg;  ///< Placement::rotor_cdeg
    frame::Reject reason;     ///< Unless others agree with it.
  };
  void keep(const Datagram& datagram, const Placement& placed) noexcept;
  void reject_kept() noexcept {
    for (std::size_t i = 0; i < kept_packets_; ++i) count_rejected(kept_[i].reason);
    kept_packets_ = 0;
  }
  /// The device stamps a packet's first firing, the host its arrival: a sector inside lies between.
  /// A capture's stamps may be anything, so this may wrap.
  [[nodiscard]] std::int64_t host_began_ns(std::int64_t stamp_ns) const noexcept {
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(stamp_ns) -
                                     static_cast<std::uint64_t>(azimuths_.sector_ns()));
  }
  /// The packet that is being decoded; azimuths_ are its own.
  struct Job {
    std::span<const std::uint8_t> payload;
    std::int64_t stamp_ns = 0;
    Placement placed;
    BeamSpread spread;
    RotorInterval swept;  ///< Where the head is while it fires, its late columns left out.
    int late_columns = 0;
    std::int64_t first_frame = 0, last_frame = 0;  ///< Which its beams may touch.
    BlindSector::Stride stride;
    std::int64_t step_ticks = 0;
  };
  /// What is left to do when the frames that were over are handed out.
  enum class Step : std::uint8_t {
    kNothing,
    kTakeKept,    ///< The packets that were kept are the stream from here on.
    kTakePushed,  ///< The packet that showed that they are.
    kRestart,     ///< The frames of the stream before are handed out.
    kPlace,       ///< There is room for the packet's returns.
    kEnd,         ///< The stream ends.
  };
  /// Does a step; false where there was none.
  bool go_on() noexcept;
  /// The packets that were kept are the stream from here on, those of the last frame up to the head
  /// at `newest_cdeg`: for more revolutions more frames would be handed out at once.
  void begin_anew(std::int64_t newest_cdeg, bool has_pushed) noexcept;
  void take_kept() noexcept;
  void take_pushed() noexcept;
  /// Decodes what the tracker has placed, in two or three steps.
  void take(std::span<const std::uint8_t> payload, std::int64_t stamp_ns,
            const Placement& placed) noexcept;
  void restart() noexcept;
  /// What it tells of the stream, and which frames are over before it can be placed.
  void judge() noexcept;
  void place() noexcept;
  void end() noexcept;

  /// What lies between the packets before and this one, taken in order.
  void judge_gap(const Placement& placed, const RotorInterval& swept,
                 const BlindSector::Stride& stride, const BeamSpread& spread,
                 std::int64_t step_ticks) noexcept;
  /// A sector inside the packet.
  void cross_sector(const RotorInterval& swept, const BlindSector::Stride& stride,
                    const BeamSpread& spread, std::int64_t step_ticks) noexcept;
  /// Missing by the stamps. Those around a packet with a sector inside hold its time, too: what was
  /// lost behind such a packet shows in the azimuths.
  [[nodiscard]] std::int64_t missing_before(const Placement& placed,
                                            const RotorInterval& swept) const noexcept {
    if (!has_crossed_) return placed.missing;
    const RotorInterval gap{frontier_ticks_, swept.from_ticks};
    return std::min(placed.missing,
                    (gap.ticks() + azimuths_.pace_ticks / 2) / azimuths_.pace_ticks);
  }
  /// A packet with a sector inside comes when the head is back in view. Its columns from before are
  /// too late for a frame that was handed over in time, or is by the columns behind: two are open.
  [[nodiscard]] int columns_too_late(const Placement& placed, const BeamSpread& spread,
                                     std::int64_t last_frame) const noexcept {
    const std::int64_t hindmost_ticks = placed.rotor_cdeg * kTicksPerCdeg + spread.hindmost_ticks;
    const bool is_restart = placed.arrival == Arrival::kRestart;
    const std::int64_t open =
        is_restart ? last_frame - 1 : std::max(frames_.oldest(), last_frame - 1);
    return frame_of(hindmost_ticks) < open ? azimuths_.behind_sector : 0;
  }
  /// What was found to be lost after all.
  void count_due() noexcept {
    const BlindSector::Loss due = blind_.take_due();
    const std::int64_t step_ticks = std::max<std::int64_t>(1, mean_step_ticks());
    frames_.losses().network_gap_packets += static_cast<std::uint64_t>(due.packets);
    frames_.losses().azimuth_hole_columns +=
        static_cast<std::uint64_t>((due.ticks + step_ticks / 2) / step_ticks);
  }
  /// The first `late_columns` are left out and counted.
  void place_packet(std::span<const std::uint8_t> payload, std::int64_t rotor_cdeg,
                    int late_columns, bool is_in_one_frame) noexcept;
  void leave_out(int late_columns) noexcept;
  /// Places a packet's returns laser by laser. Each cache line of the image then is written once
  /// and not once a firing, which takes half the time. Returns false and places nothing where the
  /// overflow list might run full.
  [[nodiscard]] bool place_by_laser(std::int64_t rotor_cdeg, frame::CellOwner owner) noexcept;
  /// In the order of arrival, into any of the open frames.
  void place_by_firing(std::int64_t rotor_cdeg, frame::CellOwner owner) noexcept;
  [[nodiscard]] std::int64_t frame_of_beam(std::int64_t rotor_cdeg, std::size_t column,
                                           std::size_t laser) const noexcept {
    const std::int64_t column_cdeg = rotor_cdeg + azimuths_.advance_cdeg(static_cast<int>(column));
    return (column_cdeg - beams::wrap_cdeg(column_cdeg)) / beams::kRevolution_cdeg +
           found_[column].frame_offset[laser];
  }
  [[nodiscard]] frame::Return point(std::size_t column, std::size_t laser) const noexcept {
    const ColumnReturns<kLasers>& found = found_[column];
    return {found.x_m[laser], found.y_m[laser], found.z_m[laser], found.ground_range_m[laser],
            found.intensity[laser]};
  }
  static constexpr std::size_t kMostKept = StreamTracker::kNewStream_packets - 1;

  int reorder_packets_;
  frame::CellOwner dual_owner_;
  std::size_t return_capacity_;
  Sensor sensor_;
  StreamTracker tracker_;
  FrameBuilder frames_;
  BlindSector blind_{kRevolution_ticks};
  HostClock clock_;
  std::optional<Deskewer> deskewer_;
  std::span<KeptPacket> kept_;
  std::size_t kept_packets_ = 0;
  PacketAzimuths azimuths_;
  Step step_ = Step::kNothing;
  Step after_packet_ = Step::kNothing;  ///< When the job is done.
  Job job_;
  struct {
    std::size_t next = 0;  ///< Of those kept.
    bool has_begun = false, has_pushed = false;
    std::int64_t newest_cdeg = 0;
    PacketAzimuths pushed_azimuths;
    Datagram pushed;
  } anew_;  ///< While packets that were kept become the stream.
  std::optional<frame::Reject> rejected_;
  std::array<ColumnReturns<kLasers>, PacketAzimuths::kMaxColumns> found_{};  ///< Of one packet.
  std::int64_t frontier_ticks_ = 0;          ///< The head has been seen up to here.
  std::int64_t complete_ticks_ = 0;          ///< Up to here no more returns are expected.
  std::int64_t completes_behind_ticks_ = 0;  ///< Usual distance of complete_ticks_ behind the head.
  std::int64_t steps_ticks_ = 0, steps_ = 0;
  bool has_crossed_ = false;  ///< A sector lies in the packet before.
  std::uint64_t packets_ = 0, columns_ = 0;
};

template <class Sensor>
void Decoder<Sensor>::push(const Datagram& datagram) noexcept {
  rejected_.reset();
  auto reason = sensor_.check(datagram.payload, azimuths_);
  if (!reason && azimuths_.behind_sector > 0 && !blind_.is_inside(azimuths_)) {
    reason = frame::Reject::kAzimuthJump;
  }
  if (reason) {
    if (*reason == frame::Reject::kStationary) {
      tracker_.note_stationary(azimuths_.device_stamp_us, azimuths_.first_cdeg(), frames_.losses());
    } else if (*reason == frame::Reject::kAzimuthOutOfRange ||
               *reason == frame::Reject::kAzimuthMismatch ||
               *reason == frame::Reject::kAzimuthJump) {
      tracker_.note_rejected(azimuths_.device_stamp_us);
    } else if (*reason == frame::Reject::kDeviceInfo) {
      rejected_ = reason;  // nothing is lost with it
      return;
    }
    return reject(*reason);
  }
  const std::int64_t began_ns = host_began_ns(datagram.stamp_ns);
  const Placement placed = tracker_.place(azimuths_, began_ns, frames_.losses());
  if (placed.arrival == Arrival::kRejected) return reject(placed.reject);
  if (placed.arrival == Arrival::kDoubtful) {
    if (placed.is_first_in_doubt) reject_kept();
    return keep(datagram, placed);
  }
  if (placed.arrival == Arrival::kNewStream) {
    anew_.pushed = datagram;
    anew_.pushed_azimuths = azimuths_;
    return begin_anew(placed.rotor_cdeg, true);
  }
  reject_kept();
  after_packet_ = Step::kNothing;
  take(datagram.payload, datagram.stamp_ns, placed);
}

template <class Sensor>
void Decoder<Sensor>::end_stream() noexcept {
  if (kept_packets_ > 0) return begin_anew(kept_[kept_packets_ - 1].rotor_cdeg, false);
  step_ = Step::kEnd;
}

template <class Sensor>
frame::Frame* Decoder<Sensor>::next(frame::RangeImage* in_exchange) noexcept {
  frame::Frame* frame = frames_.next(in_exchange);
  while (frame == nullptr && go_on()) frame = frames_.next();
  if (frame == nullptr) return nullptr;
  frame->info.blind = blind();
  if (deskewer_) frame->info.deskew = deskewer_->apply(frames_.oldest(), *frame->image);
  return frame;
}

template <class Sensor>
bool Decoder<Sensor>::go_on() noexcept {
  switch (step_) {
    case Step::kNothing:
      return false;
    case Step::kTakeKept:
      take_kept();
      break;
    case Step::kTakePushed:
      take_pushed();
      break;
    case Step::kRestart:
      restart();
      break;
    case Step::kPlace:
      place();
      break;
    case Step::kEnd:
      end();
      break;
  }
  return true;
}

template <class Sensor>
void Decoder<Sensor>::keep(const Datagram& datagram, const Placement& placed) noexcept {
  KeptPacket& kept = kept_[kept_packets_++];
  std::copy(datagram.payload.begin(), datagram.payload.end(), kept.bytes.begin());
  kept.azimuths = azimuths_;
  kept.stamp_ns = datagram.stamp_ns;
  kept.rotor_cdeg = placed.rotor_cdeg;
  kept.reason = placed.reject;
}

template <class Sensor>
void Decoder<Sensor>::begin_anew(std::int64_t newest_cdeg, bool has_pushed) noexcept {
  anew_.next = 0;
  anew_.has_begun = false;
  anew_.has_pushed = has_pushed;
  anew_.newest_cdeg = newest_cdeg;
  step_ = after_packet_ = Step::kTakeKept;
}

template <class Sensor>
void Decoder<Sensor>::take_kept() noexcept {
  if (anew_.next == kept_packets_) {
    kept_packets_ = 0;
    step_ = anew_.has_pushed ? Step::kTakePushed : Step::kEnd;
    return;
  }
  const KeptPacket& kept = kept_[anew_.next++];
  if (kept.rotor_cdeg < anew_.newest_cdeg - beams::kRevolution_cdeg)
    return count_rejected(kept.reason);
  azimuths_ = kept.azimuths;
  const std::int64_t began_ns = host_began_ns(kept.stamp_ns);
  const Placement placed = std::exchange(anew_.has_begun, true)
                               ? tracker_.go_on(azimuths_, began_ns, frames_.losses())
                               : tracker_.begin(azimuths_, began_ns, frames_.losses());
  if (placed.arrival == Arrival::kRejected) return count_rejected(placed.reject);
  take(kept.bytes, kept.stamp_ns, placed);
}

template <class Sensor>
void Decoder<Sensor>::take_pushed() noexcept {
  rejected_.reset();
  step_ = after_packet_ = Step::kNothing;
  azimuths_ = anew_.pushed_azimuths;
  const Datagram& pushed = anew_.pushed;
  const Placement placed =
      tracker_.go_on(azimuths_, host_began_ns(pushed.stamp_ns), frames_.losses());
  if (placed.arrival == Arrival::kRejected) return reject(placed.reject);
  take(pushed.payload, pushed.stamp_ns, placed);
}

template <class Sensor>
void Decoder<Sensor>::take(std::span<const std::uint8_t> payload, std::int64_t stamp_ns,
                           const Placement& placed) noexcept {
  const BeamSpread spread = sensor_.spread(azimuths_.step_ticks);
  const std::int64_t begin_ticks = placed.rotor_cdeg * kTicksPerCdeg;
  std::int64_t most_ticks = begin_ticks;
  for (int column = 1; column < azimuths_.columns; ++column) {
    most_ticks = std::max(most_ticks, begin_ticks + azimuths_.advance_cdeg(column) * kTicksPerCdeg);
  }
  const std::int64_t last_frame = frame_of(most_ticks + spread.foremost_ticks);
  const int late_columns = columns_too_late(placed, spread, last_frame);
  const std::int64_t first_ticks =
      begin_ticks + azimuths_.advance_cdeg(late_columns) * kTicksPerCdeg;
  std::int64_t least_ticks = first_ticks;
  for (int column = late_columns + 1; column < azimuths_.columns; ++column) {
    least_ticks =
        std::min(least_ticks, begin_ticks + azimuths_.advance_cdeg(column) * kTicksPerCdeg);
  }
  job_ = {.payload = payload,
          .stamp_ns = stamp_ns,
          .placed = placed,
          .spread = spread,
          .swept = {first_ticks, begin_ticks + azimuths_.sweep_ticks},
          .late_columns = late_columns,
          .first_frame = frame_of(least_ticks + spread.hindmost_ticks),
          .last_frame = last_frame,
          .stride = {azimuths_.pace_ticks, azimuths_.widest_ticks},
          .step_ticks = 0};
  if (placed.arrival != Arrival::kRestart) return judge();
  blind_.end();
  count_due();
  tracker_.miss(seen_share(placed.missing), frames_.losses());
  frames_.flush();
  step_ = Step::kRestart;
}

template <class Sensor>
void Decoder<Sensor>::restart() noexcept {
  if (deskewer_) {
    deskewer_->restart();
    clock_.reset();
  }
  frames_.start(job_.first_frame, job_.swept.from_ticks);
  frontier_ticks_ = job_.swept.from_ticks;
  steps_ticks_ = steps_ = 0;
  judge();
}

template <class Sensor>
void Decoder<Sensor>::judge() noexcept {
  step_ = after_packet_;
  const Arrival arrival = job_.placed.arrival;
  const RotorInterval& swept = job_.swept;
  const bool is_next = arrival == Arrival::kNext;
  if (job_.first_frame < frames_.oldest()) {
    if (is_next) {
      tracker_.miss(missing_before(job_.placed, swept), frames_.losses());
      blind_.pass(swept);
    }
    return reject(frame::Reject::kLate);
  }

  job_.step_ticks = mean_step(azimuths_.step_ticks);
  if (is_next) {
    judge_gap(job_.placed, swept, job_.stride, job_.spread, job_.step_ticks);
    if (azimuths_.behind_sector > 0 && job_.late_columns == 0) {
      cross_sector(swept, job_.stride, job_.spread, job_.step_ticks);
    } else {
      blind_.pass(swept);
    }
    frames_.set_blind(blind_.sector());
    count_due();
  }
  if (arrival == Arrival::kReordered) {
    frames_.regain(swept, job_.spread);
    blind_.fill(swept);
  }
  frontier_ticks_ = std::max(frontier_ticks_, swept.to_ticks);
  if (arrival != Arrival::kReordered) has_crossed_ = azimuths_.behind_sector > 0;
  if (deskewer_ && arrival != Arrival::kReordered && !has_crossed_) {
    const HostClock::Sent sent = clock_.sent(azimuths_.device_stamp_us, job_.stamp_ns);
    if (sent.anew) deskewer_->begin_anew(swept.from_ticks);
    deskewer_->note(swept.from_ticks, sent.instant_ns - azimuths_.nominal_period_ns);
  }
  frames_.roll_to(job_.last_frame - 1);
  step_ = Step::kPlace;
}

template <class Sensor>
void Decoder<Sensor>::place() noexcept {
  // The packets still expected begin here, if not a step earlier: azimuths are rounded, and heads
  // frame unevenly.
  const std::int64_t next_ticks = blind_.next_packet(frontier_ticks_);
  frames_.note_packet(job_.stamp_ns, job_.first_frame, job_.last_frame, next_ticks, job_.step_ticks,
                      job_.spread);
  place_packet(job_.payload, job_.placed.rotor_cdeg, job_.late_columns,
               job_.first_frame == job_.last_frame);

  const std::int64_t late_packets = reorder_packets_ > 0 ? reorder_packets_ + 1 : 0;
  completes_behind_ticks_ =
      late_packets * job_.stride.widest_ticks + job_.step_ticks - job_.spread.hindmost_ticks;
  complete_ticks_ = (late_packets > 0 ? frontier_ticks_ : next_ticks) - completes_behind_ticks_;
  frames_.roll_to(frame_of(complete_ticks_));
  step_ = after_packet_;
}

template <class Sensor>
void Decoder<Sensor>::end() noexcept {
  tracker_.end_of_stream(frames_.losses());
  blind_.end();
  count_due();
  frames_.flush();
  step_ = Step::kNothing;
}

template <class Sensor>
void Decoder<Sensor>::judge_gap(const Placement& placed, const RotorInterval& swept,
                                const BlindSector::Stride& stride, const BeamSpread& spread,
                                std::int64_t step_ticks) noexcept {
  const RotorInterval gap{frontier_ticks_, swept.from_ticks};
  const std::int64_t missing = missing_before(placed, swept);
  if (gap.ticks() <= step_ticks * 3 / 4) {
    tracker_.miss(missing, frames_.losses());
    return;
  }
  const BlindSector::Verdict verdict = blind_.judge(gap, missing, placed.explained, stride);
  frames_.set_blind(blind_.sector());
  tracker_.miss(verdict.packets, frames_.losses());
  if (verdict.lost.ticks() > 0) {
    frames_.lose(verdict.lost, spread, step_ticks, !verdict.is_pending);
  }
}

template <class Sensor>
void Decoder<Sensor>::cross_sector(const RotorInterval& swept, const BlindSector::Stride& stride,
                                   const BeamSpread& spread, std::int64_t step_ticks) noexcept {
  const RotorInterval inside = azimuths_.sector_inside(swept.from_ticks);
  const BlindSector::Verdict verdict = blind_.cross(swept.from_ticks, inside, stride);
  frames_.set_blind(blind_.sector());
  if (verdict.lost.ticks() > 0) {
    frames_.lose(verdict.lost, spread, step_ticks, !verdict.is_pending);
  }
}

template <class Sensor>
void Decoder<Sensor>::place_packet(std::span<const std::uint8_t> payload, std::int64_t rotor_cdeg,
                                   int late_columns, bool is_in_one_frame) noexcept {
  sensor_.begin_packet(azimuths_);
  for (int column = 0; column < azimuths_.columns; ++column) {
    sensor_.read_column(payload, azimuths_, column, found_[static_cast<std::size_t>(column)]);
  }
  if (late_columns > 0) leave_out(late_columns);
  const frame::CellOwner owner =
      azimuths_.dual_return ? dual_owner_ : frame::CellOwner::kFirstArrived;
  const bool goes_by_laser = is_in_one_frame && late_columns == 0;
  if (!goes_by_laser || !place_by_laser(rotor_cdeg, owner)) place_by_firing(rotor_cdeg, owner);
  ++packets_;
  columns_ += static_cast<std::uint64_t>(azimuths_.columns - late_columns);
}

template <class Sensor>
void Decoder<Sensor>::leave_out(int late_columns) noexcept {
  frame::LossCounters& losses = frames_.losses();
  for (std::size_t c = 0; c < static_cast<std::size_t>(late_columns); ++c) {
    for (std::uint16_t& raw : found_[c].raw) {
      losses.late_returns += raw != 0 ? 1U : 0U;
      raw = 0;
    }
  }
  // Both returns of a pair are one firing.
  losses.azimuth_hole_columns +=
      azimuths_.dual_return ? 1U : static_cast<std::uint64_t>(late_columns);
}

template <class Sensor>
bool Decoder<Sensor>::place_by_laser(std::int64_t rotor_cdeg, frame::CellOwner owner) noexcept {
  const auto columns = static_cast<std::size_t>(azimuths_.columns);
  std::array<std::uint32_t, PacketAzimuths::kMaxColumns> number{};  // of each column's next return
  std::uint32_t returns = 0;
  for (std::size_t c = 0; c < columns; ++c) {
    number[c] = returns;
    for (const std::uint16_t raw : found_[c].raw) returns += raw != 0 ? 1U : 0U;
  }
  frame::RangeImage& image = frames_.image(frame_of_beam(rotor_cdeg, 0, 0));
  const std::optional<std::uint32_t> first = image.take_numbers(returns);
  if (!first) return false;
  for (std::uint32_t& next : number) next += *first;

  const std::span<const std::int32_t, kLasers> rows = sensor_.rows();
  for (std::size_t i = 0; i < kLasers; ++i) {
    // Which columns a laser found something in is as good as random, so no branch is asked to guess
    // it.
    std::array<std::uint8_t, PacketAzimuths::kMaxColumns> hits;
    std::size_t hit_count = 0;
    for (std::size_t c = 0; c < columns; ++c) {
      hits[hit_count] = static_cast<std::uint8_t>(c);
      hit_count += found_[c].raw[i] != 0 ? 1 : 0;
    }
    for (std::size_t n = 0; n < hit_count; ++n) {
      const std::size_t c = hits[n];
      image.place_numbered(rows[i], found_[c].column[i], point(c, i), owner, number[c]++);
    }
  }
  return true;
}

template <class Sensor>
void Decoder<Sensor>::place_by_firing(std::int64_t rotor_cdeg, frame::CellOwner owner) noexcept {
  const std::span<const std::int32_t, kLasers> rows = sensor_.rows();
  for (std::size_t c = 0; c < static_cast<std::size_t>(azimuths_.columns); ++c) {
    for (std::size_t i = 0; i < kLasers; ++i) {
      if (found_[c].raw[i] == 0) continue;
      frames_.place(frame_of_beam(rotor_cdeg, c, i), rows[i], found_[c].column[i], point(c, i),
                    owner);
    }
  }
}

}  // namespace terracut::decode
