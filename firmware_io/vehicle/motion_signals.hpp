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

/// Which signals of a DBC file make up one figure of the vehicle's motion, and how.
///
///     figure = mean(signals) * unit * scale, negated when `sign` is not 0; valid when `valid` is
struct MotionFigure {
  std::vector<std::string> signals;  ///< "MESSAGE.SIGNAL" or "SIGNAL"; of several, the mean.
  std::string unit;                  ///< Instead of the file's; empty: the file's.
  double scale = 1;                  ///< On top; -1 turns the sign round. Not 0, finite.
  std::string sign;                  ///< Signal: negative when not 0. Empty: there is none.
  std::string valid;                 ///< Signal that says whether it is valid; empty: always.
  double valid_value = 1;            ///< What that signal has to be.
};

struct MotionSignalsConfig {
  MotionFigure speed;     ///< "m/s", "km/h", "mph"
  MotionFigure yaw_rate;  ///< "rad/s", "deg/s"; positive has to be to the left
  /// A sample is made only of signals none of which is older, [1e-3, 10] s.
  double max_age_s = 0.1;
  /// Without a sample for longer, the vehicle's motion is not known any more, [max_age_s, 60] s.
  double timeout_s = 0.5;
};

/// What became of the data frames that had one of the signals in them.
/// samples + yaw_rate_invalid + speed_invalid + stale == frames with a new yaw rate.
struct MotionCounters {
  std::uint64_t frames = 0;        ///< With one or more of the signals.
  std::uint64_t too_short = 0;     ///< Signals that their frame had no room for.
  std::uint64_t out_of_order = 0;  ///< Stamped before one that came earlier; left out.
  /// By more than kMotionDisorder_ns, so that the clock was set; all was reset.
  std::uint64_t clock_set_back = 0;
  std::uint64_t samples = 0;           ///< Made.
  std::uint64_t yaw_rate_invalid = 0;  ///< The validity signal said no, or it was no number.
  std::uint64_t speed_invalid = 0;     ///< The same of the speed.
  std::uint64_t stale = 0;             ///< A signal was older than max_age_s, or never came.
  std::uint64_t timeouts = 0;          ///< Times the motion was lost for longer than timeout_s.
};

/// A signal and what it was last.
struct TrackedSignal {
  SignalPlan plan;
  double value = 0;
  std::int64_t stamp_ns = 0;
  bool heard = false;
};

/// Reads the vehicle's motion from CAN frames: a MotionSample each time a new yaw rate came, with
/// the newest speed. (Speed changes little between two frames: braking hard, 0.1 m/s in 10 ms,
/// which moves a frame's points by less than a centimetre. Yaw rate turns them about a hundred
/// metres.)
///
/// Fixed size after make(); one thread.
class MotionSignals {
 public:
  /// Signals one figure may be the mean of.
  static constexpr std::size_t kMostSignals = 8;

  /// kInvalidArgument: a signal that is not in the file or not known by that name alone, a unit
  /// that is not known and not given, a setting out of its range. Else as SignalPlan::make().
  [[nodiscard]] static Expected<MotionSignals> make(const DbcFile& file,
                                                    const MotionSignalsConfig& config);

  /// The messages the signals are in, each once: what a socket has to let pass.
  [[nodiscard]] std::span<const can::CanId> ids() const noexcept { return ids_; }

  /// Takes a frame; returns a sample if it completes one. Frames of other messages, remote frames
  /// and error frames change nothing.
  [[nodiscard]] std::optional<MotionSample> take(const can::CanFrame& frame) noexcept
      TERRACUT_NONBLOCKING;

  /// Whether the vehicle's motion is known at `now_ns` (time of the frames' stamps): the newest
  /// sample is not older than the timeout. To be asked now and then: a timeout is counted once,
  /// when it is seen here, or when the next sample comes.
  [[nodiscard]] bool alive(std::int64_t now_ns) noexcept TERRACUT_NONBLOCKING;

  [[nodiscard]] const MotionCounters& counters() const noexcept { return counters_; }

 private:
  struct Figure {
    std::array<TrackedSignal, kMostSignals> signals{};
    std::array<double, kMostSignals> units{};  ///< Of each signal, in SI.
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
  /// True when the frame had one of the signals that the figure is the mean of.
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
  bool lost_ = false;  ///< The current silence was counted as a timeout.
  MotionCounters counters_;
};

}  // namespace terracut::vehicle
