// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "finding.hpp"
#include "system_view.hpp"

/// The checks of `terracut doctor`. Each checks one thing, only reads, and returns one finding. A
/// check that cannot find out says so; that counts as no problem.
namespace terracut::doctor {

/// What the run to be checked for will need.
struct Requests {
  std::string interface{};  ///< The sensor's interface; empty: all that are up, except loopback.
  std::uint16_t port = 2368;
  std::int64_t buffer_bytes = 8 << 20;  ///< Requested receive buffer.
  std::optional<int> core{};            ///< The core of the labelling thread.
};

// Checks of the kernel and its settings (checks_kernel.cpp).
[[nodiscard]] Finding check_kernel(const SystemView& system);
[[nodiscard]] Finding check_machine(const SystemView& system);  ///< Real or virtual.
[[nodiscard]] Finding check_stolen_time(const SystemView& system);
[[nodiscard]] Finding check_clock_source(const SystemView& system);
[[nodiscard]] Finding check_time_sync(const SystemView& system);

// Checks of the user's rights (checks_rights.cpp).
[[nodiscard]] Finding check_priority(const SystemView& system);
[[nodiscard]] Finding check_locked_memory(const SystemView& system);
[[nodiscard]] Finding check_raw_capture(const SystemView& system);
[[nodiscard]] Finding check_realtime_share(const SystemView& system);

// Checks for disturbances of the threads (checks_processor.cpp).
[[nodiscard]] Finding check_governor(const SystemView& system);
[[nodiscard]] Finding check_isolated_cores(const SystemView& system, const Requests& requests);
[[nodiscard]] Finding check_tickless_cores(const SystemView& system, const Requests& requests);
[[nodiscard]] Finding check_swap(const SystemView& system);
[[nodiscard]] Finding check_huge_pages(const SystemView& system);

// Checks of the path on which packets arrive (checks_network.cpp).
[[nodiscard]] Finding check_interface(const SystemView& system, const Requests& requests);
[[nodiscard]] Finding check_receive_buffer(const SystemView& system, const Requests& requests);
[[nodiscard]] Finding check_interrupts(const SystemView& system, const Requests& requests);
[[nodiscard]] Finding check_interface_drops(const SystemView& system, const Requests& requests);
[[nodiscard]] Finding check_socket_drops(const SystemView& system);
[[nodiscard]] Finding check_port(const SystemView& system, const Requests& requests);
[[nodiscard]] Finding check_return_path(const SystemView& system, const Requests& requests);
[[nodiscard]] Finding check_firewall(const SystemView& system, const Requests& requests);

/// Runs all checks, in the order of docs/guide/real_time.md.
[[nodiscard]] Findings examine(const SystemView& system, const Requests& requests);

/// True if this process has a capability, by its number in <linux/capability.h>.
[[nodiscard]] bool has_capability(const SystemView& system, int capability);

}  // namespace terracut::doctor
