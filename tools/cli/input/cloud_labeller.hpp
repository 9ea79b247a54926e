// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "calib/mount/ring_profile.hpp"
#include "firmware_io/cloud/sensor_rows.hpp"
#include "firmware_io/scan/scan_to_image.hpp"
#include "pipeline/ground/frame_method.hpp"
#include "pipeline/run/stage_clock.hpp"
#include "pipeline/status/frame_record.hpp"
#include "rt/memory/fixed_memory.hpp"

namespace terracut::cli {

/// Labels one cloud of a sensor after the other; everything that is kept between them. One thread.
struct CloudLabeller {
  memory::FixedMemory memory;
  cloud::RowFinder finder;
  frame::RangeImage image;
  std::unique_ptr<ground::FrameMethod> method;
  scan::ScanToImage scan_to_image;
  scan::RingRecovery rings;
  run::StageClock clock;
  scan::ScanToImage::Summary placed;        ///< Of the last cloud, as what follows.
  std::vector<frame::Label> point_labels;   ///< One a point, in the cloud's order.
  std::vector<std::uint32_t> return_truth;  ///< truth_of_returns()

  CloudLabeller(const ground::MethodMaker& maker, const cloud::SensorRows& rows,
                const mount::RingProfile& profile)
      : finder(rows),
        image(rows.shape(), rows.shape().cells(), memory),
        method(maker(
            {.profile = profile, .shape = rows.shape(), .return_capacity = image.return_capacity()},
            memory)),
        scan_to_image(profile.mount) {}

  /// Fills in what of `record` is known of a cloud. The errors of cloud::RowFinder::find().
  Status label(const cloud::CloudView& cloud, status::FrameRecord& record,
               const min_cut::CutBudget& budget = {}) {
    if (Status found = finder.find(cloud, rings); !found) return found;
    placed = scan_to_image.place(cloud.points, rings.ring_of_point, image);
    record.segmentation = method->segment(image, budget, &clock);
    record.stages = clock.take();
    scan_to_image.labels_of_points(method->labels(), point_labels);
    record.segmentation.count(point_labels);
    // Points that are no return have kNone, which is counted as neither.
    const auto no_place = static_cast<std::uint32_t>(placed.no_place);
    record.segmentation.returns -= no_place;
    record.segmentation.obstacles -= no_place;
    record.info.returns = static_cast<std::uint32_t>(cloud.points.size() - placed.no_place);
    record.info.losses.overflow_full_returns = placed.overflow_full;
    return {};
  }

  /// The cloud's truth in the order of the image's returns; empty without labels.
  std::span<const std::uint32_t> truth_of_returns(std::span<const std::uint32_t> truth) {
    return_truth.clear();
    if (truth.empty()) return return_truth;
    for (const std::uint32_t point : scan_to_image.point_of_return()) {
      return_truth.push_back(truth[point]);
    }
    return return_truth;
  }
};

}  // namespace terracut::cli
