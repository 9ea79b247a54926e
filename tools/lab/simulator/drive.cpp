// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "drive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <system_error>
#include <thread>
#include <vector>

#include "calib/beams/angle.hpp"
#include "object_index.hpp"
#include "scan_head.hpp"
#include "tools/lab/drive/firing_plan.hpp"
#include "tools/lab/scenes/scene.hpp"
#include "tools/lab/simulator/simulated_motion.hpp"

namespace terracut::simulator {
namespace {

// After this many firings (9 ms) objects are sorted again; nothing moves far in that time.
constexpr std::int64_t kBatch = 192;
// The beams start at most this far from the sensor's origin.
constexpr double kBeamStarts_m = 0.5;

Status in_range(const char* what, double value, double least, double most) {
  if (value >= least && value <= most) return {};
  return fail(ErrorCode::kInvalidArgument,
              fmt::format("simulation: {} is {}, expected {} to {}", what, value, least, most));
}

Status check(const DriveConfig& config) {
  const SensorEffects& effects = config.effects;
  const Status checks[] = {
      in_range("duration_s", config.duration_s, 1e-3, 3600),
      in_range("spin_hz", config.spin_hz, 5, 20),
      in_range("speed_mps", config.speed_mps, -1, 60),
      in_range("yaw_rate_radps", config.yaw_rate_radps, -1, 1),
      in_range("mount.height_m", config.mount.height_m, 0.2, 6),
      in_range("mount.roll_rad", config.mount.roll_rad, -3.1416, 3.1416),
      in_range("mount.pitch_rad", config.mount.pitch_rad, -1.5708, 1.5708),
      in_range("effects.range_noise_m", effects.range_noise_m, 0, 1),
      in_range("effects.random_drop_share", effects.random_drop_share, 0, 1),
      in_range("effects.min_range_m", effects.min_range_m, 0, effects.max_range_m),
      in_range("effects.max_range_m", effects.max_range_m, effects.min_range_m, 130),
      in_range("threads", config.threads, 1, 64),
  };
  for (const Status& status : checks) {
    if (!status) return status;
  }
  return {};
}

/// A running drive: the world at the current batch of firings.
template <class EncoderTraits>
class Drive {
 public:
  using Column = SimulatedColumn<EncoderTraits>;

  Drive(const SimulationConfig<EncoderTraits>& config, const scenes::Scene& scene,
        std::int64_t frames)
      : config_(config),
        scene_(scene),
        T_vehicle_lidar_(mount_pose(config.mount)),
        plan_(config.calibration, config.sensor.returns, config.spin_hz, frames),
        head_(config, scene.terrain, plan_),
        objects_{ObjectIndex(scene), ObjectIndex(scene)},
        returns_(static_cast<std::size_t>(packets::returns_per_firing(config.sensor.returns))),
        columns_(static_cast<std::size_t>(kBatch) * returns_) {}

  Expected<SimulationSummary> run(const ColumnSink<EncoderTraits>& sink) {
    SimulationSummary summary;
    summary.frames = static_cast<std::uint64_t>(plan_.frames());
    for (std::int64_t first = 0; first < plan_.firings(); first += kBatch) {
      const std::int64_t count = std::min(kBatch, plan_.firings() - first);
      move_world(first, count);
      cast(first, count);
      for (const Column& column :
           std::span(columns_).first(static_cast<std::size_t>(count) * returns_)) {
        for (const packets::LabelledReturn& beam : column.wire.by_laser)
          summary.returns += beam.raw != 0;
        ++summary.columns;
        if (Status status = sink(column); !status) return tl::unexpected(status.error());
      }
    }
    return summary;
  }

 private:
  [[nodiscard]] Eigen::Isometry3d T_world_lidar(double time_s) const {
    return ego_pose(scene_, time_s) * T_vehicle_lidar_;
  }

