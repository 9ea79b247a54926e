// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "calib/mount/ring_profile.hpp"
#include "firmware_io/frame/label.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "pipeline/stage/cell_planes.hpp"

namespace terracut::eval {

/// A frame that every method has labelled; all data but planes is by return index of `image`.
struct LabelledByAll {
  const std::string& sequence;
  const std::string& frame;
  const frame::RangeImage& image;
  const mount::RingProfile& profile;
  std::span<const std::uint32_t> truth;  ///< Classes as in label files.
  std::function<std::span<const frame::Label>(std::size_t)> labels_of;  ///< By index of the method.
  std::function<const stage::CellPlanes&(std::size_t)> planes_of;       ///< By index of the method.
};

/// Receives frames, from any thread.
using LabelledByAllSink = std::function<void(const LabelledByAll&)>;

}  // namespace terracut::eval
