// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// `terracut live` beside the test, and sensors for it. Nothing here takes a certain time: runs end
// when their figures show what the test wants to see, and sensors wait for whoever hears them.
#pragma once

#include <fmt/format.h>

#include <chrono>
#include <cstdint>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "firmware_io/capture/capture_source.hpp"
#include "pipeline/page/status_page.hpp"
#include "pipeline/status/monitor_snapshot.hpp"
#include "rt/measure/thread_cpu_clock.hpp"
#include "tests/tools/cli/background_program.hpp"
#include "tools/lab/send/packet_pacer.hpp"
#include "tools/lab/send/pass_stamps.hpp"
#include "tools/lab/send/udp_sender.hpp"

namespace terracut::cli {

/// Between two looks at something that tells no one when it changes.
inline void look_again_soon() {
  std::this_thread::sleep_for(std::chrono::milliseconds(2));
}

/// A live run on a port of its own.
class LiveRun : public BackgroundProgram {
 public:
  /// What `options` do not say: it listens on a port that the system chooses, waits for its sensor
  /// and its deadline as long as it may.
  LiveRun(const fs::path& folder, const std::string& options)
      : BackgroundProgram(folder, "live", "live " + options + unless_said(options)) {}

  /// Waits until it listens.
  [[nodiscard]] std::uint16_t port() {
    const std::string at = said_after("listening at ");
    return static_cast<std::uint16_t>(std::stoi(at.substr(at.rfind(':') + 1)));
  }
  /// Waits until its figures satisfy `wanted`; false when it ends before they do.
  template <class Wanted>
  [[nodiscard]] bool shows(const Wanted& wanted) {
    for (std::uint64_t seen = 0; !has_ended(); look_again_soon()) {
      if (!page_ || !page_->publisher_lives()) {  // or is of a run before that was killed
        page_.reset();
        if (auto opened = Page::open(name(), status::MonitorSnapshot::kLayout)) {
          page_.emplace(*std::move(opened));
        }
      }
      if (!page_ || page_->publications() == std::exchange(seen, page_->publications())) continue;
      if (const auto figures = page_->read(); figures && wanted(*figures)) return true;
    }
    return false;
  }
  /// Its end after an interrupt.
  [[nodiscard]] Outcome interrupted() {
    interrupt();
    return end();
  }

  /// Of its page. One run at a time in a test program, of which many may run.
  [[nodiscard]] static std::string name() { return "test-" + std::to_string(::getpid()); }

  [[nodiscard]] static std::uint64_t labelled(const status::MonitorSnapshot& figures) {
    return figures.frames - figures.levels[static_cast<std::size_t>(status::Level::kSkipped)];
  }
  [[nodiscard]] static std::uint64_t loss(const status::MonitorSnapshot& figures,
                                          std::string_view name) {
    for (const status::NamedCount& each : figures.losses_in_use()) {
      if (each.name.view() == name) return each.count;
    }
    throw std::runtime_error("no such loss: " + std::string(name));
  }

 private:
  using Page = page::StatusPageReader<status::MonitorSnapshot>;

  [[nodiscard]] static std::string unless_said(const std::string& options) {
    std::string rest = " --no-lock-memory --name " + name();
    for (const char* each :
         {"--listen 127.0.0.1:0", "--metrics off", "--patience 100000", "--deadline 10000"}) {
      const std::string text = each;
      if (options.find(text.substr(0, text.find(' '))) == std::string::npos) rest += " " + text;
    }
    return rest;
  }
  std::optional<Page> page_;
};

/// Plays a capture from all of these addresses at once, over and over, until it is destroyed: at
/// the pace of its stamps, but never faster than the receivers empty their sockets.
class Sensors {
 public:
  static constexpr std::uint32_t kLocalhost = 0x7F000001;
  static constexpr std::uint16_t kAnyPort = 0;

  /// Every datagram to `ports.at(its own port)`, or to the only port there is.
  Sensors(const std::vector<std::uint32_t>& addresses,
          const std::map<std::uint16_t, std::uint16_t>& ports, fs::path capture)
      : capture_(std::move(capture)) {
    for (const std::uint32_t address : addresses) {
      for (const auto& [recorded, port] : ports) {
        auto socket = send::UdpSender::open(
            {.to = {kLocalhost, port}, .from = net::Ipv4Endpoint{address, 0}}, memory_);
        if (!socket) throw std::runtime_error(socket.error().message);
        senders_.push_back({recorded, fmt::format("0100007F:{:04X}", port), *std::move(socket)});
      }
    }
    thread_ = std::jthread([this] { play(); });
  }
  ~Sensors() { pacer_.stop(); }

 private:
  /// What a socket may hold that is not read: less than any system's receive buffer has room for.
  static constexpr unsigned long long kMostWaiting_bytes = 60'000;
  static constexpr std::size_t kLookEvery_packets = 16;

  struct Sender {
    std::uint16_t recorded_port;
    std::string to;  ///< As /proc/net/udp writes it: 127.0.0.1 and the port.
    send::UdpSender socket;
  };

  void play() {
    auto capture = capture::CaptureSource::open(capture_);
    if (!capture) throw std::runtime_error(capture.error().message);
    send::PassStamps stamps;
    std::int64_t held_back_ns = 0;
    for (std::size_t packets = 0; !pacer_.stopped(); ++packets) {
      const auto next = capture->next();
      if (!next) throw std::runtime_error(next.error().message);
      if (!*next) {
        if (!capture->rewind()) return;
        stamps.next_pass();
        continue;
      }
      if (packets % kLookEvery_packets == 0) held_back_ns += hold_back();
      packet::Datagram datagram = **next;
      datagram.stamp_ns = stamps.place(datagram.stamp_ns) + held_back_ns;
      for (Sender& sender : senders_) {
        const bool is_its = sender.recorded_port == datagram.destination_port;
        if (is_its || sender.recorded_port == kAnyPort) pacer_.add(datagram, sender.socket);
      }
    }
  }

  /// Waits while a receiver does not keep up; returns how long.
  [[nodiscard]] std::int64_t hold_back() const {
    const std::int64_t begun_ns = measure::monotonic_ns();
    bool held = false;
    for (; !pacer_.stopped() && is_behind(); held = true) look_again_soon();
    return held ? measure::monotonic_ns() - begun_ns : 0;
  }
  [[nodiscard]] bool is_behind() const {
    std::ifstream table("/proc/net/udp");
    std::string line;
    for (std::getline(table, line); std::getline(table, line);) {
      // "  12: 0100007F:1F90 00000000:0000 07 00000000:00012345 ...": where, and bytes not yet read
      std::istringstream fields(line);
      std::string slot, local, remote, state, queues;
      fields >> slot >> local >> remote >> state >> queues;
      const auto waiting = std::stoull(queues.substr(queues.find(':') + 1), nullptr, 16);
      if (waiting < kMostWaiting_bytes) continue;
      for (const Sender& sender : senders_) {
        if (local == sender.to) return true;
      }
    }
    return false;
  }

  fs::path capture_;
  memory::FixedMemory memory_;
  std::vector<Sender> senders_;
  send::PacketPacer pacer_{1, memory_};
  std::jthread thread_;
};

}  // namespace terracut::cli
