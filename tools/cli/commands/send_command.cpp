// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <fmt/format.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "firmware_io/capture/capture_source.hpp"
#include "repeated_send.hpp"
#include "rt/measure/thread_cpu_clock.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/json_text.hpp"
#include "tools/cli/settings/stream_choice.hpp"
#include "tools/cli/stop_signal.hpp"
#include "tools/lab/send/device_stamp_shift.hpp"
#include "tools/lab/send/fault_injector.hpp"
#include "tools/lab/send/packet_pacer.hpp"
#include "tools/lab/send/pass_stamps.hpp"
#include "tools/lab/send/port_senders.hpp"

namespace terracut::cli {
namespace {

using capture::CaptureSource;
using net::Ipv4Endpoint;
using packet::Datagram;
using send::FaultInjector;
using send::FaultOutcome;
using send::PacketPacer;
using send::UdpSender;
using Json = nlohmann::ordered_json;

/// The pacer whose waits Ctrl-C ends.
PacketPacer* interruptible = nullptr;

/// The opened files and sockets that the command line names.
struct Parts {
  CaptureSource source;
  send::FaultScript faults;
  send::PortSenders sensor;
  std::optional<send::PortSenders> stranger;  ///< Set if foreign packets have their own sender.
};

Expected<Parts> open_parts(const Options& options, memory::FixedMemory& memory) {
  auto faults = send::parse_fault_script(options.send.faults);
  if (!faults) return tl::unexpected(faults.error());
  auto source = CaptureSource::open(options.capture.file, filter_of(options.capture));
  if (!source) return tl::unexpected(source.error());
  send::UdpSenderConfig sender{.interface = options.send.interface};
  auto sensor = send::PortSenders::open(options.send.to, sender, memory);
  if (!sensor) return tl::unexpected(sensor.error());

  std::optional<send::PortSenders> stranger;
  if (!options.send.foreign_from.empty()) {
    sender.from = Ipv4Endpoint{net::parse_ipv4_address(options.send.foreign_from).value(), 0};
    auto opened = send::PortSenders::open(options.send.to, sender, memory);
    if (!opened) return tl::unexpected(opened.error());
    stranger = *std::move(opened);
  }
  return Parts{*std::move(source), *std::move(faults), *std::move(sensor), std::move(stranger)};
}

std::string amount_of(const FaultOutcome& outcome) {
  std::string text = fmt::format("{} packet{}", outcome.packets, outcome.packets == 1 ? "" : "s");
  if (outcome.fault.kind == send::FaultKind::kReorder) text = "passed by " + text;
  if (outcome.runs.empty()) return text;
  const FaultOutcome::Run& first = outcome.runs.front();
  const bool several = outcome.runs.size() > 1;
  return text + fmt::format(", {}{}{}", outcome.runs.front().count > 1 ? "from number " : "number ",
                            first.first, several ? " on, not all in a row" : "");
}

/// Sends a capture from a socket, on one thread.
class Send {
 public:
  Send(const Options& options, Parts parts, memory::FixedMemory& memory)
      : options_(options),
        parts_(std::move(parts)),
        pacer_(options.send.play.rate, memory),
        injector_(
            parts_.faults,
            [this](const Datagram& datagram, FaultInjector::Origin origin) {
              const bool foreign = origin == FaultInjector::Origin::kForeign;
              send::PortSenders& sender =
                  foreign && parts_.stranger ? *parts_.stranger : parts_.sensor;
              UdpSender* socket = sender.sender_for(datagram.destination_port);
              if (socket != nullptr) pacer_.add(datagram, *socket);
            },
            send::DeviceStampShift()),
        progress_("sending", "packets", 0) {}

  ExitCode run() {
    interruptible = &pacer_;
    catch_stop_signals([]() noexcept { interruptible->stop(); });
    const std::int64_t begun_ns = measure::monotonic_ns();
    for (int pass = 0; options_.send.play.loops == 0 || pass < options_.send.play.loops; ++pass) {
      if (pass > 0) {
        if (Status status = parts_.source.rewind(); !status) return refuse(status.error());
        stamps_.next_pass();
      }
      const bool go_on = play_once();
      // After a pass without packets, later passes have none either.
      if (!go_on || stamps_.packets() == 0) break;
    }
    injector_.finish();
    pacer_.flush();
    wall_ns_ = measure::monotonic_ns() - begun_ns;
    return conclude();
  }

 private:
  /// Plays the capture once. Returns false if sending must end: after Ctrl-C, or if the capture
  /// breaks off.
  bool play_once() {
    while (!pacer_.stopped()) {
      const auto next = parts_.source.next();
      if (!next) {
        input_warning_ = next.error().message;
        warn(input_warning_);
        return false;
      }
      if (!*next) return true;
      Datagram datagram = **next;
      datagram.stamp_ns = stamps_.place(datagram.stamp_ns);
      injector_.feed(datagram);
      progress_.update(static_cast<double>(injector_.fed()));
    }
    return false;
  }

  [[nodiscard]] send::SendCounters sent() const {
    send::SendCounters sum = parts_.sensor.counters();
    if (parts_.stranger) sum += parts_.stranger->counters();
    return sum;
  }

  /// True if Ctrl-C ended the sending early. Endless sending normally ends by Ctrl-C.
  [[nodiscard]] bool interrupted() const {
    return pacer_.stopped() && options_.send.play.loops != 0;
  }

