// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "checks.hpp"

namespace terracut::doctor {

Findings examine(const SystemView& system, const Wishes& wishes) {
  return {
      check_machine(system),
      check_stolen_time(system),
      check_kernel(system),
      check_isolated_cores(system, wishes),
      check_tickless_cores(system, wishes),
      check_interrupts(system, wishes),
      check_governor(system),
      check_clock_source(system),
      check_huge_pages(system),
      check_swap(system),
      check_priority(system),
      check_locked_memory(system),
      check_raw_capture(system),
      check_realtime_share(system),
      check_interface(system, wishes),
      check_port(system, wishes),
      check_return_path(system, wishes),
      check_firewall(system, wishes),
      check_receive_buffer(system, wishes),
      check_interface_drops(system, wishes),
      check_socket_drops(system),
      check_time_sync(system),
  };
}

}  // namespace terracut::doctor
