// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "live_watch.hpp"

#include <string>
#include <utility>

#include "firmware_io/can/can_socket.hpp"
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

LiveWatch::LiveWatch(const LiveOptions& options, const calib::Mount& mount, LiveThreads& threads,
                     VehicleMotion* motion, FiguresDisplay& display, rt::FixedMemory& memory)
    : options_(options),
      threads_(threads),
      motion_(motion),
      display_(display),
      mount_(std::make_unique<MountWatch>(mount)),
      monitor_({.deadline_ns = static_cast<std::int64_t>(options.deadline_ms * 1e6),
                .stage_names = kStageNames,
                .kept_frames = kKeptFrames},
               memory) {
  if (auto stolen = rt::StolenTime::open()) stolen_.emplace(*std::move(stolen));
}

void LiveWatch::open(const std::string& sensor, const std::string& input,
                     const StreamWriter* stream) {
  stream_ = stream;
  rt::MonitorSnapshot& figures = monitor_.snapshot();
  figures.version = {TERRACUT_VERSION};
  figures.sensor = {sensor};
  figures.input = {input};
  figures.started_ns = rt::realtime_ns();
  if (motion_ != nullptr) figures.motion.bus = {options_.can};
  if (!options_.watch.health_can.empty()) open_health();
  refresh();
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
    const std::int64_t latency_ns = timing.labels_ns - timing.last_packet_ns;
    if (stolen_ && latency_ns > monitor_.snapshot().deadline_ns) {
      timing.steal_ns = stolen_->since(timing.last_packet_ns, rt::realtime_ns());
    }
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
  if (stolen_) stolen_->turn_round(figures.taken_ns);
  refresh_link(figures);
  refresh_losses(figures);
  refresh_threads(figures);
  if (const pipeline::NearGround* ground = threads_.near_ground()) mount_->add_turn(*ground);
  figures.mount = mount_->figures();
  if (motion_ != nullptr) motion_->show(figures.motion);
  if (health_) {
    health_->turn_round(figures, rt::monotonic_ns());
    health_->show(figures.health);
  }
  display_.show(figures);
}

void LiveWatch::refresh_threads(rt::MonitorSnapshot& figures) {
  figures.thread_count = 0;
  show_thread(figures, "receive", threads_.receive_state());
  show_thread(figures, "segment", threads_.segment_state());
  if (motion_ != nullptr) show_thread(figures, "can", motion_->thread_state());
}

void LiveWatch::refresh_link(rt::MonitorSnapshot& figures) {
  constexpr std::int64_t kSilence_ns = 1'000'000'000;
  const Intake& intake = threads_.intake();
  show_datagrams(intake.account, figures);
  figures.head_stands = standing_head_.is_standing(intake.account);
  figures.blind_from_cdeg = intake.blind.from_cdeg;
  figures.blind_to_cdeg = intake.blind.to_cdeg;
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
  if (const std::string news = link_news_.look(figures); !news.empty()) say(news);
}

void LiveWatch::refresh_losses(rt::MonitorSnapshot& figures) {
  const firmware_io::DatagramAccount& account = threads_.intake().account;
  firmware_io::LossCounters losses = account.losses;
  losses.skipped_frames = figures.rungs[static_cast<std::size_t>(rt::Rung::kSkipped)];
  figures.loss_count = 0;
  show_losses(losses, figures);
  show_losses(account.source, figures);
  show_loss("let_go_packets", account.let_go, figures);
  show_loss("untimed_frames", threads_.timings_dropped(), figures);
  // At the end nothing waits any more that was not held up for good.
  const auto lost = [&](const auto* slots) {
    return slots->unused() + (over_ ? slots->waiting() : 0);
  };
  if (threads_.labels()) show_loss("unwritten_label_frames", lost(threads_.labels()), figures);
  if (threads_.points()) show_loss("unstreamed_frames", lost(threads_.points()), figures);
  if (stream_ == nullptr) return;
  const StreamWriter::Losses stream = stream_->losses();
  show_loss("stream_turns_missed", stream.missed, figures);
  show_loss("stream_turns_cut_short", stream.cut_short, figures);
  show_loss("stream_turns_too_large", stream.too_large, figures);
  show_loss("stream_readers_refused", stream.refused, figures);
  show_loss("stream_readers_stalled", stream.stalled, figures);
}

std::vector<rt::FrameTiming> LiveWatch::newest() const {
  std::vector<rt::FrameTiming> frames(kKeptFrames);
  frames.resize(monitor_.copy_newest(frames));
  return frames;
}

}  // namespace terracut::cli
