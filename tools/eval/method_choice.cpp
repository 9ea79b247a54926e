// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "method_choice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>

namespace terracut::evaluation {
namespace {

constexpr std::array<std::string_view, 4> kNames{"ring_map", "ring_map_adjacent", "paper",
                                                 "terracut"};

pipeline::SegmenterConfig paper_up_to(pipeline::Stage last) {
  pipeline::SegmenterConfig config = pipeline::paper_profile();
  config.last_stage = last;
  return config;
}

}  // namespace

std::span<const std::string_view> method_names() noexcept {
  return kNames;
}

Expected<MethodChoice> method_named(std::string_view name) {
  using pipeline::Stage;
  if (name == "ring_map") {
    return MethodChoice{"ring_map", "Ring-based elevation map", paper_up_to(Stage::kElevationMap)};
  }
  if (name == "ring_map_adjacent") {
    return MethodChoice{"ring_map_adjacent", "+ spatiotemporal adjacent points",
                        paper_up_to(Stage::kAdjacentPoints)};
  }
  if (name == "paper") {
    return MethodChoice{"paper", "+ MRF: the method as printed", pipeline::paper_profile()};
  }
  if (name == "terracut") {
    return MethodChoice{"terracut", "The default profile", pipeline::terracut_profile()};
  }
  return fail(ErrorCode::kInvalidArgument,
              fmt::format("there is no method '{}'; expected {}", name, fmt::join(kNames, ", ")));
}

}  // namespace terracut::evaluation
