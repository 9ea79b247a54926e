// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "pipeline/live/frame_pool.hpp"
#include "pipeline/points/labelled_point.hpp"
#include "pipeline/points/sector_record.hpp"

namespace terracut::live {

/// Carries the labelled points of sectors. Their time_s is 0: a return's time since the frame's
/// first packet is told with the whole frame.
using SectorPool = FramePool<points::LabelledPoint, points::SectorRecord>;

}  // namespace terracut::live
