// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "pipeline/points/labelled_point.hpp"
#include "pipeline/points/sector_record.hpp"
#include "pipeline/scene/scene_finder.hpp"
#include "pipeline/status/frame_record.hpp"

namespace terracut::publish {

/// A labelled frame on its way to outputs without a deadline.
struct LabelledFrame {
  status::FrameRecord record;                 ///< Complete except for what happens after labelling.
  std::vector<points::LabelledPoint> points;  ///< Returns of the frame in order of arrival.
  /// Height of each return above the ground, metres; empty unless asked for.
  std::vector<float> heights_m;
  /// Objects, and the number of each return's object (0: none; object i has the number i + 1);
  /// empty unless asked for.
  std::vector<objects::Object> objects;
  std::vector<std::uint16_t> object_of_point;
  std::vector<free_way::Sector> free_way;  ///< As FreeWay::sectors(); empty unless asked for.
};

/// Copies what was found in a frame to it.
inline void set_scene(const scene::SceneFinder& found, LabelledFrame& frame) {
  const std::span<const std::uint16_t> numbers = found.object_of_return();
  frame.objects.assign(found.objects().begin(), found.objects().end());
  frame.object_of_point.assign(numbers.begin(), numbers.end());
  frame.free_way.assign(found.free_way().begin(), found.free_way().end());
}

/// A labelled sector on its way to the same outputs, before its frame. The time_s of its points is
/// 0.
struct LabelledSector {
  points::SectorRecord record;
  std::vector<points::LabelledPoint> points;  ///< Returns of the sector in order of arrival.
  std::vector<float> heights_m;               ///< As in LabelledFrame.
  std::vector<CompleteObject> objects;        ///< As in terracut::Sector; empty unless asked for.
};

/// A frame or a sector that all outputs share and nobody changes.
using SharedFrame = std::shared_ptr<const LabelledFrame>;
using SharedSector = std::shared_ptr<const LabelledSector>;

}  // namespace terracut::publish
