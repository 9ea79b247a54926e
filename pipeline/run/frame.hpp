// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <span>

#include "firmware_io/frame/deskew_info.hpp"
#include "firmware_io/frame/measured_returns.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "pipeline/status/frame_record.hpp"

namespace terracut::run {

/// A frame on its way from packets to labels: its returns and all facts known so far. The function
/// that returns a frame states how long they are valid.
struct Frame {
  const frame::MeasuredReturns* returns = nullptr;
  std::span<const frame::PlanarMotions> motions;  ///< See frame::Frame::motions.
  const frame::RangeImage* image = nullptr;       ///< The points, where they were asked for.
  /// The same returns where they were measured: another image in deskewed frames, where it was
  /// asked for.
  const frame::RangeImage* as_measured = nullptr;
  status::FrameRecord record;
};

}  // namespace terracut::run