  void move_world(std::int64_t first, std::int64_t count) {
    const drive::Firing begin = plan_.firing(first);
    const drive::Firing end = plan_.firing(first + count - 1);
    if (config_.motion_within_frame) {
      const double window_s = end.time_s - begin.time_s;
      update(0, begin.time_s, window_s);
      return;
    }
    const double frame_period_s = 1 / config_.spin_hz;
    // Beams point some degrees before and behind the head, perhaps into another frame.
    for (const std::int64_t cdeg : {begin.azimuth_cdeg - 1500, end.azimuth_cdeg + 1500}) {
      const std::int64_t frame = (cdeg - beams::wrap_cdeg(cdeg)) / beams::kRevolution_cdeg;
      if (!plan_.wants(frame)) continue;
      const auto parity = static_cast<std::size_t>(frame % 2);
      const double time_s = static_cast<double>(frame) * frame_period_s;
      if (frame_moments_[parity].objects != nullptr && still_time_s_[parity] == time_s) continue;
      update(parity, time_s, 0);
      frame_moments_[parity] = {&objects_[parity], 0, T_world_lidar(time_s)};
      still_time_s_[parity] = time_s;
    }
  }

  void update(std::size_t index, double time_s, double window_s) {
    const Eigen::Vector3d viewpoint = T_world_lidar(time_s).translation();
    const double reach_m = kBeamStarts_m + 1.2 * std::abs(scene_.ego_speed_mps) * window_s;
    objects_[index].update(time_s, window_s, viewpoint, reach_m);
    batch_time_s_ = time_s;
  }

  void cast_one(std::int64_t index, std::span<Column> columns) const {
    const drive::Firing firing = plan_.firing(index);
    if (!config_.motion_within_frame) {
      head_.cast(firing, frame_moments_, columns);
      return;
    }
    const Moment moment{&objects_[0], firing.time_s - batch_time_s_, T_world_lidar(firing.time_s)};
    head_.cast(firing, {moment, moment}, columns);
  }

  /// Computes firings in parallel: of n threads, each takes every n-th firing. A firing's result
  /// depends only on its index.
  void cast(std::int64_t first, std::int64_t count) {
    const auto share = [&](std::int64_t from) {
      for (std::int64_t i = from; i < count; i += config_.threads) {
        const auto at = static_cast<std::size_t>(i) * returns_;
        cast_one(first + i, std::span(columns_).subspan(at, returns_));
      }
    };
    std::vector<std::jthread> helpers;
    for (int i = 1; i < config_.threads; ++i) {
      try {
        helpers.emplace_back(share, i);
      } catch (const std::system_error&) {  // the system has no thread left
        share(i);
      }
    }
    share(0);
  }

  const SimulationConfig<EncoderTraits>& config_;
  const scenes::Scene& scene_;
  Eigen::Isometry3d T_vehicle_lidar_;
  drive::FiringPlan<EncoderTraits> plan_;
  ScanHead<EncoderTraits> head_;
  std::array<ObjectIndex, 2> objects_;  ///< For even and odd frames; with motion only the first.
  std::array<Moment, 2> frame_moments_{};
  std::array<double, 2> still_time_s_{};
  double batch_time_s_ = 0;
  std::size_t returns_;  ///< Columns per firing.
  std::vector<Column> columns_;
};

/// The objects made from a configuration after it was checked.
template <class EncoderTraits>
struct DrivePlan {
  std::int64_t frames = 0;
  scenes::Scene scene;

  [[nodiscard]] static Expected<DrivePlan> of(const SimulationConfig<EncoderTraits>& config) {
    for (const Status& status : {validate(config.calibration), check(config)}) {
      if (!status) return tl::unexpected(status.error());
    }
    if constexpr (packets::kHasNumberedColumns<EncoderTraits>) {
      if (config.calibration.rate_hz != config.spin_hz) {
        return fail(ErrorCode::kInvalidArgument,
                    fmt::format("simulation: spin_hz is {:g}, but the unit turns at {:g} Hz; "
                                "without a unit's own mode there are 5, 10 and 20 Hz",
                                config.spin_hz, config.calibration.rate_hz));
      }
    }
    const std::int64_t frames =
        std::max<std::int64_t>(1, std::llround(config.duration_s * config.spin_hz));
    const double duration_s = static_cast<double>(frames) / config.spin_hz;
    Expected<scenes::Scene> scene =
        scenes::make_scene(config.scene, {config.seed, duration_s, config.speed_mps});
    if (!scene) return tl::unexpected(scene.error());
    if (config.yaw_rate_radps != 0) scene->ego_arc = {config.yaw_rate_radps, duration_s / 2};
    return DrivePlan{frames, *std::move(scene)};
  }

