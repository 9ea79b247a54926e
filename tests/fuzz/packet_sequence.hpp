// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "calib/beams/angle.hpp"
#include "input.hpp"
#include "live_chain_run.hpp"

namespace terracut::fuzz {

/// A head that rotates, as it is at one time. What the input bends of it stays so.
struct Head {
  std::int64_t azimuth_cdeg = 0;  ///< Of the next firing, unwrapped.
  std::int64_t device_ns = 0;     ///< What the device's clock shows at it.
  std::int64_t step_cdeg = 60;    ///< From firing to firing.
  std::int64_t jitter_cdeg = 0;
  std::int64_t blind_from_cdeg = 0, blind_cdeg = 0;  ///< No packets are sent from this sector.
  bool fills_packets = false;  ///< One that is not full yet goes on behind that sector.
  bool dual = false;
  std::int64_t readings = 0;  ///< Columns so far; in dual return a firing has two.
  std::uint32_t pattern = 1;  ///< What the lasers see.
  int encoding = 1;           ///< Of stamps, or of packets, where the sensor has several.

  [[nodiscard]] bool is_blind() const {
    return blind_cdeg > 0 &&
           beams::wrap_cdeg(azimuth_cdeg - blind_from_cdeg) < static_cast<std::int32_t>(blind_cdeg);
  }
  /// Rotates the head to the end of its blind sector.
  void leave_sector(std::int64_t firing_ns) {
    for (; is_blind() && step_cdeg > 0; device_ns += firing_ns) azimuth_cdeg += step_cdeg;
  }
};

/// The returns of one azimuth, for a Sensor below whose own encoder has no such type.
template <std::size_t kLasers>
struct MadeColumn {
  struct Beam {
    std::uint16_t raw;
    std::uint8_t intensity;
  };
  std::array<Beam, kLasers> by_laser;
  std::int64_t stamp_ns, unwrapped_azimuth_cdeg;
};

/// Streams of valid packets, made by the sensor's own encoder and bent by a fuzzer's input: stamps,
/// azimuths, order, loss, repetition, a second sender, return mode, spin rate, field of view,
/// restarts, steps of the host's clock, motion, packets of another kind, and a segmenter that is
/// late.
///
/// `Sensor` has Decoder, Calibration, Column, Bytes; kColumns (of a packet), kReturnsAColumn;
/// calibration(), firing_ns(dual), encode(columns, first reading, dual, encoding),
/// returns_in(payload).
template <class Sensor>
class PacketSequence {
 public:
  explicit PacketSequence(Input& input)
      : input_(input), run_(Sensor::calibration(), Sensor::returns_in, config(input)) {}

  void run() {
    while (!input_.empty() && sent_ < kMostPackets) bend();
    deliver_held(static_cast<int>(held_.size()));
    run_.flush();
  }

 private:
  using Bytes = typename Sensor::Bytes;
  using Run = LiveChainRun<typename Sensor::Decoder, typename Sensor::Calibration>;
  static constexpr int kMostPackets = 600;
  static constexpr std::int64_t kStart_ns = 1'767'225'600'000'000'000;

  static typename Run::Config config(Input& input) {
    const unsigned bits = input.next(1);
    return {.columns = (bits & 1) == 0 ? 64 : 720,  // 720: turns follow each other without a seam
            .reorder_packets = static_cast<int>(bits >> 1 & 3),
            .deskew = (bits >> 3 & 1) != 0};
  }

