// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "firmware_io/cloud/cloud.hpp"
#include "rt/error.hpp"
#include "terracut/segmenter.hpp"

namespace terracut {

/// Takes the points out of a driver's memory into `cloud`, whose buffers are reused; not installed.
/// kMalformed, saying what is missing.
[[nodiscard]] Status unpack(const PointBuffer& buffer, cloud::Cloud& cloud);

}  // namespace terracut
