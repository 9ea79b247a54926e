// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <span>

#include "terracut/error.hpp"
#include "terracut/frame.hpp"

namespace terracut {

/// Writes one little-endian uint32 per label, SemanticKITTI classes: 40 ground, 49 ground not road,
/// 99 obstacle, 0 none; whole or not at all (by a rename). Fails with kWriteFailed.
[[nodiscard]] Status write_labels(const std::filesystem::path& file, std::span<const Label> labels);

/// Writes a binary PCD of x, y, z, intensity, ring and label (classes as above), one point per
/// return, and of height_above_ground if the frame has it. The file appears whole or not at all.
/// Fails with kWriteFailed, or kInvalidArgument if there are not as many labels, or heights, as
/// points.
[[nodiscard]] Status write_pcd(const std::filesystem::path& file, const Frame& frame);

}  // namespace terracut
