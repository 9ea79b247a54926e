// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "http_host.hpp"

#include <arpa/inet.h>
#include <strings.h>
#include <unistd.h>

#include <array>

namespace terracut::cli {
namespace {

bool is_address(const std::string& text) {
  std::array<unsigned char, sizeof(::in6_addr)> ignored{};
  const bool in_brackets = text.size() > 2 && text.front() == '[' && text.back() == ']';
  if (!in_brackets) return ::inet_pton(AF_INET, text.c_str(), ignored.data()) == 1;
  return ::inet_pton(AF_INET6, text.substr(1, text.size() - 2).c_str(), ignored.data()) == 1;
}

bool is_port(std::string_view text) {
  return !text.empty() && text.size() <= 5 &&
         text.find_first_not_of("0123456789") == std::string_view::npos;
}

bool is_same_name(const std::string& a, std::string_view b) {
  return a.size() == b.size() && ::strncasecmp(a.data(), b.data(), a.size()) == 0;
}

}  // namespace

bool names_this_machine(std::string_view host_header, std::string_view own_name) {
  if (host_header.empty()) return true;
  const auto bracket = host_header.find(']');
  const auto colon = host_header.find(':', bracket == std::string_view::npos ? 0 : bracket);
  if (colon != std::string_view::npos && !is_port(host_header.substr(colon + 1))) return false;
  const std::string host(host_header.substr(0, colon));
  return is_address(host) || is_same_name(host, "localhost") ||
         (!own_name.empty() && is_same_name(host, own_name));
}

std::string own_host_name() {
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) != 0) return {};
  return name.data();
}

bool is_own_origin(std::string_view origin, std::string_view host) {
  if (origin.empty()) return true;
  constexpr std::string_view kScheme = "http://";
  return origin.starts_with(kScheme) && origin.substr(kScheme.size()) == host;
}

bool is_asked_by_foreign_page(const HttpRequest& request) {
  if (!is_own_origin(request.origin, request.host)) return true;
  const std::string_view site = request.fetch_site;
  if (site.empty() || site == "same-origin" || site == "none") return false;
  return request.fetch_mode != "navigate" || request.method != "GET";
}

bool is_asked_by_own_page_or_program(const HttpRequest& request) {
  return !request.page.empty() || !request.user_agent.starts_with("Mozilla/");
}

}  // namespace terracut::cli
