// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "live_service.hpp"

#include <fmt/format.h>

#include <string>
#include <utility>

#include "tools/cli/console.hpp"

namespace terracut::cli {
namespace {

constexpr std::int64_t kLooksInWatchdogTime = 4;
constexpr std::int64_t kStatusEvery_ns = 5'000'000'000;

std::string status_of(const status::MonitorSnapshot& figures) {
  std::string link = fmt::format("link {}", to_string(figures.link));
  if (figures.link == status::LinkState::kReceiving) {
    link = figures.head_stands ? "its head does not rotate"
                               : fmt::format("{:.1f} frames/s", figures.frames_per_s);
  }
  return fmt::format("{}: {}, {} frames, {} missed their deadline", figures.sensor.view(), link,
                     figures.frames, figures.all_misses());
}

}  // namespace

LiveService LiveService::from_environment() {
  Expected<ServiceNotify> notify = ServiceNotify::from_environment();
  if (notify) return LiveService(*std::move(notify));
  warn("the service manager is not told how the run does: " + notify.error().message);
  return LiveService(ServiceNotify{});
}

LiveService::LiveService(ServiceNotify notify) noexcept
    : notify_(std::move(notify)),
      look_every_ns_(notify_.watchdog_ns() ? *notify_.watchdog_ns() / kLooksInWatchdogTime
                                           : kStatusEvery_ns) {}

void LiveService::ready(const status::MonitorSnapshot& figures, std::int64_t now_ns) {
  if (!notify_.connected()) return;
  notify_.ready(status_of(figures));
  next_look_ns_ = now_ns + look_every_ns_;
}

void LiveService::work_round(const status::MonitorSnapshot& figures, std::int64_t now_ns) {
  if (!notify_.connected() || now_ns < next_look_ns_) return;
  next_look_ns_ = now_ns + look_every_ns_;
  if (rule_.may_feed(figures)) notify_.feed_watchdog();
  notify_.status(status_of(figures));
}

}  // namespace terracut::cli
