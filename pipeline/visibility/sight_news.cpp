// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "sight_news.hpp"

#include <fmt/format.h>

namespace terracut::visibility {

SightNews::News SightNews::look(const SightFigures& figures, std::int64_t now_ns) {
  const Condition worst = figures.worst();
  const bool was_trouble = told_.state != State::kClear;
  if (worst.state == State::kClear) {
    if (!was_trouble || now_ns - newest_ns_ < kOver_ns) return {};
    told_ = {};
    return {fmt::format("the sensor's view is clear again; it was not for {:.1f} s",
                        static_cast<double>(newest_ns_ - since_ns_) * 1e-9)};
  }
  newest_ns_ = now_ns;
  if (worst == told_) return {};
  if (!was_trouble) since_ns_ = now_ns;
  told_ = worst;
  return {"the sensor's view is " + sight_text(figures), true};
}

}  // namespace terracut::visibility
