// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/lab/encode/sensor_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <string>

namespace terracut::encode {
namespace {

using Pose = RigidMotion;

constexpr Pose kDrawnT_camera_lidar{0, -1, 0,  0,      //
                                    0, 0,  -1, -0.08,  //
                                    1, 0,  0,  -0.27};
constexpr double kMaxSpeed_m_s = 150;

Pose product(const Pose& a, const Pose& b) {
  Pose c{};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 4; ++column) {
      double sum = column == 3 ? a[row * 4 + 3] : 0.0;
      for (std::size_t k = 0; k < 3; ++k) sum += a[row * 4 + k] * b[k * 4 + column];
      c[row * 4 + column] = sum;
    }
  }
  return c;
}

Pose inverse(const Pose& a) {
  Pose b{};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) b[row * 4 + column] = a[column * 4 + row];
  }
  for (std::size_t row = 0; row < 3; ++row) {
    b[row * 4 + 3] = -(b[row * 4] * a[3] + b[row * 4 + 1] * a[7] + b[row * 4 + 2] * a[11]);
  }
  return b;
}

/// Computes the logarithm of a small motion: its rotation vector, and its translation to second
/// order.
void logarithm(const Pose& T, std::array<double, 3>& rotating, std::array<double, 3>& moving) {
  const double cosine = std::clamp((T[0] + T[5] + T[10] - 1) / 2, -1.0, 1.0);
  const double angle = std::acos(cosine);
  const double scale = angle > 1e-9 ? angle / (2 * std::sin(angle)) : 0.5;
  rotating = {scale * (T[9] - T[6]), scale * (T[2] - T[8]), scale * (T[4] - T[1])};
  const auto& w = rotating;
  const std::array<double, 3> t{T[3], T[7], T[11]};
  const std::array<double, 3> wt{w[1] * t[2] - w[2] * t[1], w[2] * t[0] - w[0] * t[2],
                                 w[0] * t[1] - w[1] * t[0]};
  const std::array<double, 3> wwt{w[1] * wt[2] - w[2] * wt[1], w[2] * wt[0] - w[0] * wt[2],
                                  w[0] * wt[1] - w[1] * wt[0]};
  for (std::size_t i = 0; i < 3; ++i) moving[i] = t[i] - wt[i] / 2 + wwt[i] / 12;
}

/// Reads the numbers of one line; false if the line has anything else.
bool parse_numbers(const char* text, std::vector<double>& numbers) {
  numbers.clear();
  for (;;) {
    while (*text == ' ' || *text == '\t' || *text == '\r') ++text;
    if (*text == '\0') return true;
    char* end = nullptr;
    const double number = std::strtod(text, &end);
    if (end == text || !std::isfinite(number)) return false;
    numbers.push_back(number);
    text = end;
  }
}

/// Reads `per_line` numbers from every non-empty line.
Expected<std::vector<double>> read_table(const std::filesystem::path& path, std::size_t per_line) {
  std::ifstream file(path);
  if (!file) {
    return fail(ErrorCode::kNotFound,
                fmt::format("{}: no such file, or not readable", path.string()));
  }
  std::vector<double> table, numbers;
  std::string line;
  for (std::size_t number = 1; std::getline(file, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    if (!parse_numbers(line.c_str(), numbers) || numbers.size() != per_line) {
      return fail(ErrorCode::kMalformed,
                  fmt::format("{}, line {}: expected {} finite number{}, found \"{:.40}\"",
                              path.string(), number, per_line, per_line == 1 ? "" : "s", line));
    }
    table.insert(table.end(), numbers.begin(), numbers.end());
  }
  return table;
}

/// Returns the 12 numbers after "Tr:" (or KITTI raw's "Tr_velo_to_cam:"); nothing without such a
/// line.
Expected<std::optional<Pose>> read_extrinsics(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string line;
  std::vector<double> numbers;
  for (std::size_t number = 1; std::getline(file, line); ++number) {
    std::size_t start = std::string::npos;
    for (const char* key : {"Tr:", "Tr_velo_to_cam:"}) {
      if (line.starts_with(key)) start = std::string(key).size();
    }
    if (start == std::string::npos) continue;
    if (!parse_numbers(line.c_str() + start, numbers) || numbers.size() != 12) {
      return fail(ErrorCode::kMalformed,
                  fmt::format("{}, line {}: expected 12 finite numbers after \"{}\"", path.string(),
                              number, line.substr(0, start)));
    }
    Pose pose{};
    std::copy(numbers.begin(), numbers.end(), pose.begin());
    return pose;
  }
  return std::nullopt;
}

}  // namespace

