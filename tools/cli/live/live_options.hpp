// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "tools/cli/options.hpp"

/// What `terracut live` was asked to do, over what it shares with the commands that read captures.
namespace terracut::cli {

/// Where packets come in.
struct ListenOptions {
  std::string address = "0.0.0.0:2368";  ///< --listen, ADDRESS:PORT, IPv4
  std::string via = "socket";            ///< --via socket|libpcap
  std::string interface;                 ///< --interface; empty: anywhere. libpcap needs one.
  std::string multicast;                 ///< --multicast, group to join; empty: none
  bool share_port = false;               ///< --share-port
  std::uint16_t device_port = 7788;      ///< --device-port, of a Ruby128's DIFOP; 0: not heard
};

/// What the threads that have a deadline, and the one that hears the vehicle, ask of the system.
struct RealtimeOptions {
  int receive_priority = 80;        ///< SCHED_FIFO, [1, 99]; 0: shared scheduling.
  int segment_priority = 70;        ///< SCHED_FIFO, [1, 99]; 0: shared scheduling.
  std::optional<int> receive_core;  ///< [0, 4095]; none: any
  std::optional<int> segment_core;  ///< [0, 4095]; none: any
  int can_priority = 60;            ///< SCHED_FIFO, [1, 99]; 0: shared scheduling.
  bool lock_memory = true;
};

/// The last seconds of packets, kept and written when something goes wrong.
struct RecorderOptions {
  double seconds = 10;           ///< [0, 600]; 0: nothing is kept.
  std::filesystem::path folder;  ///< Empty: nothing is written.
};

/// How others see what the process does.
struct WatchOptions {
  std::string metrics = "127.0.0.1:9464";  ///< ADDRESS:PORT of /metrics; "off": none.
  std::string name = "terracut";           ///< Of the status page, for `terracut top`.
  std::string health_can;  ///< --health-can, CAN interface that hears of it; empty: none.
};

struct LiveOptions {
  CaptureOptions capture;  ///< `sensor` to `geometry`, `from` and `duration_s` of it.
  ListenOptions listen;
  /// For a sensor to be heard at the start, [0.1, 1e9]; none: as long as it takes.
  std::optional<double> patience_s;
  MountOptions mount;
  MethodOptions method;
  std::string can;  ///< --can, CAN interface of the vehicle; empty: its motion is not taken out.
  MotionOptions motion;
  std::filesystem::path labels, json, trace;
  std::string stream;               ///< --stream, where others get labelled points; empty: nowhere.
  std::string stream_mode = "660";  ///< --stream-mode, octal rights of a Unix socket's file.
  double deadline_ms = 50;          ///< From a turn's last packet to its labels, [1, 10000].
  RealtimeOptions realtime;
  RecorderOptions recorder;
  WatchOptions watch;
};

}  // namespace terracut::cli
