// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace terracut::eval {

/// Names the calling thread and pins it to cores[index modulo their number]
/// (threads::allowed_cores()). If the system refuses, only times become less accurate.
void pin_this_thread(const std::string& name, const std::vector<int>& cores, std::size_t index);

}  // namespace terracut::eval