Expected<SensorMotion> SensorMotion::read(const std::filesystem::path& poses,
                                          const std::filesystem::path& times,
                                          const std::optional<std::filesystem::path>& calib) {
  const auto pose_numbers = read_table(poses, 12);
  if (!pose_numbers) return tl::unexpected(pose_numbers.error());
  auto time_numbers = read_table(times, 1);
  if (!time_numbers) return tl::unexpected(time_numbers.error());
  const std::size_t frames = pose_numbers->size() / 12;
  if (frames != time_numbers->size() || frames < 2) {
    return fail(ErrorCode::kMalformed,
                fmt::format("{} has {} poses and {} has {} times; expected as many of each, at "
                            "least 2, one for every frame of the sequence",
                            poses.string(), frames, times.string(), time_numbers->size()));
  }
  const auto stuck = std::adjacent_find(time_numbers->begin(), time_numbers->end(),
                                        [](double a, double b) { return !(a < b); });
  if (stuck != time_numbers->end()) {
    return fail(ErrorCode::kMalformed,
                fmt::format("{}: the time of frame {} is not after that of frame {}; expected "
                            "rising seconds",
                            times.string(), stuck - time_numbers->begin() + 1,
                            stuck - time_numbers->begin()));
  }
  SensorMotion motion;
  motion.poses_path_ = poses;
  motion.times_s_ = std::move(*time_numbers);
  motion.camera_poses_.resize(frames);
  for (std::size_t frame = 0; frame < frames; ++frame) {
    std::copy_n(pose_numbers->begin() + static_cast<std::ptrdiff_t>(frame * 12), 12,
                motion.camera_poses_[frame].begin());
  }
  motion.T_camera_lidar_ = kDrawnT_camera_lidar;
  if (calib) {
    const auto own = read_extrinsics(*calib);
    if (!own) return tl::unexpected(own.error());
    if (*own) motion.T_camera_lidar_ = **own;
  }
  return motion;
}

std::optional<RigidMotion> SensorMotion::between(std::uint32_t from, std::uint32_t to) const {
  if (from >= camera_poses_.size() || to >= camera_poses_.size()) return std::nullopt;
  const Pose T_to_from = product(inverse(camera_poses_[to]), camera_poses_[from]);
  return product(inverse(T_camera_lidar_), product(T_to_from, T_camera_lidar_));
}

Expected<SensorTwist> SensorMotion::twist(std::uint32_t frame) const {
  if (frame >= times_s_.size()) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("{} has poses of frames 0 to {}, but scan {} needs its own",
                            poses_path_.string(), times_s_.size() - 1, frame));
  }
  const std::size_t before = frame == 0 ? 0 : frame - 1;
  const std::size_t after = std::min<std::size_t>(frame + 1, times_s_.size() - 1);
  const Pose T_before_after =
      *between(static_cast<std::uint32_t>(after), static_cast<std::uint32_t>(before));
  SensorTwist twist;
  logarithm(T_before_after, twist.angular_velocity_rad_s, twist.velocity_m_s);
  const double seconds = times_s_[after] - times_s_[before];
  for (double& w : twist.angular_velocity_rad_s) w /= seconds;
  double squares = 0;
  for (double& v : twist.velocity_m_s) {
    v /= seconds;
    squares += v * v;
  }
  if (!(squares < kMaxSpeed_m_s * kMaxSpeed_m_s)) {
    return fail(ErrorCode::kMalformed,
                fmt::format("{}: {:.3g} m/s at frame {}, faster than any car; are poses and times "
                            "of the same sequence, poses in metres and times in seconds?",
                            poses_path_.string(), std::sqrt(squares), frame));
  }
  twist.frame_duration_s = seconds / static_cast<double>(after - before);
  return twist;
}

}  // namespace terracut::encode
