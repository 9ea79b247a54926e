// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tests/simulation/simulated_run.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <tuple>
#include <vector>

#include "pipeline/ground/profile.hpp"
#include "pipeline/ground/stream_segmenter.hpp"
#include "tests/simulation/cached_method.hpp"
#include "tests/simulation/live_chain.hpp"
#include "tests/simulation/watch.hpp"

namespace terracut::simulation {
namespace {

constexpr std::int64_t kMillisecond_ns = 1'000'000;
constexpr std::int64_t kQuietTurns = 12;

ground::TurnMethodMaker method_of(bool is_real) {
  return is_real ? ground::turn_maker_of(ground::terracut_profile(), ground::Pace::kLatency)
                 : cached_method();
}

const SensorLoop& loop_of(const Plan& plan) {
  return plan.is_hdl64e ? hdl64e_loop() : vlp16_loop();
}

/// Labels to compare with, made once a sensor, view and method.
const std::vector<std::uint64_t>& expected_of(const Plan& plan, const SensorLoop& loop) {
  static std::map<std::tuple<bool, bool, BlindPlaces>, std::vector<std::uint64_t>> known;
  auto& hashes = known[{plan.is_hdl64e, plan.has_real_method, plan.blind}];
  if (hashes.empty()) {
    hashes = labels_without_haste(loop, plan.blind, method_of(plan.has_real_method));
  }
  return hashes;
}

}  // namespace

Plan plan_of(std::uint64_t seed) {
  Dice dice(~seed);
  Plan plan;
  plan.seed = seed;
  plan.is_hdl64e = dice.between(0, 15) == 0;
  plan.has_real_method = dice.between(0, 7) == 0;
  // From a buffer that the system refused to enlarge to what is asked for.
  plan.room_packets = static_cast<std::size_t>(dice.between(0, 2) == 0 ? 180 : 7'000);
  plan.faults = faults_of(seed);
  if (dice.between(0, 3) == 0) {
    const auto packets = static_cast<std::int64_t>(loop_of(plan).packets_per_turn);
    plan.blind = {static_cast<std::size_t>(dice.between(0, packets - 1)),
                  static_cast<std::size_t>(dice.between(packets / 15, packets / 3))};
  }
  return plan;
}

Outcome simulate(const Plan& plan) {
  const SensorLoop& loop = loop_of(plan);
  const std::vector<std::uint64_t>& expected = expected_of(plan, loop);
  Machine machine(plan.faults, plan.seed + 1);
  Network network(loop, plan.blind, plan.faults, machine, plan.room_packets, plan.seed + 2);
  LiveChain chain(loop, method_of(plan.has_real_method), machine, network);
  Watch watch(loop, plan.blind, plan.faults, expected, machine, network, chain);
  machine.add_thread(2 * kMillisecond_ns, 60 * kMillisecond_ns, FaultKind::kMonitorStalls,
                     [&] { watch.judge_frames(); });
  machine.add_thread(kMillisecond_ns / 5, 30 * kMillisecond_ns, FaultKind::kLabelsStall,
                     [&] { watch.take_labels(); });
  machine.add_thread(kMillisecond_ns / 5, 5 * kMillisecond_ns, FaultKind::kOutletStalls,
                     [&] { watch.take_points(); });
  machine.add_thread(8 * kMillisecond_ns, 12 * kMillisecond_ns, FaultKind::kMotionStops,
                     [&] { watch.tell_motion(); });

  std::int64_t faults_end_ns = 0;
  for (const Fault& fault : plan.faults) {
    faults_end_ns = std::max(faults_end_ns, Watch::end_ns(fault, plan.faults, loop));
  }
  const auto run_to = [&](std::int64_t end_ns) {
    while (machine.now_ns() < end_ns && !watch.broken()) {
      const std::uint64_t before = OffTheRecord::of_the_run();
      chain.work_round();
      watch.look_after_round(OffTheRecord::of_the_run() - before);
    }
  };
  const std::int64_t quiet_ns =
      faults_end_ns + (Watch::turns_to_recover(plan.blind) + 1) * loop.turn_ns();
  run_to(quiet_ns);
  watch.begin_of_quiet();
  run_to(quiet_ns + kQuietTurns * loop.turn_ns());
  if (!watch.broken()) watch.look_at_end();
  return {.broken = watch.broken(),
          .digest = watch.digest(),
          .simulated_s = static_cast<double>(machine.now_ns()) / 1e9,
          .frames = watch.frames(),
          .frames_compared = watch.frames_compared()};
}

Plan shrunk(Plan plan) {
  const auto try_with = [&](const Faults& faults) {
    Plan tried = plan;
    tried.faults = faults;
    if (!simulate(tried).broken) return false;
    plan = tried;
    return true;
  };
  for (bool again = true; again;) {
    again = false;
    for (std::size_t i = plan.faults.size(); i-- > 0;) {
      Faults fewer = plan.faults;
      fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
      again = try_with(fewer) || again;
    }
    for (std::size_t i = 0; i < plan.faults.size(); ++i) {
      for (const auto size : {&Fault::span_ms, &Fault::amount}) {
        Faults smaller = plan.faults;
        smaller[i].*size /= 2;
        if (smaller != plan.faults) again = try_with(smaller) || again;
      }
    }
  }
  return plan;
}

}  // namespace terracut::simulation
