// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <span>

#include "firmware_io/sinks/labelled_turn_wire.hpp"
#include "pipeline/label.hpp"
#include "pipeline/range_image.hpp"
#include "rt/nonblocking.hpp"

namespace terracut::firmware_io {

/// Writes the returns of a labelled turn to the first `image.returns()` elements of `points`, in
/// order of arrival: the n-th is the n-th of a .label file. `labels` has one entry a return, by
/// return index. False, and nothing written, when there are not as many labels as returns or not
/// room for all of them. Real-time safe.
[[nodiscard]] bool pack_labelled_points(
    const pipeline::RangeImage& image, std::span<const pipeline::Label> labels,
    std::span<LabelledPoint> points) noexcept TERRACUT_NONBLOCKING;

}  // namespace terracut::firmware_io
