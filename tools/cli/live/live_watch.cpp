// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "live_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

#include "firmware_io/net/network_interface.hpp"
#include "pipeline/status/loss_causes.hpp"
#include "tools/cli/console.hpp"

namespace terracut::cli {
namespace {

void show_thread(status::MonitorSnapshot& figures, std::string_view name,
                 const live::LiveThreadState& state) {
  status::ThreadStatus& shown = figures.threads[figures.thread_count++];
  shown.name = {name};
  shown.scheduling = {state.scheduling};
  shown.minor_faults = static_cast<std::uint64_t>(state.minor_faults.load());
  shown.major_faults = static_cast<std::uint64_t>(state.major_faults.load());
}

/// Returns the name of what no output took: of a loss, unless nobody but viewers gets frames.
std::string unpublished_name(const Options& options, std::string_view what) {
  const OutputOptions& output = options.output;
  const bool are_kept =
      !options.stream.empty() || !output.mcap.path.empty() || output.dds.publishes;
  return fmt::format("{}_{}", are_kept ? "unpublished" : "unviewed", what);
}

}  // namespace

LiveWatch::LiveWatch(const Options& options, const mount::Mount& mount, const MountChoice& choice,
                     live::LiveParts& parts, FiguresDisplay& display)
    : options_(options),
      parts_(parts),
      display_(display),
      mount_(std::make_unique<MountWatch>(mount, choice)) {
  if (auto stolen = measure::StolenTime::open()) stolen_.emplace(*std::move(stolen));
}

void LiveWatch::open(const std::string& sensor, const std::string& input,
                     const live::FrameOutlet* outlet, publish::Publisher& publisher) {
  outlet_ = outlet;
  publisher_ = &publisher;
  status::MonitorSnapshot& figures = parts_.monitor.snapshot();
  figures.version = {TERRACUT_VERSION};
  figures.sensor = {sensor};
  figures.input = {input};
  figures.started_ns = measure::realtime_ns();
  if (parts_.motion) figures.motion.bus = {options_.can};
  if (!options_.watch.health_can.empty()) open_health();
  refresh();
}

void LiveWatch::open_health() {
  auto sender = can::CanSender::open(options_.watch.health_can, true);
  if (sender) {
    if (!sender->has_interface()) {
      warn(net::no_such_interface(options_.watch.health_can).message +
           "; it is waited for, and until then no health is sent");
    }
    health_.emplace(options_.watch.health_can, *std::move(sender));
  } else {
    warn("no health on a CAN bus: " + sender.error().message);
  }
}

LiveWatch::Round LiveWatch::work_round() {
  Round round;
  for (status::FrameRecord frame; parts_.thread.take_record(frame);) {
    const std::int64_t latency_ns = frame.labels_ns - frame.info.last_packet_ns;
    if (stolen_ && latency_ns > parts_.monitor.snapshot().deadline_ns) {
      frame.steal_ns = stolen_->since(frame.info.last_packet_ns, measure::realtime_ns());
    }
    parts_.monitor.judge(frame);
    ++round.frames;
    if (frame.missed) ++round.missed;
  }
  refresh();
  return round;
}

void LiveWatch::last_round() {
  over_ = true;
  (void)work_round();
}

void LiveWatch::refresh() {
  status::MonitorSnapshot& figures = parts_.monitor.snapshot();
  figures.taken_ns = measure::realtime_ns();
  if (stolen_) stolen_->work_round(figures.taken_ns);
  refresh_input(figures);
  parts_.monitor.look_at_rate(figures.taken_ns);
  refresh_losses(figures);
  refresh_threads(figures);
  if (const ground::NearGround* ground = parts_.thread.near_ground()) mount_->add_frame(*ground);
  figures.mount = mount_->figures();
  refresh_sight(figures);
  if (outlet_ != nullptr) figures.last_return_to_object = outlet_->object_waits();
  if (parts_.motion) parts_.motion->show(figures.motion);
  if (health_) {
    health_->work_round(figures, parts_.monitor.newest(), measure::monotonic_ns());
    health_->show(figures.health);
  }
  display_.show(figures);
  publish_figures();
}

void LiveWatch::publish_figures() {
  constexpr std::int64_t kEvery_ns = 1'000'000'000;
  const std::int64_t now_ns = measure::monotonic_ns();
  if (publisher_ == nullptr || now_ns < publish_figures_at_ns_) return;
  publish_figures_at_ns_ = now_ns + kEvery_ns;
  publisher_->put_figures(parts_.monitor.snapshot());
}

void LiveWatch::refresh_sight(status::MonitorSnapshot& figures) {
  if (outlet_ == nullptr) return;
  figures.sight = outlet_->sight();
  const auto news = sight_news_.look(figures.sight, figures.taken_ns);
  if (news.text.empty()) return;
  if (news.is_trouble) {
    warn(news.text);
  } else {
    say(news.text);
  }
  publish_figures_at_ns_ = 0;
}

void LiveWatch::refresh_threads(status::MonitorSnapshot& figures) {
  figures.thread_count = 0;
  show_thread(figures, "label", parts_.thread.state());
  if (parts_.motion) show_thread(figures, "can", parts_.motion->thread_state());
}

void LiveWatch::refresh_input(status::MonitorSnapshot& figures) {
  const std::string news = input_.show(parts_.thread.intake(), figures);
  if (!news.empty()) say(news);
}

void LiveWatch::refresh_losses(status::MonitorSnapshot& figures) {
  const net::DatagramAccount& account = parts_.thread.intake().account;
  frame::LossCounters losses = account.losses;
  losses.skipped_frames = figures.levels[static_cast<std::size_t>(status::Level::kSkipped)];
  figures.loss_count = 0;
  status::show_losses(status::causes_of(losses), figures);
  status::show_losses(status::causes_of(account.source), figures);
  std::vector<status::NamedCount> more{{"let_go_packets", account.let_go},
                                       {"untimed_frames", parts_.thread.records_dropped()},
                                       {"lost_messages", lost_messages()}};
  // Frames that still wait when the run is over are lost as well.
  const auto lost = [&](const auto* slots) {
    return slots->unused() + (over_ ? slots->waiting() : 0);
  };
  if (parts_.thread.labels())
    more.push_back({"unwritten_label_frames", lost(parts_.thread.labels())});
  if (parts_.thread.points())
    more.push_back({unpublished_name(options_, "frames"), lost(parts_.thread.points())});
  if (parts_.thread.sectors())
    more.push_back({unpublished_name(options_, "sectors"), lost(parts_.thread.sectors())});
  if (outlet_ != nullptr && outlet_->has_stream()) {
    const stream::FrameStreamFigures& stream = outlet_->figures();
    more.insert(more.end(), {{"stream_frames_missed", stream.missed},
                             {"stream_frames_cut_short", stream.cut_short},
                             {"stream_frames_too_large", stream.frames_too_large},
                             {"stream_readers_refused", stream.refused},
                             {"stream_readers_stalled", stream.stalled},
                             {"stream_frames_while_closed", outlet_->frames_while_closed()}});
    if (options_.stream_sectors) {
      more.insert(more.end(), {{"stream_sectors_missed", stream.sectors_missed},
                               {"stream_sectors_while_closed", outlet_->sectors_while_closed()}});
    }
  }
  if (publisher_ != nullptr) std::ranges::move(publisher_->losses(over_), std::back_inserter(more));
  status::show_losses(more, figures);
  display_.add_losses(figures);
}

std::vector<status::FrameRecord> LiveWatch::newest() const {
  std::vector<status::FrameRecord> frames(live::LiveParts::kKeptFrames);
  frames.resize(parts_.monitor.copy_newest(frames));
  return frames;
}

}  // namespace terracut::cli
