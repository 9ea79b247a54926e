// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "rt/error.hpp"

namespace terracut::cli {

/// Decides what it means that the truth of a viewed frame could not be read.
class TruthDoubt {
 public:
  /// `refuses`: truth that does not fit is an error, if none fitted before, as it is that of
  /// another recording.
  explicit TruthDoubt(bool refuses) : refuses_(refuses) {}

  /// Judges the reading of a whole frame's truth. Fails with its error if that is to be refused;
  /// otherwise the frame is shown without truth, of which the first is reported.
  [[nodiscard]] Status judge(const Status& read);

 private:
  bool refuses_, has_warned_ = false;
};

}  // namespace terracut::cli
