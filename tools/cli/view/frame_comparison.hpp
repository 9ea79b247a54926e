// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "firmware_io/frame/label.hpp"
#include "tools/lab/quality/quality.hpp"

namespace terracut::cli {

/// What the labels of all frames of a run are compared with.
struct ComparedWith {
  bool truth = false;
  std::string name;    ///< Of the method's parameters, for people.
  std::string beside;  ///< Of the second set of parameters; empty: there is none.

  [[nodiscard]] bool any() const noexcept { return truth || !beside.empty(); }
};

/// What the labels of one frame are compared with, and how they compare.
struct FrameComparison {
  /// A byte for each return: bits 0 and 1 its quality::TruthClass (kIgnored without truth), bits 2
  /// and 3 its frame::Label by the second set of parameters (kNone without). Empty if there is
  /// neither.
  std::vector<std::uint8_t> of_returns;
  std::optional<quality::Quality> quality, quality_beside;  ///< Set where there is truth.
  std::uint64_t differing = 0;  ///< Returns with another label by the second set.
};

/// Compares the labels of a frame with those beside them and with its truth (SemanticKITTI ids), by
/// return index; either may be empty.
void compare(std::span<const frame::Label> labels, std::span<const frame::Label> beside,
             std::span<const std::uint32_t> truth, FrameComparison& comparison);

}  // namespace terracut::cli
