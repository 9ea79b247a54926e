// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace terracut::report {

using Json = nlohmann::ordered_json;

/// A frame that is shown.
struct ChosenFrame {
  std::string sequence, frame;
  std::string why;  ///< "middle", "lowest Recall_o"; for people.
};

/// Whose worst frames are shown: `terracut` where it was measured, else the first method.
[[nodiscard]] std::string method_in_question(const Json& evaluation);

/// `method`: one of `methods` of the evaluation, whose frames lie sequence by sequence.

/// The middle frame of every sequence.
[[nodiscard]] std::vector<ChosenFrame> middle_frames(const Json& method);
/// Of every sequence the frames with the lowest Recall_o and the lowest IoU_g (all ground): two, or
/// one that is both; the first of equals. Frames where a measure is not defined are not its worst.
[[nodiscard]] std::vector<ChosenFrame> worst_frames(const Json& method);

}  // namespace terracut::report
