// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "sight_watch.hpp"

#include <algorithm>

namespace terracut::visibility {

SightWatch::SightWatch(const mount::RingProfile& profile, frame::ImageShape shape,
                       memory::FixedMemory& memory)
    : is_counter_clockwise_(mount::is_upside_down(profile.mount)),
      visibility_({}, profile, shape, memory) {
  figures_.is_watched = 1;
}

void SightWatch::look(const frame::RangeImage& image, const stage::CellPlanes& planes,
                      bool is_whole) noexcept {
  if (!is_whole) {
    ++figures_.left_out_turns;
    return;
  }
  const bool is_learning = !visibility_.has_learnt();
  visibility_.look(image, planes);
  figures_.has_learnt = visibility_.has_learnt() ? 1 : 0;
  std::ranges::transform(visibility_.sectors(), figures_.sectors.begin(),
                         [](const Visibility::Sector& sector) -> SightFigures::Sector {
                           return {.condition = sector.condition,
                                   .has_view = sector.has_view ? std::uint8_t{1} : std::uint8_t{0},
                                   .visible_m = sector.now.visible_m};
                         });
  if (is_counter_clockwise_) std::ranges::reverse(figures_.sectors);
  if (is_learning) {
    ++figures_.learning_turns;
  } else {
    ++figures_.turns[static_cast<std::size_t>(visibility_.worst().cause)];
  }
}

}  // namespace terracut::visibility
