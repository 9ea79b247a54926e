// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "options.hpp"

/// What `terracut live` was asked to do, over what it shares with the commands that read captures.
namespace terracut::cli {

/// Where packets come in.
struct ListenOptions {
  std::string address = "0.0.0.0:2368";  ///< --listen, ADDRESS:PORT, IPv4
  std::string interface;                 ///< --interface; empty: anywhere
  std::string multicast;                 ///< --multicast, group to join; empty: none
  std::string reader = "socket";         ///< --reader socket|pcap
  bool share_port = false;               ///< --share-port
  int buffer_kib = 8192;                 ///< --receive-buffer, [64, 1048576]
  int busy_poll_us = 0;                  ///< --busy-poll, [0, 100000]
};

/// What the threads that have a deadline ask of the system.
struct RealtimeOptions {
  int receive_priority = 80;        ///< SCHED_FIFO, [1, 99]; 0: shared scheduling.
  int segment_priority = 70;        ///< SCHED_FIFO, [1, 99]; 0: shared scheduling.
  std::optional<int> receive_core;  ///< [0, 4095]; none: any
  std::optional<int> segment_core;  ///< [0, 4095]; none: any
  bool lock_memory = true;
};

/// The last seconds of packets, kept and written when something goes wrong.
struct RecorderOptions {
  double seconds = 10;           ///< [0, 600]; 0: nothing is kept.
  std::filesystem::path folder;  ///< Empty: nothing is written.
  int dumps_per_hour = 60;       ///< For missed deadlines, [1, 3600].
  int most_dumps = 20;           ///< Kept in the folder, [1, 100000].
  int most_mib = 2048;           ///< Taken by them, [1, 1048576].
  int least_free_mib = 1024;     ///< Never written with less than this free, [0, 1048576].
};

/// How others see what the process does.
struct MetricsOptions {
  std::string address = "127.0.0.1:9464";  ///< ADDRESS:PORT of /metrics; "off": none.
  std::string status_page = "terracut";    ///< Name for `terracut top`, letters, digits, "-_.".
};

struct LiveOptions {
  /// `sensor` to `geometry`, `from` and `duration_s`; there is no `file`, `port` or `start_s`.
  CaptureOptions capture;
  ListenOptions listen;
  MountOptions mount;
  MethodOptions method;
  OutputOptions output;
  double deadline_ms = 50;  ///< --deadline-ms, from a turn's last packet to its labels, [1, 10000]
  RealtimeOptions realtime;
  RecorderOptions recorder;
  MetricsOptions metrics;
};

}  // namespace terracut::cli
