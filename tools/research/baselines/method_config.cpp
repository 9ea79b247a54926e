// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "method_config.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "pipeline/ground/closed_turns.hpp"
#include "pipeline/ground/segmenter.hpp"
#include "pipeline/ground/stream_segmenter.hpp"

namespace terracut::baselines {
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

MethodConfig up_to(stage::Stage last, const ground::SegmenterConfig& profile) {
  MethodConfig config{.segmenter = profile};
  config.segmenter.last_stage = last;
  return config;
}

MethodConfig baseline(MethodKind kind) {
  return {.kind = kind};
}

template <class Method>
ground::MethodMaker maker(const typename Method::Config& config) {
  return [config](ground::FramesToCome frames, memory::FixedMemory& memory) {
    return std::make_unique<Method>(config, frames.profile, frames.shape, frames.return_capacity,
                                    memory);
  };
}

}  // namespace

std::span<const MethodName> method_names() noexcept {
  return kMethods;
}

Expected<MethodConfig> method_named(std::string_view name) {
  if (name == "pfaff") return baseline(MethodKind::kPfaff);
  if (name == "bogoslavskyi") return baseline(MethodKind::kBogoslavskyi);
  if (name == "zhang") return baseline(MethodKind::kZhang);
  if (name == "ring_map") return up_to(stage::Stage::kElevationMap, ground::paper_profile());
  if (name == "ring_map_adjacent") {
    return up_to(stage::Stage::kAdjacentPoints, ground::paper_profile());
  }
  if (name == "paper") return up_to(stage::Stage::kMinCut, ground::paper_profile());
  if (name == "terracut_ring_map") {
    return up_to(stage::Stage::kElevationMap, ground::terracut_profile());
  }
  if (name == "terracut_ring_map_adjacent") {
    return up_to(stage::Stage::kAdjacentPoints, ground::terracut_profile());
  }
  if (name == "terracut") return MethodConfig{.segmenter = ground::terracut_profile()};
  if (name == "terracut_road") {
    MethodConfig config{.segmenter = ground::terracut_profile()};
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

ground::MethodMaker maker_of(const MethodConfig& config) {
  switch (config.kind) {
    case MethodKind::kPfaff:
      return maker<FixedGridElevationMap>(config.pfaff);
    case MethodKind::kBogoslavskyi:
      return maker<ColumnAngles>(config.bogoslavskyi);
    case MethodKind::kZhang:
      return maker<HeightFieldMrf>(config.zhang);
    case MethodKind::kSegmenter:
      break;
  }
  return ground::maker_of(config.segmenter);
}

ground::TurnMethodMaker turn_maker_of(const MethodConfig& config) {
  if (config.kind == MethodKind::kSegmenter) return ground::turn_maker_of(config.segmenter);
  return ground::closed_turns_of(maker_of(config));
}

}  // namespace terracut::baselines