  void bend() {
    Head& head = azimuths_[sender_];
    switch (input_.next(1) % 21) {
      case 0:
        send(1);
        break;
      case 1:
      case 2:  // a stretch
        send(1 + input_.below(256));
        break;
      case 3:  // the device's clock is set, by microseconds to hours
        head.device_ns += signed_ns();
        break;
      case 4:  // a small one, before each of some packets
        for (int n = input_.below(64), us = input_.below(256); n > 0; --n) {
          head.device_ns += us * 1'000 - period_ns(head);
          send(1);
        }
        break;
      case 5:  // the head is elsewhere
        head.azimuth_cdeg = head.azimuth_cdeg / beams::kRevolution_cdeg * beams::kRevolution_cdeg +
                            input_.below(beams::kRevolution_cdeg);
        break;
      case 6:  // packets are lost
        for (int n = input_.below(256); n > 0; --n) (void)make(head);
        break;
      case 7:  // an outage, with or without the head's rotation
        time_ns_ += std::int64_t{input_.below(256)} * 10'000'000;
        if (input_.below(2) == 0) head.device_ns += time_ns_ - newest_ns_;
        break;
      case 8:  // packets come again
        for (int n = 1 + input_.below(8); n > 0 && !sent_last_.empty(); --n) {
          deliver(sent_last_[static_cast<std::size_t>(input_.below(16)) % sent_last_.size()]);
        }
        break;
      case 9:  // the next packet is overtaken by some
        held_.push_back(make(head));
        held_for_ = input_.below(24);
        break;
      case 10:
        head.step_cdeg = input_.below(104);
        break;
      case 11:
        head.jitter_cdeg = input_.below(7);
        break;
      case 12:
        head.dual = !head.dual;
        head.readings += input_.below(2);
        break;
      case 13:  // a field of view
        head.blind_from_cdeg = std::int64_t{input_.below(360)} * 100;
        head.blind_cdeg = std::int64_t{input_.below(720)} * 100;
        head.fills_packets = head.blind_cdeg >= beams::kRevolution_cdeg;
        head.blind_cdeg %= beams::kRevolution_cdeg;
        break;
      case 14:  // it reboots: clock and azimuth from anywhere
        head.device_ns = input_.below(2) == 0 ? 0 : head.device_ns / 3'600'000'000'000 * 1'000;
        head.azimuth_cdeg = input_.below(beams::kRevolution_cdeg);
        time_ns_ += std::int64_t{input_.below(16)} * 100'000'000;
        break;
      case 15:  // the host's clock is set
        host_ns_ = std::clamp(host_ns_ + signed_ns(), -kStart_ns / 2, kStart_ns / 2);
        break;
      case 16:  // another sender, or both in turn
        sender_ = static_cast<std::size_t>(input_.below(2));
        in_frame_ = input_.below(2) != 0;
        break;
      case 17:
        head.pattern = input_.next(2);
        break;
      case 18:
        run_.wait_no_longer();
        break;
      case 19:  // any payload, or some bytes of a good one changed
        foreign();
        break;
      default:
        other();
        break;
    }
  }

  void other() {
    switch (input_.below(4)) {
      case 0:
        run_.flush();
        break;
      case 1:
        azimuths_[sender_].encoding = input_.below(3);
        break;
      case 2:  // near the end of the device's hour
        azimuths_[sender_].device_ns += 3'600'000'000'000 -
                                        azimuths_[sender_].device_ns % 3'600'000'000'000 -
                                        std::int64_t{input_.below(64)} * 300'000;
        break;
      default:
        speed_mps_ = input_.below(80) - 20;
        yaw_rate_radps_ = (input_.below(256) - 128) * 0.01;
        moves_ = input_.below(4) != 0;
        break;
    }
  }

