// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <span>

#include "firmware_io/frame/label.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "pipeline/stream/labelled_frame_wire.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::stream {

/// Writes the returns of a labelled frame to the first `image.returns()` elements of `points`, in
/// order of arrival: the n-th is the n-th of a .label file. `labels` has one entry a return, by
/// return index. False, and nothing written, when there are not as many labels as returns or not
/// room for all of them. Real-time safe.
[[nodiscard]] bool pack_labelled_points(
    const frame::RangeImage& image, std::span<const frame::Label> labels,
    std::span<LabelledPoint> points) noexcept TERRACUT_NONBLOCKING;

}  // namespace terracut::stream
