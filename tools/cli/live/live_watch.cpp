// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "live_watch.hpp"

#include <fmt/format.h>

#include <utility>

#include "firmware_io/can/can_socket.hpp"
#include "firmware_io/live/ipv4_endpoint.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/loss_table.hpp"

namespace terracut::cli {
namespace {

void show_thread(rt::MonitorSnapshot& figures, std::string_view name,
                 const LiveThreadState& state) {
  rt::ThreadStatus& shown = figures.threads[figures.thread_count++];
  shown.name = {name};
  shown.scheduling = {state.scheduling};
  shown.minor_faults = static_cast<std::uint64_t>(state.minor_faults.load());
  shown.major_faults = static_cast<std::uint64_t>(state.major_faults.load());
}

}  // namespace

LiveWatch::LiveWatch(const LiveOptions& options, LiveThreads& threads, VehicleMotion* motion,
                     rt::FixedMemory& memory)
    : options_(options),
      threads_(threads),
      motion_(motion),
      monitor_({.deadline_ns = static_cast<std::int64_t>(options.deadline_ms * 1e6),
                .stage_names = kStageNames,
                .kept_frames = kKeptFrames},
               memory),
      shown_(std::make_unique<rt::MonitorSnapshot>()) {}

void LiveWatch::open(const std::string& sensor, const std::string& input) {
  rt::MonitorSnapshot& figures = monitor_.snapshot();
  figures.version = {TERRACUT_VERSION};
  figures.sensor = {sensor};
  figures.input = {input};
  figures.started_ns = rt::realtime_ns();
  open_page();
  if (motion_ != nullptr) figures.motion.bus = {options_.can};
  if (options_.watch.metrics != "off") open_metrics();
  if (!options_.watch.health_can.empty()) open_health();
  refresh();
}

void LiveWatch::open_page() {
  auto page = rt::StatusPagePublisher<rt::MonitorSnapshot>::create(options_.watch.name,
                                                                   rt::MonitorSnapshot::kLayout);
  if (page) {
    page_.emplace(*std::move(page));
  } else {
    warn("no status page: " + page.error().message);
  }
}

void LiveWatch::open_metrics() {
  const auto at = firmware_io::parse_ipv4_endpoint(options_.watch.metrics);
  if (!at) {
    warn("no /metrics: " + at.error().message);
    return;
  }
  auto server = MetricsServer::start(firmware_io::ipv4_text(at->address), at->port,
                                     [this](rt::MonitorSnapshot& figures) {
                                       const std::scoped_lock lock(shown_mutex_);
                                       figures = *shown_;
                                       return true;
                                     });
  if (server) {
    metrics_.emplace(*std::move(server));
    say(fmt::format("figures at http://{}:{}/metrics", firmware_io::ipv4_text(at->address),
                    metrics_->port()));
  } else {
    warn("no /metrics: " + server.error().message);
  }
}

void LiveWatch::open_health() {
  auto sender = firmware_io::CanSender::open(options_.watch.health_can, true);
  if (sender) {
    if (!sender->has_interface()) {
      warn(firmware_io::no_such_can_interface(options_.watch.health_can).message +
           "; it is waited for, and until then no health is sent");
    }
    health_.emplace(options_.watch.health_can, *std::move(sender));
  } else {
    warn("no health on a CAN bus: " + sender.error().message);
  }
}

LiveWatch::Round LiveWatch::turn_round() {
  Round round;
  for (rt::FrameTiming timing; threads_.take_timing(timing);) {
    timing.published_ns = rt::realtime_ns();
    monitor_.judge(timing);
    ++round.frames;
    if (timing.missed) ++round.missed;
  }
  refresh();
  return round;
}

void LiveWatch::last_round() {
  over_ = true;
  (void)turn_round();
}

void LiveWatch::refresh() {
  rt::MonitorSnapshot& figures = monitor_.snapshot();
  figures.taken_ns = rt::realtime_ns();
  refresh_link(figures);
  refresh_losses(figures);
  refresh_threads(figures);
  if (motion_ != nullptr) motion_->show(figures.motion);
  if (health_) {
    health_->turn_round(figures, rt::monotonic_ns());
    health_->show(figures.health);
  }
  if (page_) page_->publish(figures);
  const std::scoped_lock lock(shown_mutex_);
  *shown_ = figures;
}

void LiveWatch::refresh_threads(rt::MonitorSnapshot& figures) {
  figures.thread_count = 0;
  show_thread(figures, "receive", threads_.receive_state());
  show_thread(figures, "segment", threads_.segment_state());
  if (motion_ != nullptr) show_thread(figures, "can", motion_->thread_state());
}

void LiveWatch::refresh_link(rt::MonitorSnapshot& figures) {
  constexpr std::int64_t kSilence_ns = 1'000'000'000;
  const LiveThreads::Intake& intake = threads_.intake();
  figures.packets = intake.counters.delivered;
  figures.last_packet_ns = intake.newest_packet_ns;
  if (intake.link == firmware_io::LinkState::kGone ||
      intake.link == firmware_io::LinkState::kDown) {
    figures.link = rt::LinkState::kInterfaceGone;
  } else if (figures.packets == 0) {
    figures.link = rt::LinkState::kWaiting;
  } else {
    const bool silent = figures.taken_ns - figures.last_packet_ns > kSilence_ns;
    figures.link = silent ? rt::LinkState::kSilent : rt::LinkState::kReceiving;
  }
}

void LiveWatch::refresh_losses(rt::MonitorSnapshot& figures) {
  firmware_io::LossCounters losses = threads_.losses();
  losses.skipped_frames = figures.rungs[static_cast<std::size_t>(rt::Rung::kSkipped)];
  figures.loss_count = 0;
  show_losses(losses, figures);
  show_losses(threads_.intake().counters, figures);
  show_loss("unjudged_frames", threads_.timings_dropped(), figures);
  // At the end nothing waits any more that was not held up for good.
  const auto lost = [&](const auto* slots) {
    return slots->unused() + (over_ ? slots->waiting() : 0);
  };
  if (threads_.labels()) show_loss("unwritten_label_frames", lost(threads_.labels()), figures);
  if (threads_.points()) show_loss("unstreamed_frames", lost(threads_.points()), figures);
}

std::vector<rt::FrameTiming> LiveWatch::newest() const {
  std::vector<rt::FrameTiming> frames(kKeptFrames);
  frames.resize(monitor_.copy_newest(frames));
  return frames;
}

}  // namespace terracut::cli
