// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "dump_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "rt/status_page.hpp"
#include "tools/cli/console.hpp"

namespace terracut::cli {

using firmware_io::DumpReason;

DumpWriter::DumpWriter(const LiveOptions& options, firmware_io::FlightRecorder& recorder,
                       std::span<const std::string_view> stage_names)
    : recorder_(recorder),
      stage_names_(stage_names),
      policy_({.folder = {.folder = options.recorder.folder, .name = options.watch.name}}),
      answers_(rt::status_page_folder(), options.watch.name),
      thread_([this] { work(); }) {}

void DumpWriter::want(DumpReason reason, std::vector<rt::FrameTiming> frames) {
  {
    const std::scoped_lock lock(mutex_);
    wanted_[static_cast<std::size_t>(reason)] = true;
    frames_ = std::move(frames);
  }
  changed_.notify_one();
}

bool DumpWriter::finish(std::chrono::milliseconds patience) {
  {
    const std::scoped_lock lock(mutex_);
    finish_ = true;
  }
  changed_.notify_one();
  return thread_.ends_within(patience);
}

void DumpWriter::work() {
  while (true) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock,
                  [this] { return finish_ || std::ranges::find(wanted_, true) != wanted_.end(); });
    const auto wanted = std::exchange(wanted_, {});
    const auto frames = frames_;
    const bool last_round = finish_;
    lock.unlock();
    for (std::size_t reason = 0; reason < wanted.size(); ++reason) {
      if (wanted[reason]) dump(static_cast<DumpReason>(reason), frames);
    }
    if (last_round) return;
  }
}

void DumpWriter::dump(DumpReason reason, const std::vector<rt::FrameTiming>& frames) {
  const auto outcome = recorder_.dump(policy_, reason, {frames, stage_names_});
  if (outcome) {
    say(fmt::format("dumped {} datagrams to {}", outcome->datagrams, outcome->capture.string()));
  } else if (outcome.error().refusal != firmware_io::DumpRefusal::kTooSoon) {
    warn("not dumped: " + outcome.error().message);
  }
  if (reason != DumpReason::kAsked) return;
  if (const Status told = answers_.publish(outcome); !told) warn(told.error().message);
}

}  // namespace terracut::cli