  [[nodiscard]] std::string text() const {
    const send::SendCounters counters = sent();
    std::string text = fmt::format("sent      {} datagrams, {:.1f} MB, to {} in {:.2f} s\n",
                                   counters.sent, static_cast<double>(counters.bytes) * 1e-6,
                                   parts_.sensor.to(), static_cast<double>(wall_ns_) * 1e-9);
    const auto& late = pacer_.lateness();
    if (late.count() > 0) {
      const auto ms = [](std::int64_t ns) { return static_cast<double>(ns) * 1e-6; };
      text +=
          fmt::format("late      p50 {:.3f} ms, p99 {:.3f} ms, max {:.3f} ms\n",
                      ms(late.percentile_ns(50)), ms(late.percentile_ns(99)), ms(late.max_ns()));
    }
    for (const FaultOutcome& outcome : injector_.outcomes()) {
      text += fmt::format("fault     {}: {}\n", to_string(outcome.fault), amount_of(outcome));
    }
    if (interrupted()) text += "ended     interrupted: the rest was not sent\n";
    return text;
  }

  [[nodiscard]] Json json() const {
    const send::SendCounters counters = sent();
    const auto milliseconds = [](std::int64_t ns) {
      return static_cast<double>(ns / 1000) / 1000.0;
    };
    Json json{{"terracut", TERRACUT_VERSION},      {"command", "send"},
              {"input", parts_.source.name()},     {"to", parts_.sensor.to()},
              {"rate", options_.send.play.rate},   {"interrupted", interrupted()},
              {"read", injector_.fed()},           {"sent", counters.sent},
              {"sent_bytes", counters.bytes},      {"failed", counters.failed},
              {"wall_ms", milliseconds(wall_ns_)}, {"unshifted", injector_.unshifted()}};
    if (!input_warning_.empty()) json["input_warning"] = input_warning_;
    const auto& late = pacer_.lateness();
    if (late.count() > 0) {
      json["late_ms"] = {{"p50", milliseconds(late.percentile_ns(50))},
                         {"p99", milliseconds(late.percentile_ns(99))},
                         {"max", milliseconds(late.max_ns())}};
    }
    json["faults"] = Json::array();
    for (const FaultOutcome& outcome : injector_.outcomes()) {
      Json runs = Json::array();
      for (const FaultOutcome::Run& run : outcome.runs) runs.push_back({run.first, run.count});
      json["faults"].push_back({{"fault", to_string(outcome.fault)},
                                {"complete", outcome.complete()},
                                {"packets", outcome.packets},
                                {"runs", runs}});
    }
    return json;
  }

  void warn_of_shortfalls(const send::SendCounters& counters) const {
    if (counters.failed > 0) {
      warn(fmt::format("the system refused {} datagrams; the last because: {}", counters.failed,
                       std::strerror(counters.last_error)));
    }
    for (const FaultOutcome& outcome : injector_.outcomes()) {
      if (outcome.complete()) continue;
      warn(
          fmt::format("{}: the packets ended before all of it was done", to_string(outcome.fault)));
    }
    if (injector_.unshifted() > 0) {
      warn(fmt::format("{} packets are of no sensor whose clock could be shifted",
                       injector_.unshifted()));
    }
  }

  ExitCode conclude() {
    const send::SendCounters counters = sent();
    if (injector_.fed() == 0 && !pacer_.stopped()) {
      return refuse(kNothingCameOut,
                    fmt::format("{}: no datagram to send; `terracut info` lists what it holds",
                                parts_.source.name()));
    }
    warn_of_shortfalls(counters);
    print_text(text());
    const Status written = write_json(options_.output.json, json());
    if (!written) return refuse(written.error());
    if (interrupted()) return kInterrupted;
    return counters.failed > 0 && counters.sent == 0 ? kOutputFailed : kOk;
  }

  const Options& options_;
  Parts parts_;
  PacketPacer pacer_;
  FaultInjector injector_;
  Progress progress_;
  send::PassStamps stamps_;
  std::int64_t wall_ns_ = 0;
  std::string input_warning_;
};

}  // namespace

Status send_until(const Options& options, const std::atomic<bool>& enough) {
  memory::FixedMemory memory;
  auto parts = open_parts(options, memory);
  if (!parts) return tl::unexpected(parts.error());
  PacketPacer pacer(options.send.play.rate, memory);
  send::PassStamps stamps;
  while (!enough && !stop_wanted()) {
    const auto next = parts->source.next();
    if (!next) return tl::unexpected(next.error());
    if (!*next) {
      if (Status status = parts->source.rewind(); !status) return status;
      stamps.next_pass();
      continue;
    }
    Datagram datagram = **next;
    datagram.stamp_ns = stamps.place(datagram.stamp_ns);
    UdpSender* socket = parts->sensor.sender_for(datagram.destination_port);
    if (socket != nullptr) pacer.add(datagram, *socket);
  }
  pacer.flush();
  return {};
}

ExitCode run_send(const Options& options) {
  memory::FixedMemory memory;
  auto parts = open_parts(options, memory);
  if (!parts) return refuse(parts.error());
  return Send(options, *std::move(parts), memory).run();
}

}  // namespace terracut::cli
