// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/bag/transform_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "calib/mount/mount_pose.hpp"
#include "firmware_io/bag/cdr_reader.hpp"

namespace terracut::bag {
namespace {

using mount::chained;
using mount::RigidTransform;

/// A hostile bag or node names no more frames than this.
constexpr std::size_t kMostFrames = 1000;
constexpr RigidTransform kIdentity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

std::optional<RigidTransform> transform_of(const std::array<double, 3>& t,
                                           std::array<double, 4> xyzw) {
  const double norm = std::hypot(std::hypot(xyzw[0], xyzw[1]), std::hypot(xyzw[2], xyzw[3]));
  const bool is_finite = std::isfinite(t[0] + t[1] + t[2]) && std::isfinite(norm) && norm > 0;
  if (!is_finite) return std::nullopt;
  for (double& part : xyzw) part /= norm;
  const auto [x, y, z, w] = xyzw;
  return RigidTransform{
      1 - 2 * (y * y + z * z), 2 * (x * y - z * w),     2 * (x * z + y * w),     t[0],
      2 * (x * y + z * w),     1 - 2 * (x * x + z * z), 2 * (y * z - x * w),     t[1],
      2 * (x * z - y * w),     2 * (y * z + x * w),     1 - 2 * (x * x + y * y), t[2]};
}

}  // namespace

std::string frame_name(std::string_view frame_id) {
  if (frame_id.starts_with('/')) frame_id.remove_prefix(1);
  return std::string(frame_id);
}

void TransformTree::add(std::span<const std::byte> message) {
  constexpr std::size_t kLeastBytes = 70;
  CdrReader from(message);
  for (std::size_t left = from.length(kLeastBytes); left > 0; --left) {
    const std::string parent = frame_name(Header::read(from).frame_id);
    const std::string child = frame_name(from.text());
    std::array<double, 3> translation{};
    std::array<double, 4> rotation{};
    for (double& part : translation) part = from.number<double>();
    for (double& part : rotation) part = from.number<double>();
    const auto T = transform_of(translation, rotation);
    if (from.failed() || !T || parents_.size() == kMostFrames) continue;
    const auto [known, is_new] = parents_.try_emplace(child, Parent{parent, *T});
    const Parent& before = known->second;
    if (!is_new && (before.frame != parent || before.T_parent_child != *T)) {
      known->second.is_certain = false;
    }
  }
}

void TransformTree::set(std::string_view parent, std::string_view child,
                        const std::array<double, 3>& translation,
                        const std::array<double, 4>& rotation_xyzw) {
  const auto T = transform_of(translation, rotation_xyzw);
  if (!T || parents_.size() == kMostFrames) return;
  parents_.insert_or_assign(frame_name(child), Parent{frame_name(parent), *T});
}

std::vector<std::string> TransformTree::frames() const {
  std::set<std::string> names;
  for (const auto& [child, parent] : parents_) names.insert({child, parent.frame});
  return {names.begin(), names.end()};
}

std::vector<std::pair<std::string, RigidTransform>> TransformTree::ancestors(
    const std::string& frame) const {
  std::vector<std::pair<std::string, RigidTransform>> line{{frame, kIdentity}};
  // Frames in a circle would have no end.
  while (line.size() <= parents_.size()) {
    const auto next = parents_.find(line.back().first);
    if (next == parents_.end() || !next->second.is_certain) break;
    line.emplace_back(next->second.frame, chained(next->second.T_parent_child, line.back().second));
  }
  return line;
}

std::optional<RigidTransform> TransformTree::transform(const std::string& from,
                                                       const std::string& to) const {
  const auto line_from = ancestors(from), line_to = ancestors(to);
  for (const auto& [frame, T_common_from] : line_from) {
    const auto common =
        std::ranges::find(line_to, frame, [](const auto& one) { return one.first; });
    if (common != line_to.end()) return chained(mount::inverse(common->second), T_common_from);
  }
  return std::nullopt;
}

}  // namespace terracut::bag
