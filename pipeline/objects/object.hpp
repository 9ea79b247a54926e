// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "terracut/object.hpp"

namespace terracut::objects {

using terracut::Box;
using terracut::Corner;
using terracut::Footprint;
using terracut::Object;

}  // namespace terracut::objects
