// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/publish/diagnosis.hpp"

#include <fmt/format.h>

#include <string_view>

#include "pipeline/status/figure_lines.hpp"
#include "pipeline/status/figures.hpp"
#include "pipeline/status/loss_causes.hpp"
#include "rt/measure/milliseconds.hpp"

namespace terracut::publish {
namespace {

using Severity = Diagnosis::Severity;

std::string ms(std::int64_t ns) {
  return fmt::format("{:.3f}", measure::milliseconds(ns));
}

Diagnosis of_deadline(const status::MonitorSnapshot& f) {
  constexpr std::uint64_t kManyInARow = 3;
  Diagnosis deadline{.name = "terracut: deadline", .message = "frames are labelled in time"};
  if (f.consecutive_misses > 0) {
    deadline.level = f.consecutive_misses < kManyInARow ? Severity::kWarn : Severity::kError;
    deadline.message = fmt::format("{} deadlines missed in a row", f.consecutive_misses);
  } else if (f.frames == 0) {
    deadline.level = Severity::kStale;
    deadline.message = "no frame yet";
  }
  deadline.values = {{"deadline_ms", ms(f.deadline_ns)},
                     {"frames", std::to_string(f.frames)},
                     {"frames_per_second", fmt::format("{:.2f}", f.frames_per_s)},
                     {"latency_p50_ms", ms(f.latency.percentile_ns(50))},
                     {"latency_p99_ms", ms(f.latency.percentile_ns(99))},
                     {"missed", std::to_string(f.all_misses())}};
  for (std::size_t i = 0; i < f.misses.size(); ++i) {
    deadline.values.emplace_back(
        fmt::format("missed_{}", to_string(static_cast<status::FrameMissCause>(i))),
        std::to_string(f.misses[i]));
  }
  for (std::size_t i = 0; i < f.levels.size(); ++i) {
    deadline.values.emplace_back(fmt::format("level_{}", to_string(static_cast<status::Level>(i))),
                                 std::to_string(f.levels[i]));
  }
  return deadline;
}

Diagnosis of_input(const status::MonitorSnapshot& f) {
  Diagnosis input{.name = "terracut: input", .message = std::string(to_string(f.link))};
  if (f.head_stands != 0) {
    input.level = Severity::kError;
    input.message = "the sensor's head does not rotate";
  } else if (f.link == status::LinkState::kWaiting) {
    input.level = Severity::kStale;
  } else if (f.link != status::LinkState::kReceiving) {
    input.level = Severity::kError;
  }
  input.values = {{"from", std::string(f.input.view())},
                  {"packets", std::to_string(f.packets)},
                  {"datagrams_before_labelling", std::to_string(f.before_labelling)},
                  {"times_silent", std::to_string(f.silences)}};
  return input;
}

Diagnosis of_sight(const visibility::SightFigures& f) {
  const visibility::Condition worst = f.worst();
  Diagnosis sight{.name = "terracut: sight", .message = sight_text(f)};
  if (f.has_learnt == 0) {
    sight.level = Severity::kStale;
  } else if (worst.state != visibility::State::kClear) {
    sight.level = worst.state == visibility::State::kReduced ? Severity::kWarn : Severity::kError;
  }
  sight.values = {{"state", std::string(to_string(worst.state))},
                  {"cause", std::string(to_string(worst.cause))},
                  {"troubled_sectors", std::to_string(f.troubled_sectors())}};
  for (std::size_t i = 0; i < visibility::kDirections; ++i) {
    const auto direction = static_cast<visibility::Direction>(i);
    const visibility::SightFigures::Of of = f.in(direction);
    if (of.with_view == 0) continue;
    sight.values.emplace_back(fmt::format("visible_{}_m", to_string(direction)),
                              fmt::format("{:.1f}", of.visible_m));
  }
  return sight;
}

}  // namespace

std::vector<Diagnosis> Diagnoses::of(const status::MonitorSnapshot& f) {
  std::vector<Diagnosis> all{of_deadline(f), of_input(f)};

  Diagnosis losses{.name = "terracut: losses", .message = "none in the last second"};
  std::uint64_t lost = 0, clock_jumps = 0;
  for (const status::NamedCount& cause : f.losses_in_use()) {
    if (!status::is_of_onlookers(cause.name.view())) lost += cause.count;
    if (cause.name.view() == "rejected_clock_jump") clock_jumps = cause.count;
    if (cause.count > 0) {
      losses.values.emplace_back(cause.name.view(), std::to_string(cause.count));
    }
  }
  if (lost > std::exchange(lost_before_, lost)) {
    losses.level = Severity::kWarn;
    losses.message = "something was lost in the last second";
  }
  all.push_back(std::move(losses));

  Diagnosis clock{.name = "terracut: clock", .message = "stamps are plausible"};
  const std::uint64_t unclear = f.unjudged + clock_jumps;
  if (unclear > std::exchange(unclear_before_, unclear)) {
    clock.level = Severity::kWarn;
    clock.message = "stamps contradict each other";
  }
  clock.values = {{"frames_without_latency", std::to_string(f.unjudged)},
                  {"rejected_clock_jump", std::to_string(clock_jumps)}};
  all.push_back(std::move(clock));

  Diagnosis threads{.name = "terracut: threads", .message = "as asked for"};
  for (const status::ThreadStatus& thread : f.threads_in_use()) {
    const std::string name(thread.name.view());
    threads.values.emplace_back(name, thread.scheduling.view());
    threads.values.emplace_back(name + "_major_faults", std::to_string(thread.major_faults));
    if (thread.scheduling.view().find("FIFO") != std::string_view::npos) continue;
    threads.level = Severity::kWarn;
    threads.message = "without a real-time priority: " + name;
  }
  all.push_back(std::move(threads));

  Diagnosis mount{.name = "terracut: mount", .message = "fits the ground that is seen"};
  if (f.mount.guessed != 0) {
    mount.level = Severity::kWarn;
    mount.message = status::guess_text(f.mount);
  }
  if (f.mount.contradicted != 0) {
    mount.level = Severity::kWarn;
    mount.message = status::contradiction_text(f.mount);
  }
  mount.values = {{"height_m", fmt::format("{:.3f}", f.mount.height_m)},
                  {"roll_deg", fmt::format("{:.2f}", f.mount.roll_deg)},
                  {"pitch_deg", fmt::format("{:.2f}", f.mount.pitch_deg)}};
  all.push_back(std::move(mount));

  if (f.sight.is_watched != 0) all.push_back(of_sight(f.sight));

  for (Diagnosis& each : all) each.hardware_id = status::printable(f.sensor.view());
  return all;
}

}  // namespace terracut::publish