  /// From a microsecond to two months, either way.
  std::int64_t signed_ns() {
    const auto value = static_cast<std::int16_t>(input_.next(2));
    static constexpr std::array<std::int64_t, 4> kUnits{1'000, 100'000, 10'000'000,
                                                        156'250'000'000};
    return value * kUnits[static_cast<std::size_t>(input_.below(4))];
  }

  static std::int64_t period_ns(const Head& head) {
    return Sensor::kColumns * Sensor::firing_ns(head.dual) / (head.dual ? 2 : 1);
  }

  /// The next packet of a head, which rotates on, and its time passes.
  Bytes make(Head& head) {
    std::array<typename Sensor::Column, Sensor::kColumns> columns{};
    head.device_ns = std::clamp<std::int64_t>(head.device_ns, 0, 2 * kStart_ns);
    const std::int64_t first_reading = head.readings, begin_ns = head.device_ns;
    for (auto& column : columns) {
      if (head.fills_packets) head.leave_sector(Sensor::firing_ns(head.dual));
      column.stamp_ns = head.device_ns;
      column.unwrapped_azimuth_cdeg = head.azimuth_cdeg;
      for (std::size_t n = 0; n < Sensor::kReturnsAColumn; ++n) {
        head.pattern = head.pattern * 1'664'525U + 1'013'904'223U;
        auto& beam = column.by_laser[(head.pattern >> 8) % column.by_laser.size()];
        beam.raw = static_cast<std::uint16_t>(head.pattern >> 16);
        beam.intensity = static_cast<std::uint8_t>(head.pattern >> 3);
      }
      if (++head.readings % (head.dual ? 2 : 1) != 0) continue;
      head.azimuth_cdeg += head.step_cdeg;
      if (head.jitter_cdeg > 0) {
        head.azimuth_cdeg +=
            static_cast<std::int64_t>(head.pattern >> 20) % head.jitter_cdeg - head.jitter_cdeg / 2;
      }
      head.device_ns += Sensor::firing_ns(head.dual);
    }
    time_ns_ += head.device_ns - begin_ns;
    return Sensor::encode(columns, first_reading, head.dual, head.encoding);
  }

  void send(int packets) {
    for (; packets > 0 && sent_ < kMostPackets; --packets) {
      if (in_frame_) sender_ = 1 - sender_;
      const bool blind = azimuths_[sender_].is_blind() && !azimuths_[sender_].fills_packets;
      const Bytes packet = make(azimuths_[sender_]);
      if (blind) {
        ++sent_;  // nothing was, but it took its time
        continue;
      }
      if (sent_last_.size() == 16) sent_last_.erase(sent_last_.begin());
      sent_last_.push_back(packet);
      deliver(packet);
      if (!held_.empty() && --held_for_ < 0) deliver_held(1);
    }
  }

  void deliver_held(int count) {
    for (; count > 0 && !held_.empty(); --count) {
      deliver(held_.front());
      held_.erase(held_.begin());
    }
  }

  void deliver(const Bytes& packet) {
    ++sent_;
    if (moves_ && time_ns_ - moved_ns_ > 10'000'000) {
      moved_ns_ = time_ns_;
      run_.move(
          {kStart_ns + host_ns_ + time_ns_, static_cast<double>(speed_mps_), yaw_rate_radps_});
    }
    newest_ns_ = time_ns_;
    run_.feed(packet, kStart_ns + host_ns_ + time_ns_);
  }

  void foreign() {
    if (sent_last_.empty()) return;
    Bytes packet = sent_last_.back();
    if (input_.below(2) == 0) {
      const auto bytes = input_.take(static_cast<std::size_t>(input_.below(1'300)));
      ++sent_;
      run_.feed(bytes, kStart_ns + host_ns_ + time_ns_);
      return;
    }
    for (int n = 1 + input_.below(8); n > 0; --n) {
      packet[static_cast<std::size_t>(input_.below(static_cast<std::uint32_t>(packet.size())))] =
          static_cast<std::uint8_t>(input_.next(1));
    }
    deliver(packet);
  }

  Input& input_;
  Run run_;
  std::array<Head, 2> azimuths_{Head{.device_ns = kStart_ns},
                                Head{.azimuth_cdeg = 12'000, .device_ns = kStart_ns + 777'000'000}};
  std::size_t sender_ = 0;
  bool in_frame_ = false;
  std::vector<Bytes> sent_last_, held_;
  int held_for_ = 0, sent_ = 0;
  std::int64_t time_ns_ = 0, newest_ns_ = 0, moved_ns_ = 0, host_ns_ = 0;
  bool moves_ = true;
  int speed_mps_ = 20;
  double yaw_rate_radps_ = 0.5;
};

}  // namespace terracut::fuzz
