// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/publish/publisher.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace terracut::publish {

/// Returns the number of buffers: as many as the longest queue holds, one that each output works
/// on, and one that is being filled.
std::size_t Publisher::buffers_for(const Sinks& sinks) noexcept {
  std::size_t longest = 0;
  for (const auto& sink : sinks) longest = std::max(longest, sink->queue_frames());
  return longest + sinks.size() + 1;
}

Publisher::Publisher(Sinks sinks, WhenFull when_full, SinkWorker::OnFailure on_failure)
    : buffers_(buffers_for(sinks)) {
  for (auto& sink : sinks) {
    workers_.push_back(std::make_unique<SinkWorker>(std::move(sink), when_full, on_failure));
  }
}

void Publisher::put(const SharedFrame& frame) {
  for (const auto& worker : workers_) worker->put(frame);
}

bool Publisher::wants_sectors() const noexcept {
  return std::ranges::any_of(workers_,
                             [](const auto& worker) { return worker->sink().wants_sectors(); });
}

void Publisher::put_sector(const SharedSector& sector) {
  for (const auto& worker : workers_) {
    if (worker->sink().wants_sectors()) worker->put_sector(sector);
  }
}

void Publisher::put_figures(const status::MonitorSnapshot& figures) {
  if (workers_.empty()) return;
  const auto shared = std::make_shared<const status::MonitorSnapshot>(figures);
  for (const auto& worker : workers_) worker->put_figures(shared);
}

bool Publisher::finish(std::optional<std::chrono::milliseconds> patience) {
  for (const auto& worker : workers_) worker->begin_to_finish();
  constexpr std::chrono::hours kAsLongAsItTakes{24 * 365};
  return std::ranges::all_of(workers_, [&](const auto& worker) {
    const auto to_do = [&] { return worker->waiting() + worker->sectors_waiting(); };
    std::uint64_t before = to_do();
    while (!worker->ends_within(patience.value_or(kAsLongAsItTakes))) {
      const std::uint64_t now = to_do();
      if (now == before) return false;
      before = now;
    }
    return true;
  });
}

Status Publisher::outcome() const {
  for (const auto& worker : workers_) {
    if (const auto failure = worker->failure()) return tl::unexpected(*failure);
  }
  return {};
}

std::vector<status::NamedCount> Publisher::losses(bool over) const {
  std::vector<status::NamedCount> losses;
  for (const auto& worker : workers_) {
    const std::string name = fmt::format("{}_frames_left_out", worker->sink().name());
    losses.push_back({{name}, worker->left_out() + (over ? worker->waiting() : 0)});
    if (worker->sink().wants_sectors()) {
      losses.push_back({{fmt::format("{}_sectors_left_out", worker->sink().name())},
                        worker->sectors_left_out() + (over ? worker->sectors_waiting() : 0)});
    }
    std::ranges::move(worker->sink().losses(), std::back_inserter(losses));
  }
  return losses;
}

}  // namespace terracut::publish
