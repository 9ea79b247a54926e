// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/ground/ground_method.hpp"

#include <algorithm>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace terracut::ground {
namespace {

constexpr std::array kMethods{
    MethodName{"pfaff", "Fixed-grid extended elevation map (Pfaff et al. 2007)"},
    MethodName{"bogoslavskyi", "Column angles of the range image (Bogoslavskyi, Stachniss 2017)"},
    MethodName{"zhang", "Height labels by loopy belief propagation (Zhang et al. 2015)"},
    MethodName{"ring_map", "Ring-based elevation map, as printed"},
    MethodName{"ring_map_adjacent", "+ spatiotemporal adjacent points, as printed"},
    MethodName{"paper", "+ random field: the whole method as printed"},
    MethodName{"terracut_ring_map", "Elevation map of the default profile"},
    MethodName{"terracut_ring_map_adjacent", "+ adjacent points of the default profile"},
    MethodName{"terracut", "The default profile"},
    MethodName{"terracut_road", "The default profile, road surface told from other ground"},
};

MethodConfig up_to(stage::Stage last, const SegmenterConfig& profile) {
  MethodConfig config(profile);
  config.segmenter.last_stage = last;
  return config;
}

MethodConfig baseline(MethodKind kind) {
  MethodConfig config;
  config.kind = kind;
  return config;
}

}  // namespace

std::span<const MethodName> method_names() noexcept {
  return kMethods;
}

Expected<MethodConfig> method_named(std::string_view name) {
  if (name == "pfaff") return baseline(MethodKind::kPfaff);
  if (name == "bogoslavskyi") return baseline(MethodKind::kBogoslavskyi);
  if (name == "zhang") return baseline(MethodKind::kZhang);
  if (name == "ring_map") return up_to(stage::Stage::kElevationMap, paper_profile());
  if (name == "ring_map_adjacent") return up_to(stage::Stage::kAdjacentPoints, paper_profile());
  if (name == "paper") return up_to(stage::Stage::kMinCut, paper_profile());
  if (name == "terracut_ring_map") return up_to(stage::Stage::kElevationMap, terracut_profile());
  if (name == "terracut_ring_map_adjacent") {
    return up_to(stage::Stage::kAdjacentPoints, terracut_profile());
  }
  if (name == "terracut") return MethodConfig(terracut_profile());
  if (name == "terracut_road") {
    MethodConfig config(terracut_profile());
    config.segmenter.road.enabled = true;
    return config;
  }
  std::array<std::string_view, kMethods.size()> names;
  std::transform(kMethods.begin(), kMethods.end(), names.begin(),
                 [](const MethodName& method) { return method.name; });
  return fail(
      ErrorCode::kInvalidArgument,
      fmt::format("there is no method '{}'; expected one of {}", name, fmt::join(names, ", ")));
}

bool needs_all_points(const MethodConfig& config) noexcept {
  return config.kind != MethodKind::kSegmenter || config.segmenter.road.enabled ||
         config.segmenter.region.rule == random_field::RegionRule::kHistogram;
}

}  // namespace terracut::ground
