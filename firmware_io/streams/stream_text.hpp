// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "rt/error.hpp"

/// Writes and reads VLANs and link-layer addresses as people write them; the numbers are those of
/// Datagram.
namespace terracut::streams {

/// Returns "10"; for stacked tags "100.10", the outermost first; "0" for none.
[[nodiscard]] std::string vlan_text(std::uint32_t vlan);
/// Parses vlan_text(). Fails with kInvalidArgument for anything else.
[[nodiscard]] Expected<std::uint32_t> parse_vlan(std::string_view text);

/// Returns "60:76:88:10:23:a1".
[[nodiscard]] std::string mac_text(std::uint64_t mac);
/// Parses mac_text() with digits of either case. Fails with kInvalidArgument for anything else.
[[nodiscard]] Expected<std::uint64_t> parse_mac(std::string_view text);

}  // namespace terracut::streams
