// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "checks.hpp"

namespace terracut::doctor {

Findings examine(const SystemView& system, const Requests& requests) {
  return {
      check_machine(system),
      check_stolen_time(system),
      check_kernel(system),
      check_isolated_cores(system, requests),
      check_tickless_cores(system, requests),
      check_interrupts(system, requests),
      check_governor(system),
      check_clock_source(system),
      check_huge_pages(system),
      check_swap(system),
      check_priority(system),
      check_locked_memory(system),
      check_raw_capture(system),
      check_realtime_share(system),
      check_interface(system, requests),
      check_port(system, requests),
      check_return_path(system, requests),
      check_firewall(system, requests),
      check_receive_buffer(system, requests),
      check_interface_drops(system, requests),
      check_socket_drops(system),
      check_time_sync(system),
  };
}

}  // namespace terracut::doctor
