// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <random>
#include <string>

#include "input.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "tests/support/hand_out.hpp"
#include "tests/support/reference/agreement.hpp"
#include "tests/support/reference/sensors.hpp"

namespace terracut::fuzz {

/// The product's decoder beside the reference, on stretches of packets that the input makes: a
/// rotating head's, with any returns, or bent ones. Both must refuse the same packets for the same
/// reason and agree on the frame, the cell and the place of every return of the others.
template <class Sensor>
class Differential {
 public:
  explicit Differential(Input& input)
      : input_(input),
        random_(input.next(1)),
        calibration_(Sensor::random_unit(random_)),
        mount_(reference::random_mount(random_)),
        reference_(calibration_),
        config_(config(input)),
        decoder_(calibration_, mount_, config_, memory_),
        packet_(empty_packet()) {}

  void run() {
    while (!input_.empty()) {
      switch (input_.below(8)) {
        case 0:
          step_cdeg_ = input_.below(101);
          break;
        case 1:
          jitter_cdeg_ = input_.below(6);
          break;
        case 2:
          azimuth_cdeg_ = input_.below(36'000);
          break;
        case 3:
          dual_return_ = !dual_return_;
          late_ = input_.below(2);
          packet_ = empty_packet();
          break;
        case 4:
          set_returns();
          break;
        case 5:
          bent_packet();
          break;
        case 6: {
          const auto size = static_cast<std::size_t>(input_.below(1'300));
          const auto any = input_.take(size);
          stretch([&] { feed({any.begin(), any.end()}); });
          break;
        }
        default:
          rotating_head(1 + input_.below(kMostPackets));
          break;
      }
    }
  }

 private:
  static constexpr int kMostPackets = 64;  // of a stretch

  static typename Sensor::Decoder::Config config(Input& input) {
    typename Sensor::Decoder::Config config;
    config.columns = 64 + input.below(64);
    // Room for the longest stretch of a head that hardly moves.
    config.returns_per_cell = 1 + kMostPackets * Sensor::kColumns / config.columns;
    return config;
  }

  [[nodiscard]] reference::PayloadBytes empty_packet() const {
    return Sensor::payloads({.dual_return = dual_return_, .packets = 1, .share_of_returns = 0})[0]
        .bytes;
  }

  void set_returns() {
    const auto returns = input_.next(1) % 16;
    for (unsigned n = 0; n < returns; ++n) {
      const auto columns = static_cast<unsigned>(Sensor::columns(dual_return_));
      const int column = input_.below(columns), laser = input_.below(Sensor::kLasers);
      const unsigned raw = input_.next(2);
      Sensor::set_return(packet_, column, laser, raw, input_.next(1));
    }
  }

  /// The next columns of the head into the packet.
  void keep_rotating() {
    const int pairing = dual_return_ ? 2 : 1;
    const int in_block = Sensor::columns_a_block();
    for (int column = 0; column < Sensor::columns(dual_return_); column += in_block) {
      if ((reading_++ + late_) % pairing == 0) {
        azimuth_cdeg_ += step_cdeg_ * in_block;
        if (jitter_cdeg_ > 0) azimuth_cdeg_ += input_.below(static_cast<unsigned>(jitter_cdeg_));
        azimuth_cdeg_ %= 36'000;
      }
      Sensor::set_azimuth(packet_, column, static_cast<unsigned>(azimuth_cdeg_));
    }
  }

  void rotating_head(int packets) {
    // A packet of one firing shows no step, so that the first ones have the one of the stretch
    // before; far from the seam no frame ends too early by it.
    const bool shows_no_step = Sensor::firings_per_packet(dual_return_) == 1;
    if (shows_no_step && (azimuth_cdeg_ + 3'000) % 36'000 < 6'000) azimuth_cdeg_ = 9'000;
    stretch([&] {
      for (int n = 0; n < packets; ++n) {
        keep_rotating();
        feed(packet_);
      }
    });
  }

  void bent_packet() {
    keep_rotating();
    reference::PayloadBytes bent = packet_;
    for (int n = input_.below(8); n > 0; --n) {
      // Mostly where a block begins.
      const int block = input_.below(2 * Sensor::kBlocks);
      const int at = block < Sensor::kBlocks
                         ? Sensor::kFirstBlock + block * Sensor::kBlockBytes + input_.below(4)
                         : input_.below(static_cast<unsigned>(bent.size()));
      bent[static_cast<std::size_t>(at)] = static_cast<std::uint8_t>(input_.next(1));
    }
    stretch([&] { feed(bent); });
  }

  /// What belongs together: nothing before or after it does.
  template <class Packets>
  void stretch(Packets&& packets) {
    constexpr std::int64_t kPause_ns = 50'000'000;
    stamp_ns_ += kPause_ns;
    reading_ = 0;
    Sensor::reset(reference_);
    frames_ = {};
    expected_ =
        reference::ExpectedFrames(Sensor::elevations(calibration_), mount_, config_.columns);
    handed_ = {};
    packets();
    test::end_stream(decoder_, handed_.keep());
    const std::string difference = reference::first_difference(expected_, handed_, config_.columns);
    require(difference.empty(), difference);
  }

  void feed(reference::PayloadBytes payload) {
    // The clock is not what is compared here, and what belongs together depends on it.
    const bool whole = payload.size() == packet_.size();
    if (whole) Sensor::set_clock(payload, stamp_ns_);
    typename Sensor::Reference looks_ahead = reference_;
    erase_returns_on_the_seam<Sensor>(payload, looks_ahead.decode(payload));

    const reference::Packet packet = reference_.decode(payload);
    const auto reason = test::decode(
        decoder_, packet::Datagram{.payload = payload, .stamp_ns = stamp_ns_}, handed_.keep());
    require(reason.has_value() == (packet.refusal != reference::Refusal::kNone) &&
                reference::as_refusal(reason) == packet.refusal,
            std::string("reference: ") + std::string(to_string(packet.refusal)) +
                ", decoder: " + std::string(reason ? to_string(*reason) : "none"));
    if (!reason) expected_.add(packet, frames_.unwrap(packet));
    // Azimuths may look like those of the other mode.
    const bool dual_return = reason ? dual_return_ : packet.dual_return;
    const double packet_us =
        Sensor::firing_us(dual_return) * Sensor::firings_per_packet(dual_return);
    stamp_ns_ += static_cast<std::int64_t>(packet_us * 1e3);
  }

  Input& input_;
  std::mt19937 random_;
  typename Sensor::Calibration calibration_;
  mount::Mount mount_;
  typename Sensor::Reference reference_;
  typename Sensor::Decoder::Config config_;
  memory::FixedMemory memory_;
  typename Sensor::Decoder decoder_;
  bool dual_return_ = false;
  reference::PayloadBytes packet_;

  int step_cdeg_ = 18, jitter_cdeg_ = 0, azimuth_cdeg_ = 0, late_ = 0, reading_ = 0;
  std::int64_t stamp_ns_ = 1'767'225'600'000'000'000;
  reference::Frames frames_;
  reference::ExpectedFrames expected_{{}, {}, 1};
  reference::HandedFrames handed_;
};

}  // namespace terracut::fuzz
