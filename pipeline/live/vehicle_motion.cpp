// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "vehicle_motion.hpp"

#include <chrono>
#include <future>
#include <optional>
#include <string_view>
#include <utility>

#include "rt/measure/thread_cpu_clock.hpp"

namespace terracut::live {
namespace {

/// How often the motion's age is checked while the bus is silent.
constexpr std::int64_t kPatience_ns = 50'000'000;
constexpr std::chrono::milliseconds kRest{1};

/// Lets messages gather by waiting.
void rest() noexcept {
  threads::trusted_call([]() noexcept { std::this_thread::sleep_for(kRest); });
}

}  // namespace

VehicleMotion::VehicleMotion(vehicle::MotionSignals signals,
                             const vehicle::EgoMotion::Config& config, can::SocketCanSource& source,
                             memory::FixedMemory& memory)
    : signals_(std::move(signals)), motion_(config, memory), source_(source) {}

VehicleMotion::~VehicleMotion() {
  stop();
}

std::vector<threads::Grant> VehicleMotion::start(int priority) {
  std::promise<std::vector<threads::Grant>> granted;  // the thread reports what it was granted
  auto grants = granted.get_future();
  thread_ = std::jthread([this, priority, granted = std::move(granted)]() mutable {
    granted.set_value(thread_state_.set_up(thread_request("tc-can", priority, std::nullopt)));
    hear();
  });
  return grants.get();
}

void VehicleMotion::stop() {
  if (!thread_.joinable()) return;
  stop_ = true;
  source_.wake();
  thread_.join();
}

void VehicleMotion::hear() noexcept {
  const measure::PageFaults at_start = measure::PageFaults::of_this_thread();
  MotionReceiver receiver(signals_, motion_, source_, heard_, measure::SystemClock{});
  while (!stop_.load(std::memory_order_relaxed)) {
    const bool came = receiver.work_round(kPatience_ns);
    thread_state_.note_faults(at_start);
    if (came) rest();
  }
}

void VehicleMotion::show(status::MotionFigures& figures) noexcept {
  (void)heard_.take_if_new();
  const HeardMotion& heard = heard_.newest_taken();
  const vehicle::EgoMotionCounters motion = motion_.counters();
  figures.state = heard.state;
  figures.samples = motion.accepted;
  figures.spare_samples = heard.spare_samples;
  figures.last_sample_ns = heard.last_sample_ns;
  figures.fault_count = 0;
  for (const auto& [name, count] : {
           std::pair<std::string_view, std::uint64_t>{"error_frames", heard.bus.error_frames},
           {"bus_off", heard.bus.bus_off},
           {"controller_restarts", heard.bus.restarts},
           {"kernel_drops", heard.bus.kernel_drops},
           {"malformed_frames", heard.bus.malformed},
           {"unstamped_frames", heard.bus.unstamped},
           {"receive_errors", heard.bus.receive_errors},
           {"link_losses", heard.bus.link_losses},
           {"interface_changes", heard.bus.reopened},
           {"short_frames", heard.signals.too_short},
           {"late_frames", heard.signals.out_of_order},
           {"clock_set_back", heard.signals.clock_set_back},
           {"invalid_yaw_rates", heard.signals.yaw_rate_invalid},
           {"invalid_speeds", heard.signals.speed_invalid},
           {"stale_signals", heard.signals.stale},
           {"timeouts", heard.signals.timeouts},
           {"implausible_samples", motion.implausible},
           {"late_samples", motion.out_of_order},
           {"samples_not_taken", motion.not_taken},
       }) {
    figures.faults[figures.fault_count++] = {name, count};
  }
}

}  // namespace terracut::live
