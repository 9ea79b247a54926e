// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "health_reporter.hpp"

#include <utility>

#include "pipeline/health/health_frames.hpp"

namespace terracut::health {

HealthReporter::HealthReporter(std::string bus, can::CanSender sender)
    : bus_(std::move(bus)), sender_(std::move(sender)) {}

void HealthReporter::work_round(const status::MonitorSnapshot& figures,
                                const status::FrameRecord& newest, std::int64_t now_ns) noexcept {
  if (figures.frames == reported_frames_ && now_ns < next_report_ns_) return;
  reported_frames_ = figures.frames;
  next_report_ns_ = now_ns + kLongestSilence_ns;
  HealthReport report = health_report_of(figures, newest);
  report.alive = alive_++;
  sender_.send(health_frames(report));
  if (figures.sight.is_watched == 0) return;
  const can::CanFrame sight = sight_frame(figures.sight, report.alive);
  sender_.send({&sight, 1});
}

void HealthReporter::show(status::HealthFigures& figures) const noexcept {
  const can::CanSendCounters& counters = sender_.counters();
  figures = {.bus = bus_,
             .sent = counters.sent,
             .queue_full = counters.queue_full,
             .link_down = counters.link_down,
             .failed = counters.failed};
}

}  // namespace terracut::health
