// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "bus_text.hpp"

#include <fmt/format.h>

#include <utility>

#include "counts_text.hpp"

namespace terracut::cli {
namespace {

double ms(double ns) {
  return ns * 1e-6;
}

std::string clocks(const rt::MotionFigures& motion) {
  if (motion.taken_out > 0) {
    return fmt::format("newest sample {:+.1f} ms from a turn's end (mean; {:+.1f} to {:+.1f})",
                       ms(motion.mean_sample_after_turn_ns()),
                       ms(static_cast<double>(motion.least_sample_after_turn_ns)),
                       ms(static_cast<double>(motion.most_sample_after_turn_ns)));
  }
  return fmt::format("newest sample {:+.1f} ms from the newest turn's end",
                     ms(static_cast<double>(motion.newest_sample_after_turn_ns)));
}

}  // namespace

std::vector<std::string> motion_lines(const rt::MotionFigures& motion) {
  if (motion.bus.empty()) return {};
  std::vector<std::string> lines{
      fmt::format("{} on {}: taken out of {} frames, no ego motion in {}", to_string(motion.state),
                  printable(motion.bus.view()), motion.taken_out, motion.no_ego_motion)};
  if (motion.newest_sample_after_turn_ns != 0 || motion.taken_out > 0) {
    lines.push_back(clocks(motion));
  }
  std::string faults = counts_text(motion.faults_in_use());
  if (!faults.empty()) lines.push_back(std::move(faults));
  return lines;
}

std::string health_line(const rt::HealthFigures& health) {
  if (health.bus.empty()) return {};
  std::string line =
      fmt::format("{} CAN frames sent on {}", health.sent, printable(health.bus.view()));
  for (const auto& [why, count] :
       {std::pair{"queue full", health.queue_full}, std::pair{"link down", health.link_down},
        std::pair{"refused", health.failed}}) {
    if (count > 0) line += fmt::format(", {} left out: {}", count, why);
  }
  return line;
}

}  // namespace terracut::cli
