// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/threads/grant.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>

namespace terracut::threads {
namespace {

/// Returns one setcap command for both rights, because each setcap replaces the rights set before.
std::string setcap_command() {
  std::error_code error;
  const std::filesystem::path path = std::filesystem::read_symlink("/proc/self/exe", error);
  return "'sudo setcap cap_sys_nice,cap_ipc_lock+ep " +
         (error ? std::string("<the program>") : path.string()) + "'";
}

}  // namespace

std::string to_line(const Grant& grant) {
  if (grant.granted) return grant.asked + ": granted, " + grant.in_force;
  return grant.asked + ": refused (" + std::generic_category().message(grant.error_number) + "), " +
         grant.in_force + "; " + grant.mend;
}

bool all_granted(const std::vector<Grant>& grants) noexcept {
  return std::all_of(grants.begin(), grants.end(),
                     [](const Grant& grant) { return grant.granted; });
}

std::string mend_memory_lock() {
  return setcap_command() +
         ", or '<user> - memlock unlimited' in /etc/security/limits.conf and a new login; for a "
         "container '--cap-add IPC_LOCK --ulimit memlock=-1'";
}

std::string mend_real_time_priority() {
  return setcap_command() +
         ", or '<user> - rtprio 99' in /etc/security/limits.conf and a new login; for a container "
         "'--cap-add SYS_NICE' or '--ulimit rtprio=99'";
}

}  // namespace terracut::threads
