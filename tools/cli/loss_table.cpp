// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "loss_table.hpp"

#include <fmt/format.h>

#include <string_view>

namespace terracut::cli {

std::vector<LossCause> causes_of(const firmware_io::LossCounters& losses) {
  std::vector<LossCause> causes{{"kernel_drops", losses.kernel_drops},
                                {"network_gap_packets", losses.network_gap_packets},
                                {"azimuth_hole_columns", losses.azimuth_hole_columns}};
  for (std::size_t i = 0; i < firmware_io::kRejectReasons; ++i) {
    causes.push_back({fmt::format("rejected_{}", to_string(static_cast<firmware_io::Reject>(i))),
                      losses.rejected[i]});
  }
  causes.push_back({"overflow_full_returns", losses.overflow_full_returns});
  causes.push_back({"queue_full_frames", losses.queue_full_frames});
  causes.push_back({"skipped_frames", losses.skipped_frames});
  causes.push_back({"clock_jumps", losses.clock_jumps});
  return causes;
}

std::string loss_sentence(const firmware_io::LossCounters& losses) {
  std::string sentence;
  for (const LossCause& cause : causes_of(losses)) {
    if (cause.count == 0) continue;
    sentence += fmt::format("{}{} {}", sentence.empty() ? "" : ", ", cause.name, cause.count);
  }
  return sentence.empty() ? "none" : sentence;
}

void show_losses(const firmware_io::LossCounters& losses, rt::MonitorSnapshot& figures) {
  static_assert(sizeof(firmware_io::LossCounters) / sizeof(std::uint64_t) <=
                rt::MonitorSnapshot::kMaxLosses);
  figures.loss_count = 0;
  for (const LossCause& cause : causes_of(losses)) {
    figures.losses[figures.loss_count++] = {std::string_view(cause.name), cause.count};
  }
}

}  // namespace terracut::cli
