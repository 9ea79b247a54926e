// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "calib/ring_profile.hpp"
#include "pipeline/profile.hpp"
#include "pipeline/segmenter.hpp"
#include "rt/error.hpp"

namespace terracut::evaluation {

/// A way of labelling that can be chosen by name.
struct MethodChoice {
  std::string name;   ///< "terracut"
  std::string about;  ///< For reports: "Ring-based elevation map"
  pipeline::SegmenterConfig config;
};

/// The names `method_named()` knows, in the order reports show them.
[[nodiscard]] std::span<const std::string_view> method_names() noexcept;

/// kInvalidArgument, naming those there are, for any other name.
[[nodiscard]] Expected<MethodChoice> method_named(std::string_view name);

}  // namespace terracut::evaluation
