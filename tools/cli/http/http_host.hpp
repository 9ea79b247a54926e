// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>
#include <string_view>

#include "http_exchange.hpp"

namespace terracut::cli {

/// True if a request's Host header names this machine in a way that no foreign web page can: by a
/// numeric address, as localhost, or as `own_name`, with or without a port. A foreign page whose
/// name was made to lead here (DNS rebinding) sends its own name. An empty header is accepted:
/// browsers always send one.
[[nodiscard]] bool names_this_machine(std::string_view host_header, std::string_view own_name);

/// Returns the system's host name; empty if unknown.
[[nodiscard]] std::string own_host_name();

/// True if a browser's Origin header names this server, as Host does. Also true if Origin is empty:
/// then no browser asks, or a page asks its own server.
[[nodiscard]] bool is_own_origin(std::string_view origin, std::string_view host);

/// True if a page of another server made the browser send the request. A followed link does not
/// count, because it shows a page of this server.
[[nodiscard]] bool is_asked_by_foreign_page(const HttpRequest& request);

/// True if the request comes from this server's own page, or from a program without pages. Browsers
/// state a request's source only to trusted addresses, and not every request has an Origin; but no
/// foreign page can send the header X-Terracut-Page.
[[nodiscard]] bool is_asked_by_own_page_or_program(const HttpRequest& request);

}  // namespace terracut::cli
