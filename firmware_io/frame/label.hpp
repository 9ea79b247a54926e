// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "terracut/frame.hpp"

namespace terracut::frame {

using terracut::is_ground;
using terracut::Label;

}  // namespace terracut::frame