  [[nodiscard]] drive::FiringPlan<EncoderTraits> firings(
      const SimulationConfig<EncoderTraits>& config) const {
    return {config.calibration, config.sensor.returns, config.spin_hz, frames};
  }
};

/// Returns the world's time for a stamp of the drive.
template <class EncoderTraits>
double world_time_s(const SimulationConfig<EncoderTraits>& config,
                    const drive::FiringPlan<EncoderTraits>& firings, std::int64_t stamp_ns) {
  return firings.firing(0).time_s + static_cast<double>(stamp_ns - config.start_ns) * 1e-9;
}

}  // namespace

template <class EncoderTraits>
Expected<SimulationSummary> simulate_drive(
    const SimulationConfig<EncoderTraits>& config,
    const std::type_identity_t<ColumnSink<EncoderTraits>>& sink) {
  const auto plan = DrivePlan<EncoderTraits>::of(config);
  if (!plan) return tl::unexpected(plan.error());
  return Drive<EncoderTraits>(config, plan->scene, plan->frames).run(sink);
}

template <class EncoderTraits>
Expected<std::vector<vehicle::MotionSample>> simulated_motion(
    const SimulationConfig<EncoderTraits>& config, std::int64_t period_ns) {
  const auto plan = DrivePlan<EncoderTraits>::of(config);
  if (!plan) return tl::unexpected(plan.error());
  const Status status = in_range("period_ns", static_cast<double>(period_ns), 1e5, 1e9);
  if (!status) return tl::unexpected(status.error());
  const drive::FiringPlan<EncoderTraits> firings = plan->firings(config);
  const std::int64_t end_ns = config.start_ns + firings.after_ns(firings.firings()) + period_ns;
  std::vector<vehicle::MotionSample> samples;
  for (std::int64_t stamp_ns = config.start_ns - period_ns; stamp_ns <= end_ns;
       stamp_ns += period_ns) {
    samples.push_back(ego_motion(plan->scene, world_time_s(config, firings, stamp_ns)));
    samples.back().stamp_ns = stamp_ns;
  }
  return samples;
}

template <class EncoderTraits>
Expected<std::function<mount::RigidTransform(std::int64_t)>> simulated_poses(
    const SimulationConfig<EncoderTraits>& config) {
  auto plan = DrivePlan<EncoderTraits>::of(config);
  if (!plan) return tl::unexpected(plan.error());
  const drive::FiringPlan<EncoderTraits> firings = plan->firings(config);
  return [config, firings, scene = std::move(plan->scene)](std::int64_t stamp_ns) {
    const Eigen::Isometry3d pose = ego_pose(scene, world_time_s(config, firings, stamp_ns));
    mount::RigidTransform T{};
    for (int i = 0; i < 12; ++i) T[static_cast<std::size_t>(i)] = pose(i / 4, i % 4);
    return T;
  };
}

#define TERRACUT_INSTANTIATE(EncoderTraits)                                                   \
  template Expected<SimulationSummary> simulate_drive(const SimulationConfig<EncoderTraits>&, \
                                                      const ColumnSink<EncoderTraits>&);      \
  template Expected<std::vector<vehicle::MotionSample>> simulated_motion(                     \
      const SimulationConfig<EncoderTraits>&, std::int64_t);                                  \
  template Expected<std::function<mount::RigidTransform(std::int64_t)>> simulated_poses(      \
      const SimulationConfig<EncoderTraits>&);
TERRACUT_FOR_ENCODER_TRAITS(TERRACUT_INSTANTIATE)
#undef TERRACUT_INSTANTIATE

}  // namespace terracut::simulator
