// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "firmware_io/can/can_frame.hpp"
#include "firmware_io/vehicle/dbc_file.hpp"
#include "firmware_io/vehicle/motion_sample.hpp"
#include "firmware_io/vehicle/signal_plan.hpp"
#include "rt/error.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::vehicle {

/// How to compute one figure of the vehicle's motion from signals of a DBC file.
///
///     figure = mean(signals) * unit * scale, negated when `sign` is not 0; valid when `valid` is
struct MotionFigure {
  std::vector<std::string> signals;  ///< "MESSAGE.SIGNAL" or "SIGNAL"; several are averaged.
  std::string unit;                  ///< Unit used instead of the file's; empty: the file's.
  double scale = 1;                  ///< An extra factor; -1 inverts the sign. Finite, not 0.
  std::string sign;        ///< Name of a signal; if not 0, the figure is negative. Empty: none.
  std::string valid;       ///< Signal that tells whether the figure is valid; empty: always.
  double valid_value = 1;  ///< The value of that signal if valid.
};

struct MotionSignalsConfig {
  MotionFigure speed;     ///< "m/s", "km/h", "mph"
  MotionFigure yaw_rate;  ///< "rad/s", "deg/s"; positive must be to the left
  /// Largest age of the signals in a sample, [1e-3, 10] s.
  double max_age_s = 0.1;
  /// The vehicle's motion is unknown after so long without a sample, [max_age_s, 60] s.
  double timeout_s = 0.5;
};

/// Counts the data frames with one of the signals. samples + yaw_rate_invalid + speed_invalid +
/// stale == frames with a new yaw rate.
struct MotionCounters {
  std::uint64_t frames = 0;        ///< Frames with at least one of the signals.
  std::uint64_t too_short = 0;     ///< Signals beyond the end of their frame.
  std::uint64_t out_of_order = 0;  ///< Frames stamped before an earlier frame; left out.
  /// Frames stamped more than kMotionDisorder_ns earlier: the clock was set back, and all was
  /// reset.
  std::uint64_t clock_set_back = 0;
  std::uint64_t samples = 0;           ///< Samples made.
  std::uint64_t yaw_rate_invalid = 0;  ///< Yaw rates denied by the validity signal, or NaN.
  std::uint64_t speed_invalid = 0;     ///< Speeds denied by the validity signal, or NaN.
  /// Yaw rates left out because a signal was older than max_age_s, or never came.
  std::uint64_t stale = 0;
  std::uint64_t timeouts = 0;  ///< Times the motion was lost for longer than timeout_s.
};

/// A signal and its last value.
struct TrackedSignal {
  SignalPlan plan;
  double value = 0;
  std::int64_t stamp_ns = 0;
  bool heard = false;
};

/// Reads the vehicle's motion from CAN frames: makes a MotionSample of each new yaw rate with the
/// newest speed. The speed may be older, as it changes little between two frames: 0.1 m/s in 10 ms
/// of hard braking, which moves a frame's points by less than a centimetre. A wrong yaw rate moves
/// far points much more.
///
/// Fixed size after make(); one thread.
class MotionSignals {
 public:
  /// The most signals that one figure may average.
  static constexpr std::size_t kMostSignals = 8;

  /// Makes the reader. Fails with kInvalidArgument if a signal is missing or ambiguous, a unit is
  /// unknown and not given, or a setting is out of its range; otherwise as SignalPlan::make() does.
  [[nodiscard]] static Expected<MotionSignals> make(const DbcFile& file,
                                                    const MotionSignalsConfig& config);

  /// Returns the messages of the signals, each once, for the socket's filter.
  [[nodiscard]] std::span<const can::CanId> ids() const noexcept { return ids_; }

  /// Takes a frame and returns a sample if it completes one. Frames of other messages, remote
  /// frames and error frames change nothing.
  [[nodiscard]] std::optional<MotionSample> take(const can::CanFrame& frame) noexcept
      TERRACUT_NONBLOCKING;

  /// True if the vehicle's motion is known at `now_ns` (time of the frames' stamps): the newest
  /// sample is not older than the timeout. Call it regularly: a timeout is counted once, by this
  /// call or when the next sample comes.
  [[nodiscard]] bool alive(std::int64_t now_ns) noexcept TERRACUT_NONBLOCKING;

  [[nodiscard]] const MotionCounters& counters() const noexcept { return counters_; }

 private:
  struct Figure {
    std::array<TrackedSignal, kMostSignals> signals{};
    std::array<double, kMostSignals> units{};  ///< SI units per unit, by signal.
    std::size_t count = 0;
    double scale = 1;
    std::optional<TrackedSignal> sign, valid;
    double valid_value = 1;
  };
  enum class Judgement : std::uint8_t { kGood, kInvalid, kStale };

  MotionSignals() = default;
  [[nodiscard]] static Expected<Figure> make_figure(
      const DbcFile& file, const MotionFigure& config, std::string_view name,
      Expected<double> (*unit_factor)(std::string_view));
  void add_ids(const Figure& figure);
  /// Updates a figure from a frame. True if the frame had one of the signals that it averages.
  bool update(Figure& figure, const can::CanFrame& frame) noexcept;
  bool update(TrackedSignal& signal, const can::CanFrame& frame) noexcept;
  void note_sample(std::int64_t stamp_ns) noexcept;
  void reset() noexcept;
  [[nodiscard]] bool fresh(const TrackedSignal& signal, std::int64_t now_ns) const noexcept;
  [[nodiscard]] Judgement judge(const Figure& figure, std::int64_t now_ns,
                                double& value) const noexcept;

  Figure speed_, yaw_rate_;
  std::int64_t max_age_ns_ = 0, timeout_ns_ = 0;
  std::vector<can::CanId> ids_;
  std::optional<std::int64_t> newest_frame_ns_;
  std::optional<std::int64_t> newest_sample_ns_;
  bool lost_ = false;  ///< True once the current silence was counted as a timeout.
  MotionCounters counters_;
};

}  // namespace terracut::vehicle
