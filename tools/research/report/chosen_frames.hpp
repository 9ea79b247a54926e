// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace terracut::report {

using Json = nlohmann::ordered_json;

/// A frame to be shown.
struct ChosenFrame {
  std::string sequence, frame;
  std::string why;  ///< "middle", "lowest Recall_o"; for people.
};

/// Returns the method whose worst frames are shown: `terracut` if measured, otherwise the first.
[[nodiscard]] std::string method_in_question(const Json& evaluation);

/// In the functions below `method` is one of the evaluation's `methods`; its frames are ordered by
/// sequence.

/// Returns the middle frame of every sequence.
[[nodiscard]] std::vector<ChosenFrame> middle_frames(const Json& method);
/// Returns each sequence's frame with the lowest Recall_o and its frame with the lowest IoU_g (all
/// ground), which may be the same. Of equal frames the first counts. An undefined measure is never
/// the lowest.
[[nodiscard]] std::vector<ChosenFrame> worst_frames(const Json& method);

}  // namespace terracut::report
