// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <memory>
#include <vector>

#include "pipeline/points/labelled_point.hpp"
#include "pipeline/status/frame_record.hpp"

namespace terracut::publish {

/// A labelled frame on its way to outputs without a deadline.
struct LabelledFrame {
  status::FrameRecord record;                 ///< Complete except for what happens after labelling.
  std::vector<points::LabelledPoint> points;  ///< Returns of the frame in order of arrival.
};

/// A frame that all outputs share and nobody changes.
using SharedFrame = std::shared_ptr<const LabelledFrame>;

}  // namespace terracut::publish
