// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>
#include <string_view>

#include "http_exchange.hpp"

namespace terracut::cli {

/// True if the Host header of a request names this machine in a way that no foreign web page can:
/// by a numeric address, as localhost, or as `own_name`, with or without a port. A page whose own
/// name was made to lead here (DNS rebinding) sends that name. An empty header is accepted:
/// browsers always send one.
[[nodiscard]] bool names_this_machine(std::string_view host_header, std::string_view own_name);

/// Returns the system's own name; empty if unknown.
[[nodiscard]] std::string own_host_name();

/// True if a browser's Origin header is that of a page from this server, as in Host; also if it is
/// empty: not a browser's, or a page that asks its own server.
[[nodiscard]] bool is_own_origin(std::string_view origin, std::string_view host);

/// True if a page from another server makes its browser ask. A link that leads here is harmless:
/// whoever follows it sees a page of this server.
[[nodiscard]] bool is_asked_by_foreign_page(const HttpRequest& request);

/// True for this server's own page, or a program without pages. Browsers name the source of a
/// request only to trusted addresses, and Origin not in every request; but a foreign page cannot
/// send the header X-Terracut-Page.
[[nodiscard]] bool is_asked_by_own_page_or_program(const HttpRequest& request);

}  // namespace terracut::cli
