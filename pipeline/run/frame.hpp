// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "firmware_io/frame/range_image.hpp"
#include "pipeline/status/frame_record.hpp"

namespace terracut::run {

/// A frame on its way from packets to labels: its returns and all facts known so far. The function
/// that returns a frame states how long the image is valid.
struct Frame {
  frame::RangeImage* image = nullptr;
  status::FrameRecord record;
};

}  // namespace terracut::run
