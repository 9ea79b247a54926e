// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pipeline/status/frame_record.hpp"
#include "tests/simulation/fault.hpp"
#include "tests/simulation/live_chain.hpp"
#include "tests/simulation/machine.hpp"
#include "tests/simulation/network.hpp"
#include "tests/simulation/sensor_loop.hpp"

namespace terracut::simulation {

/// A number for labels, by which they are compared.
[[nodiscard]] std::uint64_t hash_of(std::span<const frame::Label> labels) noexcept;
/// Returns the number for the labels of each turn of a loop that is labelled without haste.
[[nodiscard]] std::vector<std::uint64_t> labels_without_haste(
    const SensorLoop& loop, const BlindPlaces& blind, const ground::TurnMethodMaker& method);

/// Looks whether what must hold of a live run holds, while it is simulated: after each round of the
/// thread with a deadline, and in the threads that take what it hands over. Keeps the first
/// sentence about what does not.
class Watch {
 public:
  /// Returns for how many turns after a fault's end a run need not be as good as ever. Where a
  /// limited view begins and ends is learnt in eight turns (firmware_io/decode/blind_sector.hpp).
  [[nodiscard]] static std::int64_t turns_to_recover(const BlindPlaces& blind) noexcept {
    return blind.count > 0 ? 10 : 3;
  }

  /// All arguments must outlive this object.
  Watch(const SensorLoop& loop, const BlindPlaces& blind, const Faults& faults,
        std::span<const std::uint64_t> expected, Machine& machine, Network& network,
        LiveChain& chain);

  /// `allocations`: of the round.
  void look_after_round(std::uint64_t allocations);
  /// The work of the threads beside: judging frames; taking labels; taking points and sectors;
  /// telling the vehicle's motion.
  void judge_frames();
  void take_labels();
  void take_points();
  void tell_motion();
  /// To be called when the faults are over and turns_to_recover() have passed, and at the end.
  void begin_of_quiet();
  void look_at_end();

  [[nodiscard]] const std::optional<std::string>& broken() const noexcept { return broken_; }
  /// A number that differs if anything was otherwise in the run.
  [[nodiscard]] std::uint64_t digest() const noexcept { return digest_; }
  [[nodiscard]] std::uint64_t frames() const noexcept { return frames_judged_; }
  [[nodiscard]] std::uint64_t frames_compared() const noexcept { return compared_; }

  /// Returns when the last effect of a fault on frames is over.
  [[nodiscard]] static std::int64_t end_ns(const Fault& fault, const Faults& faults,
                                           const SensorLoop& loop) noexcept;

 private:
  struct Counts {
    net::DatagramAccount account;
    std::uint64_t unused_labels = 0, unused_points = 0, unused_sectors = 0, dropped_records = 0;
  };

  void require(bool holds, const char* what);
  void note(std::uint64_t value) noexcept;
  [[nodiscard]] Counts counts();
  [[nodiscard]] bool has(FaultKind kind) const noexcept;
  /// True if no fault of another kind befalls frames.
  [[nodiscard]] bool has_only(std::initializer_list<FaultKind> kinds) const noexcept;
  /// Returns for how long the core was away after a frame's last packet.
  [[nodiscard]] std::int64_t stolen_since(const frame::FrameInfo& info) const noexcept;
  /// True if packets were lost in three successive turns, which may be taken for a blind sector.
  [[nodiscard]] bool may_seem_blind() const noexcept;
  /// Compares what the run tells of its input with what befell it.
  void look_at_truth(const net::DatagramAccount& account);
  /// True if no fault befell the frame or the three turns before it, or the one after it.
  [[nodiscard]] bool must_be_perfect(const frame::FrameInfo& info) const;
  void look_at_record(const status::FrameRecord& record);

  const SensorLoop& loop_;
  BlindPlaces blind_;
  const Faults& faults_;
  std::span<const std::uint64_t> expected_;
  Machine& machine_;
  Network& network_;
  LiveChain& chain_;
  std::size_t memory_bytes_;
  bool stamps_are_comparable_;  ///< The host's clock is not set in this run.

  std::optional<std::string> broken_;
  std::uint64_t digest_ = 0xCBF29CE484222325;
  std::uint64_t frames_judged_ = 0, compared_ = 0, perfect_ = 0, labels_taken_ = 0;
  std::optional<std::uint32_t> judged_, labelled_;  ///< Numbers of the newest frames.
  struct OfFrame {
    std::uint32_t frame = 0;
    std::uint32_t next_return = 0;
    std::uint64_t unused = 0;
    std::int64_t longest_ns = 0;
  };
  OfFrame sectors_;  ///< Of the frame whose sectors come.
  Counts quiet_;
  std::int64_t quiet_began_ns_ = 0;
  std::uint64_t perfect_before_quiet_ = 0;
};

}  // namespace terracut::simulation
