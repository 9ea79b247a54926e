// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "chosen_frames.hpp"
#include "frame_pictures.hpp"
#include "measured_cells.hpp"

namespace terracut::evaluation::report {

/// Called after every frame that was worked at.
using OnFrame = std::function<void()>;

/// Fig. 13, 14: the truth and every method side by side. A frame that cannot be read is named with
/// the reason in its place.
[[nodiscard]] std::string comparison_section(const Json& evaluation,
                                             const std::vector<ChosenFrame>& frames,
                                             FramePictures& pictures, const OnFrame& on_frame);

/// Fig. 16, 17: the worst frames of method_in_question().
[[nodiscard]] std::string worst_section(const Json& evaluation,
                                        const std::vector<ChosenFrame>& frames,
                                        FramePictures& pictures, const OnFrame& on_frame);

}  // namespace terracut::evaluation::report
