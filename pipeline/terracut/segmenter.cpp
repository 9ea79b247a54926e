// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "terracut/segmenter.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "calib/mount/ring_profile.hpp"
#include "calib/terracut/calibration_table.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "firmware_io/scan/ring_recovery.hpp"
#include "firmware_io/scan/ring_table_fit.hpp"
#include "firmware_io/scan/scan_to_image.hpp"
#include "firmware_io/terracut/points.hpp"
#include "pipeline/ground/segmenter.hpp"
#include "pipeline/terracut/profile.hpp"
#include "rt/memory/fixed_memory.hpp"

namespace terracut {

struct Segmenter::Engine {
  explicit Engine(const Config& wanted)
      : config(wanted),
        mount(mount_of(wanted.mount)),
        image(shape, shape.cells(), memory),
        to_image(mount) {}

  /// Which elevations the rings have, by the first cloud.
  Status learn_rings() {
    scan::RingTableFit fit;
    fit.add(points, rings.ring_of_point);
    const auto fitted = fit.fit();
    if (!fitted) return tl::unexpected(fitted.error());
    table = fitted->table;
    segmenter.emplace(config_of(config.profile), scan::ring_profile(*table, mount), shape,
                      image.return_capacity(), memory);
    return {};
  }

  Config config;
  mount::Mount mount;
  memory::FixedMemory memory;
  frame::ImageShape shape;
  frame::RangeImage image;
  scan::ScanToImage to_image;
  scan::RingRecovery rings;
  std::optional<scan::RingTable> table;  ///< Known from the first cloud on, as segmenter.
  std::optional<ground::Segmenter> segmenter;
  std::vector<scan::ScanPoint> points;
  std::vector<Label> labels;
};

Segmenter::Segmenter(std::unique_ptr<Engine> engine) noexcept : engine_(std::move(engine)) {}
Segmenter::Segmenter(Segmenter&&) noexcept = default;
Segmenter& Segmenter::operator=(Segmenter&&) noexcept = default;
Segmenter::~Segmenter() = default;

Expected<Segmenter> Segmenter::make(const Config& config) {
  return made([&] { return Segmenter(std::make_unique<Engine>(config)); });
}

Expected<std::span<const Label>> Segmenter::label(std::span<const CloudPoint> cloud) {
  Engine& of = *engine_;
  of.points.resize(cloud.size());
  std::ranges::transform(cloud, of.points.begin(), [](const CloudPoint& point) {
    return scan::ScanPoint{point.x_m, point.y_m, point.z_m, point.remission};
  });
  const Status split = recover_rings(of.points, of.table ? &*of.table : nullptr, of.rings);
  if (!split) return tl::unexpected(split.error());
  if (!of.segmenter) {
    if (const Status learnt = of.learn_rings(); !learnt) return tl::unexpected(learnt.error());
  }
  (void)of.to_image.place(of.points, of.rings.ring_of_point, of.image);
  (void)of.segmenter->segment(of.image);
  of.to_image.labels_of_points(of.segmenter->labels(), of.labels);
  return std::span<const Label>(of.labels);
}

}  // namespace terracut
