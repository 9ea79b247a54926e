// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/mount/mount_pose.hpp"

#include <Eigen/Geometry>

namespace terracut::mount {

Pose pose_of(const RigidTransform& T) noexcept {
  const Eigen::Matrix3d rotation{{T[0], T[1], T[2]}, {T[4], T[5], T[6]}, {T[8], T[9], T[10]}};
  Eigen::Quaterniond q(rotation);
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  return {{T[3], T[7], T[11]}, {q.x(), q.y(), q.z(), q.w()}};
}

}  // namespace terracut::mount
