// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace terracut::eval {

/// Names the calling thread and puts it on cores[index] (threads::allowed_cores()), beginning anew
/// behind the last one. Where that is refused, only the accuracy of times suffers.
void pin_this_thread(const std::string& name, const std::vector<int>& cores, std::size_t index);

}  // namespace terracut::eval
