// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "rt/owned_descriptor.hpp"

namespace terracut::firmware_io {

using rt::OwnedDescriptor;

}  // namespace terracut::firmware_io
