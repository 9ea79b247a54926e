// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>
#include <string_view>

#include "http_exchange.hpp"

namespace terracut::cli {

/// Whether the Host header of a request names this machine in a way that no foreign web page can:
/// by an address in numbers, as localhost, or as `own_name`, with a port or without. A page whose
/// own name was made to lead here (DNS rebinding) sends that name. An empty header is well:
/// browsers always send one.
[[nodiscard]] bool names_this_machine(std::string_view host_header, std::string_view own_name);

/// As the system calls itself; empty when it does not say.
[[nodiscard]] std::string own_host_name();

/// Whether a browser's Origin header is that of a page which this server sent, as Host says; empty:
/// no browser's, or a page that asks its own server.
[[nodiscard]] bool is_own_origin(std::string_view origin, std::string_view host);

/// Whether a page that this server did not send has its browser ask. That a link leads here is no
/// harm: whoever follows it sees a page of this server's.
[[nodiscard]] bool is_asked_by_foreign_page(const HttpRequest& request);

/// Whether it is this server's own page, or a program without pages. Browsers say where a request
/// comes from to addresses that they trust alone, and Origin not with every request; but the header
/// X-Terracut-Page is out of a foreign page's reach.
[[nodiscard]] bool is_asked_by_own_page_or_program(const HttpRequest& request);

}  // namespace terracut::cli
