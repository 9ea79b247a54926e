// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "labelled_frame.hpp"

#include "firmware_io/frame/each_return.hpp"
#include "firmware_io/scan/label_file.hpp"

namespace terracut::hazards {

LabelledFrame labelled_frame(const frame::RangeImage& image, std::span<const std::uint32_t> truth,
                             const mount::Mount& mount, const datasets::ClassTable& classes) {
  LabelledFrame labelled;
  labelled.shape = image.shape();
  const auto [x_m, y_m, z_m] = mount::apply(mount::T_vehicle_lidar(mount), 0, 0, 0);
  labelled.sensor = {x_m, y_m, z_m};
  const std::size_t returns = image.returns();
  labelled.at.resize(returns);
  labelled.beam.resize(returns);
  labelled.range_m.resize(returns);
  labelled.cell.resize(returns);
  labelled.intensity.resize(returns);
  labelled.class_id.resize(returns);
  labelled.role.resize(returns);
  labelled.ground.resize(returns);
  frame::for_each_return(image, [&](const frame::PlacedReturn& placed) {
    const std::size_t i = placed.return_index;
    const frame::Return& point = placed.point;
    labelled.at[i] = {double{point.x_m}, double{point.y_m}, double{point.z_m}};
    const Eigen::Vector3d way = labelled.at[i] - labelled.sensor;
    labelled.range_m[i] = way.norm();
    labelled.beam[i] = way / labelled.range_m[i];
    labelled.cell[i] = {placed.row, placed.column};
    labelled.intensity[i] = point.intensity;
    labelled.class_id[i] = scan::semantic_class(truth[i]);
    labelled.role[i] = datasets::Role::kIgnored;
    if (const auto* const entry = classes.find(labelled.class_id[i])) {
      labelled.role[i] = entry->role(datasets::GroundDefinition::kAll);
      labelled.ground[i] = ground_kind(*entry);
    }
  });
  return labelled;
}

}  // namespace terracut::hazards
