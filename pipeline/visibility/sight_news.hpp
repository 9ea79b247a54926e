// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <string>

#include "pipeline/visibility/sight_figures.hpp"

namespace terracut::visibility {

/// Reports when the worst condition of a sensor's view becomes another one, and when the view is
/// clear again. What comes and goes, as rain does, is one trouble: it is over when it has been away
/// for kOver_ns. One thread; reads no clock.
class SightNews {
 public:
  static constexpr std::int64_t kOver_ns = 5'000'000'000;

  struct News {
    std::string text;         ///< A sentence; empty: there is nothing new.
    bool is_trouble = false;  ///< False: a trouble is over.
  };
  /// `now_ns` are nanoseconds of any clock.
  [[nodiscard]] News look(const SightFigures& figures, std::int64_t now_ns);

 private:
  Condition told_;              ///< The last that was reported.
  std::int64_t since_ns_ = 0;   ///< When the trouble began.
  std::int64_t newest_ns_ = 0;  ///< When it was there last.
};

}  // namespace terracut::visibility
