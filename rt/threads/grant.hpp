// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>
#include <vector>

namespace terracut::threads {

/// One request to the system at start-up (locked memory, a real-time priority, a core), and the
/// system's answer. A refusal does not stop the program. The program shows grants to those who
/// wonder why deadlines are missed.
struct Grant {
  std::string asked{};     ///< What was asked: "SCHED_FIFO priority 80".
  bool granted = false;    ///< Read back from the system where possible.
  int error_number = 0;    ///< errno of the refusal; 0 if granted.
  std::string in_force{};  ///< The setting that holds now: "SCHED_OTHER".
  std::string mend{};      ///< If refused: the command or setting that mends it, and why.
};

/// Returns a grant as one line for people: "SCHED_FIFO priority 80: refused (Operation not
/// permitted), runs as SCHED_OTHER; sudo setcap ...".
[[nodiscard]] std::string to_line(const Grant& grant);

[[nodiscard]] bool all_granted(const std::vector<Grant>& grants) noexcept;

/// Tells how to mend a refusal to lock memory.
[[nodiscard]] std::string mend_memory_lock();

/// Tells how to mend a refusal of a real-time priority.
[[nodiscard]] std::string mend_real_time_priority();

}  // namespace terracut::threads
