// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>
#include <string_view>

namespace terracut::cli {

/// Whether the Host header of a request names this machine in a way that no foreign web page can:
/// by an address in numbers, as localhost, or as `own_name`, with a port or without. A page whose
/// own name was made to lead here (DNS rebinding) sends that name. An empty header is well:
/// browsers always send one.
[[nodiscard]] bool names_this_machine(std::string_view host_header, std::string_view own_name);

/// As the system calls itself; empty when it does not say.
[[nodiscard]] std::string own_host_name();

}  // namespace terracut::cli
