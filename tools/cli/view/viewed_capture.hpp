// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "player_command.hpp"

namespace terracut::cli {

/// The controls with which viewers play a recording. For any thread.
class ViewedCapture {
 public:
  ViewedCapture() = default;
  ViewedCapture(const ViewedCapture&) = delete;
  ViewedCapture& operator=(const ViewedCapture&) = delete;
  virtual ~ViewedCapture() = default;

  virtual void obey(const PlayerCommand& command) = 0;
  [[nodiscard]] virtual PlayerState state() const = 0;
};

}  // namespace terracut::cli
