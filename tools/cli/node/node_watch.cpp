// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "node_watch.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "pipeline/status/figure_lines.hpp"
#include "pipeline/status/loss_causes.hpp"
#include "rt/measure/milliseconds.hpp"
#include "rt/measure/thread_cpu_clock.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/live/live_watch.hpp"

namespace terracut::cli {

NodeWatch::NodeWatch(const Options& options, const std::string& input, NodeNews& news)
    : news_(news),
      monitor_({.deadline_ns = static_cast<std::int64_t>(options.deadline_ms * 1e6),
                .stage_names = stage::kStageNames},
               memory_),
      display_(options.watch),
      service_(LiveService::from_environment()) {
  status::MonitorSnapshot& figures = monitor_.snapshot();
  figures.version = {TERRACUT_VERSION};
  figures.sensor = {"waiting for clouds"};
  figures.input = {input};
  figures.started_ns = measure::realtime_ns();
  display_.show(figures);
  service_.ready(figures, measure::monotonic_ns());
}

void NodeWatch::work_round(std::uint64_t lost) {
  lost_ = lost;
  NodeNews::State state = news_.look();
  status::MonitorSnapshot& figures = monitor_.snapshot();
  for (status::FrameRecord& record : state.records) {
    monitor_.judge(record);
    look_at_pace(record);
  }
  figures.taken_ns = measure::realtime_ns();
  monitor_.look_at_rate(figures.taken_ns);
  if (!state.sensor.empty()) figures.sensor = {state.sensor};
  figures.mount = state.mount;
  show_input(state, figures);
  figures.loss_count = 0;
  status::show_losses(state.losses, figures);
  const std::uint64_t skipped = figures.levels[static_cast<std::size_t>(status::Level::kSkipped)];
  status::show_losses(std::array{status::NamedCount{"lost_clouds", lost},
                                 status::NamedCount{"lost_messages", lost_messages()},
                                 status::NamedCount{"skipped_frames", skipped}},
                      figures);
  display_.add_losses(figures);
  display_.show(figures);
  service_.work_round(figures, measure::monotonic_ns());
}

void NodeWatch::look_at_pace(const status::FrameRecord& record) {
  constexpr std::size_t kEnough = 20;
  const bool is_first_cloud = record.info.last_packet_ns == 0;  // the deadline does not apply to it
  if (is_first_cloud || record.level == status::Level::kSkipped || paces_ns_.size() == kEnough) {
    return;
  }
  paces_ns_.push_back(std::max<std::int64_t>(record.labels_ns - record.handed_over_ns, 1));
  if (paces_ns_.size() < kEnough) return;
  std::ranges::sort(paces_ns_);
  const double each_ms = measure::milliseconds(paces_ns_[kEnough / 2]);
  say(fmt::format(
      "a cloud is read and labelled in {:.1f} ms: up to {:.0f} a second can be answered "
      "here",
      each_ms, 1000 / each_ms));
}

void NodeWatch::show_input(const NodeNews::State& state, status::MonitorSnapshot& figures) {
  constexpr std::int64_t kSilence_ns = 1'000'000'000;
  figures.packets = figures.received = state.clouds;
  if (state.last_cloud_ns == 0) return;
  const bool silent = figures.taken_ns - state.last_cloud_ns > kSilence_ns;
  const auto link = silent ? status::LinkState::kSilent : status::LinkState::kReceiving;
  if (silent && figures.link == status::LinkState::kReceiving) ++figures.silences;
  figures.link = link;
  figures.last_packet_ns = state.last_cloud_ns;
}

std::string NodeWatch::why_no_frames() const {
  const status::MonitorSnapshot& figures = monitor_.snapshot();
  if (figures.packets == 0) return "no cloud was labelled, because none came";
  return fmt::format("no cloud was labelled of {} that came: {}", figures.packets,
                     status::counts_text(figures.losses_in_use()));
}

}  // namespace terracut::cli
