// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "parameter_table.hpp"

#include <array>
#include <type_traits>
#include <vector>

#include "pipeline/ground/parameter_table.hpp"

namespace terracut::baselines {
namespace {

// Makes the two functions that read and write one field of the configuration.
#define TERRACUT_FIELD(path)                                                    \
  [](const MethodConfig& c) noexcept { return static_cast<double>(c.path); },   \
      [](MethodConfig& c, double value) noexcept {                              \
        c.path = static_cast<std::remove_reference_t<decltype(c.path)>>(value); \
      }

constexpr double kFar = ground::kNoLimit;

// clang-format off: a table reads better with an entry on two lines than one word a line.
constexpr std::array kParameters{
    Parameter{"pfaff.cell_m", "m", "Side of a square of the fixed grid", 0.05, 10, {},
              TERRACUT_FIELD(pfaff.cell_m)},
    Parameter{"pfaff.extent_m", "m", "Half the side of the map; farther returns belong to its edge", 10, 250, {},
              TERRACUT_FIELD(pfaff.extent_m)},
    Parameter{"pfaff.sigma_m", "m", "Standard deviation of a height at range 0", 0.001, 1, {},
              TERRACUT_FIELD(pfaff.sigma_m)},
    Parameter{"pfaff.sigma_per_metre", "m/m", "Its growth with range", 0, 0.1, {},
              TERRACUT_FIELD(pfaff.sigma_per_metre)},
    Parameter{"pfaff.vertical_sigma_m", "m", "Heights of a square that vary more are not one level", 0.001, 5, {},
              TERRACUT_FIELD(pfaff.vertical_sigma_m)},
    Parameter{"pfaff.vehicle_height_m", "m", "A gap larger than this can be driven through", 0.1, kFar, {},
              TERRACUT_FIELD(pfaff.vehicle_height_m)},
    Parameter{"pfaff.obstacle_height_m", "m", "Obstacle from this height above the square's elevation on", 0.01, 5, {},
              TERRACUT_FIELD(pfaff.obstacle_height_m)},

    Parameter{"bogoslavskyi.start_deg", "deg", "Ground starts at no steeper angle", 0.1, 90, {},
              TERRACUT_FIELD(bogoslavskyi.start_deg)},
    Parameter{"bogoslavskyi.same_ground_deg", "deg", "Neighbours of the ground whose angle differs by less are ground", 0.1, 90, {},
              TERRACUT_FIELD(bogoslavskyi.same_ground_deg)},
    Parameter{"bogoslavskyi.smoothing_window", "rows", "Window of the Savitzky-Golay filter, an odd number; an even one counts as the next odd one", 1, 15, {},
              TERRACUT_FIELD(bogoslavskyi.smoothing_window)},
    Parameter{"bogoslavskyi.repair_rows", "rows", "A hole is bridged from no farther away", 0, 32, {},
              TERRACUT_FIELD(bogoslavskyi.repair_rows)},
    Parameter{"bogoslavskyi.repair_range_m", "m", "... between ranges that differ by less", 0, 100, {},
              TERRACUT_FIELD(bogoslavskyi.repair_range_m)},
    Parameter{"bogoslavskyi.margin_rows", "rows", "Ground grows by so many rows up and down at the end; not in the paper", 0, 16, {},
              TERRACUT_FIELD(bogoslavskyi.margin_rows)},

    Parameter{"zhang.sectors", "", "Sectors of the polar map", 3, 2000, {},
              TERRACUT_FIELD(zhang.sectors)},
    Parameter{"zhang.band_m", "m", "Width of its rings", 0.2, 20, {},
              TERRACUT_FIELD(zhang.band_m)},
    Parameter{"zhang.range_limit_m", "m", "Farther returns belong to the last ring", 10, 250, {},
              TERRACUT_FIELD(zhang.range_limit_m)},
    Parameter{"zhang.height_labels", "", "Heights of the ground to choose from", 2, 128, {},
              TERRACUT_FIELD(zhang.height_labels)},
    Parameter{"zhang.height_step_m", "m", "How far apart they are", 0.01, 1, {},
              TERRACUT_FIELD(zhang.height_step_m)},
    Parameter{"zhang.above_cost", "", "Cost of a cell all of whose returns are above the ground", 0, 1000, {},
              TERRACUT_FIELD(zhang.above_cost)},
    Parameter{"zhang.below_cost", "", "... all of whose returns are below it", 0, 1000, {},
              TERRACUT_FIELD(zhang.below_cost)},
    Parameter{"zhang.beside_cost", "", "... all of whose returns are one step off it", 0, 1000, {},
              TERRACUT_FIELD(zhang.beside_cost)},
    Parameter{"zhang.full_returns", "returns", "Cells with fewer have less say", 1, 1000, {},
              TERRACUT_FIELD(zhang.full_returns)},
    Parameter{"zhang.hidden_cost", "", "Cost of ground above a beam that passed the cell", 0, 1000, {},
              TERRACUT_FIELD(zhang.hidden_cost)},
    Parameter{"zhang.step_cost_per_m", "1/m", "Cost of neighbours whose heights differ more than a slope", 0, 1000, {},
              TERRACUT_FIELD(zhang.step_cost_per_m)},
    Parameter{"zhang.step_cost_limit", "", "... at most", 0, 1000, {},
              TERRACUT_FIELD(zhang.step_cost_limit)},
    Parameter{"zhang.max_slope", "m/m", "What a slope may be", 0, 2, {},
              TERRACUT_FIELD(zhang.max_slope)},
    Parameter{"zhang.iterations", "", "Of the belief propagation", 0, 1000, {},
              TERRACUT_FIELD(zhang.iterations)},
    Parameter{"zhang.obstacle_height_m", "m", "Obstacle from this height above the ground on", 0.01, 5, {},
              TERRACUT_FIELD(zhang.obstacle_height_m)},
};
// clang-format on
#undef TERRACUT_FIELD

}  // namespace

std::span<const Parameter> parameters() noexcept {
  return kParameters;
}

Status apply_setting(MethodConfig& config, std::string_view setting) {
  const auto parts = ground::parts_of_setting(setting);
  if (!parts) return tl::unexpected<Error>(parts.error());
  if (const Parameter* own = ground::find_parameter(parameters(), parts->key)) {
    return own->read(config, parts->value);
  }
  if (ground::find_parameter(ground::parameters(), parts->key) != nullptr) {
    return ground::set_parameter(config.segmenter, parts->key, parts->value);
  }
  std::vector<std::string_view> known = ground::keys_of(ground::parameters());
  for (const Parameter& own : parameters()) known.push_back(own.key);
  return ground::unknown_parameter(parts->key, known);
}

MethodKind kind_that_uses(std::string_view key) noexcept {
  if (key.starts_with("pfaff.")) return MethodKind::kPfaff;
  if (key.starts_with("bogoslavskyi.")) return MethodKind::kBogoslavskyi;
  if (key.starts_with("zhang.")) return MethodKind::kZhang;
  return MethodKind::kSegmenter;
}

}  // namespace terracut::baselines
