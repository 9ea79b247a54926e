// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/vehicle/motion_signals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string_view>

#include "firmware_io/vehicle/motion_units.hpp"

namespace terracut::vehicle {
namespace {

constexpr double kSecond_ns = 1e9;
constexpr double kLeastAge_s = 1e-3, kMostAge_s = 10, kMostTimeout_s = 60;

Status check(const MotionSignalsConfig& config) {
  // The range check also refuses NaN.
  const auto out_of = [](const char* name, double value_s, double least_s, double most_s) {
    return fail(ErrorCode::kInvalidArgument, fmt::format("{} {} s: expected a time from {} to {} s",
                                                         name, value_s, least_s, most_s));
  };
  if (!(config.max_age_s >= kLeastAge_s && config.max_age_s <= kMostAge_s)) {
    return out_of("max_age", config.max_age_s, kLeastAge_s, kMostAge_s);
  }
  if (!(config.timeout_s >= config.max_age_s && config.timeout_s <= kMostTimeout_s)) {
    return out_of("timeout", config.timeout_s, config.max_age_s, kMostTimeout_s);
  }
  return {};
}

}  // namespace

Expected<MotionSignals::Figure> MotionSignals::make_figure(
    const DbcFile& file, const MotionFigure& config, std::string_view name,
    Expected<double> (*unit_factor)(std::string_view)) {
  const auto refuse = [&](const std::string& what) {
    return fail(ErrorCode::kInvalidArgument, fmt::format("{}: {}", name, what));
  };
  const auto in_context = [&](const Error& error) {
    return tl::unexpected(Error{error.code, fmt::format("{}: {}", name, error.message)});
  };
  if (config.signals.empty() || config.signals.size() > kMostSignals) {
    return refuse(
        fmt::format("{} signals named; expected 1 to {}", config.signals.size(), kMostSignals));
  }
  if (!std::isfinite(config.scale) || config.scale == 0) {
    return refuse(fmt::format("scale {}: expected a number other than 0", config.scale));
  }
  Figure figure;
  figure.scale = config.scale;
  figure.valid_value = config.valid_value;
  for (const std::string& signal : config.signals) {
    const auto plan = SignalPlan::make(file, signal);
    if (!plan) return in_context(plan.error());
    const std::string& own = find_signal(file, signal)->signal->unit;
    const auto factor = unit_factor(config.unit.empty() ? own : config.unit);
    if (!factor) {
      return refuse(config.unit.empty()
                        ? fmt::format("signal {} {}; or say it in the configuration", signal,
                                      factor.error().message)
                        : fmt::format("the configuration {}", factor.error().message));
    }
    figure.signals[figure.count].plan = *plan;
    figure.units[figure.count] = *factor;
    ++figure.count;
  }
  const auto track = [&](const std::string& signal,
                         std::optional<TrackedSignal>& tracked) -> Status {
    if (signal.empty()) return {};
    const auto plan = SignalPlan::make(file, signal);
    if (!plan) return in_context(plan.error());
    tracked.emplace().plan = *plan;
    return {};
  };
  if (Status tracked = track(config.sign, figure.sign); !tracked) {
    return tl::unexpected(tracked.error());
  }
  if (Status tracked = track(config.valid, figure.valid); !tracked) {
    return tl::unexpected(tracked.error());
  }
  return figure;
}

Expected<MotionSignals> MotionSignals::make(const DbcFile& file,
                                            const MotionSignalsConfig& config) {
  if (Status valid = check(config); !valid) return tl::unexpected(valid.error());
  auto speed = make_figure(file, config.speed, "speed", metres_per_second_in);
  if (!speed) return tl::unexpected(speed.error());
  auto yaw_rate = make_figure(file, config.yaw_rate, "yaw rate", radians_per_second_in);
  if (!yaw_rate) return tl::unexpected(yaw_rate.error());
  MotionSignals motion;
  motion.speed_ = *speed;
  motion.yaw_rate_ = *yaw_rate;
  motion.max_age_ns_ = std::llround(config.max_age_s * kSecond_ns);
  motion.timeout_ns_ = std::llround(config.timeout_s * kSecond_ns);
  motion.add_ids(motion.speed_);
  motion.add_ids(motion.yaw_rate_);
  return motion;
}

void MotionSignals::add_ids(const Figure& figure) {
  const auto add = [&](const can::CanId& id) {
    if (std::ranges::find(ids_, id) == ids_.end()) ids_.push_back(id);
  };
  for (std::size_t i = 0; i < figure.count; ++i) add(figure.signals[i].plan.id());
  if (figure.sign) add(figure.sign->plan.id());
  if (figure.valid) add(figure.valid->plan.id());
}

std::optional<MotionSample> MotionSignals::take(const can::CanFrame& frame) noexcept {
  if (!frame.is_data() || std::find(ids_.begin(), ids_.end(), frame.id) == ids_.end()) {
    return std::nullopt;
  }
  ++counters_.frames;
  if (newest_frame_ns_ && frame.stamp_ns < *newest_frame_ns_) {
    if (*newest_frame_ns_ - frame.stamp_ns <= kMotionDisorder_ns) {
      ++counters_.out_of_order;
      return std::nullopt;
    }
    ++counters_.clock_set_back;
    reset();
  }
  newest_frame_ns_ = frame.stamp_ns;
  update(speed_, frame);
  if (!update(yaw_rate_, frame)) return std::nullopt;

  MotionSample sample;
  sample.stamp_ns = frame.stamp_ns;
  const Judgement yaw_rate = judge(yaw_rate_, frame.stamp_ns, sample.yaw_rate_radps);
  const Judgement speed = judge(speed_, frame.stamp_ns, sample.speed_mps);
  if (yaw_rate == Judgement::kInvalid) {
    ++counters_.yaw_rate_invalid;
  } else if (speed == Judgement::kInvalid) {
    ++counters_.speed_invalid;
  } else if (yaw_rate == Judgement::kStale || speed == Judgement::kStale) {
    ++counters_.stale;
  } else {
    note_sample(frame.stamp_ns);
    return sample;
  }
  return std::nullopt;
}

bool MotionSignals::alive(std::int64_t now_ns) noexcept {
  if (!newest_sample_ns_) return false;
  if (std::abs(now_ns - *newest_sample_ns_) <= timeout_ns_) return true;
  if (!lost_) ++counters_.timeouts;
  lost_ = true;
  return false;
}

void MotionSignals::note_sample(std::int64_t stamp_ns) noexcept {
  ++counters_.samples;
  if (!lost_ && newest_sample_ns_ && stamp_ns - *newest_sample_ns_ > timeout_ns_) {
    ++counters_.timeouts;
  }
  lost_ = false;
  newest_sample_ns_ = stamp_ns;
}

void MotionSignals::reset() noexcept {
  for (Figure* figure : {&speed_, &yaw_rate_}) {
    for (TrackedSignal& signal : figure->signals) signal.heard = false;
    if (figure->sign) figure->sign->heard = false;
    if (figure->valid) figure->valid->heard = false;
  }
  newest_sample_ns_.reset();
}

bool MotionSignals::update(Figure& figure, const can::CanFrame& frame) noexcept {
  bool any = false;
  for (std::size_t i = 0; i < figure.count; ++i) any = update(figure.signals[i], frame) || any;
  if (figure.sign) update(*figure.sign, frame);
  if (figure.valid) update(*figure.valid, frame);
  return any;
}

bool MotionSignals::update(TrackedSignal& signal, const can::CanFrame& frame) noexcept {
  if (signal.plan.id() != frame.id) return false;
  const auto value = signal.plan.value(frame);
  if (!value) {
    ++counters_.too_short;
    return false;
  }
  signal.value = *value;
  signal.stamp_ns = frame.stamp_ns;
  signal.heard = true;
  return true;
}

bool MotionSignals::fresh(const TrackedSignal& signal, std::int64_t now_ns) const noexcept {
  return signal.heard && now_ns - signal.stamp_ns <= max_age_ns_;
}

MotionSignals::Judgement MotionSignals::judge(const Figure& figure, std::int64_t now_ns,
                                              double& value) const noexcept {
  bool all_fresh = (!figure.sign || fresh(*figure.sign, now_ns)) &&
                   (!figure.valid || fresh(*figure.valid, now_ns));
  if (all_fresh && figure.valid && figure.valid->value != figure.valid_value) {
    return Judgement::kInvalid;
  }
  double sum = 0;
  for (std::size_t i = 0; i < figure.count; ++i) {
    all_fresh = all_fresh && fresh(figure.signals[i], now_ns);
    sum += figure.signals[i].value * figure.units[i];
  }
  if (!all_fresh) return Judgement::kStale;
  value = sum / static_cast<double>(figure.count) * figure.scale;
  if (figure.sign && figure.sign->value != 0) value = -value;
  return std::isfinite(value) ? Judgement::kGood : Judgement::kInvalid;
}

}  // namespace terracut::vehicle
