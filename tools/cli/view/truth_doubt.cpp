// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "truth_doubt.hpp"

#include <utility>

#include "tools/cli/console.hpp"

namespace terracut::cli {

Status TruthDoubt::judge(const Status& read) {
  if (read) {
    refuses_ = false;
    return {};
  }
  if (refuses_ && read.error().code != ErrorCode::kNotFound) return read;
  if (!std::exchange(has_warned_, true)) {
    warn("frames without fitting truth are shown without; the first: " + read.error().message);
  }
  return {};
}

}  // namespace terracut::cli
