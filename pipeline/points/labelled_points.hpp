// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <span>

#include "firmware_io/frame/deskew_info.hpp"
#include "firmware_io/frame/firing_tile.hpp"
#include "firmware_io/frame/label.hpp"
#include "firmware_io/frame/measured_returns.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "pipeline/points/frame_timing.hpp"
#include "pipeline/points/labelled_point.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::points {

/// Writes the returns of a labelled frame to the first `image.returns()` elements of `points`, in
/// order of arrival: the n-th is the n-th of a .label file. `labels` has one entry per return, by
/// return index. Returns false, having written nothing, if the number of labels is not that of
/// returns or there is too little room. Times are exact to half a column and the head's unevenness;
/// all are 0 with the default `timing`. Real-time safe.
[[nodiscard]] bool pack_labelled_points(
    const frame::RangeImage& image, std::span<const frame::Label> labels,
    std::span<LabelledPoint> points, const FrameTiming& timing = {}) noexcept TERRACUT_NONBLOCKING;

/// Does the same for a decoded frame, without an image. `reader` is the sensor's. `motions` are the
/// frame's if its points are to be moved (frame::Frame::motions), else empty.
[[nodiscard]] bool pack_labelled_points(
    const frame::MeasuredReturns& returns, std::span<const frame::PlanarMotions> motions,
    frame::TileReader& reader, std::span<const frame::Label> labels,
    std::span<LabelledPoint> points, const FrameTiming& timing = {}) noexcept TERRACUT_NONBLOCKING;

/// Writes the returns of one tile of a frame that may still be arriving, in order of arrival;
/// their times are 0. `labels` and `points` have one element per return of the tile. Real-time
/// safe.
void pack_labelled_tile(const frame::MeasuredReturns& returns, std::size_t tile,
                        frame::TileReader& reader, std::span<const frame::Label> labels,
                        std::span<LabelledPoint> points) noexcept TERRACUT_NONBLOCKING;

}  // namespace terracut::points
