// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "calib/hdl64e/hdl64e_geometry.hpp"
#include "calib/sensor/sensor_model.hpp"
#include "firmware_io/frame/deskew_info.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "firmware_io/ruby128/timestamp.hpp"
#include "firmware_io/vehicle/motion_signals.hpp"
#include "pipeline/stage/stage.hpp"
#include "tools/lab/packets/return_mode.hpp"

/// What a command was asked to do, by the command line and the configuration file. Names, ranges
/// and meanings stand in the table of settings (settings/setting_table.cpp); the values here are
/// the defaults. Empty paths and texts and optionals mean "not given". Angles are degrees, as
/// typed.
namespace terracut::cli {

/// Which datagrams of a capture or of a live stream, and how they become points.
struct CaptureOptions {
  std::filesystem::path file;
  std::optional<std::uint16_t> port;
  std::string from;                           ///< Dotted IPv4, or that and a port.
  std::string to;                             ///< Dotted IPv4.
  std::string vlan, mac;                      ///< As in firmware_io/streams/stream_text.hpp.
  std::optional<sensor::SensorModel> sensor;  ///< A decoded one; none: the one found.
  std::filesystem::path calibration;
  bool nominal_calibration = false;
  std::optional<int> columns;  ///< None: by the spin rate.
  frame::CellOwner cell_owner = frame::CellOwner::kStrongest;
  std::optional<ruby128::RubyTimestamp> timestamp;  ///< None: found out.
  double clock_offset_s = 0;
  hdl64e::GeometryModel geometry = hdl64e::GeometryModel::kManual;
  std::optional<int> reorder_packets;  ///< None: 2, live 0.
  double start_s = 0;
  std::optional<double> duration_s;
};

/// How the sensor stands on the vehicle.
struct MountOptions {
  std::filesystem::path setup;
  std::optional<double> height_m, roll_deg, pitch_deg;  ///< They win over the setup.
  bool may_guess = false;  ///< Level at 1.73 m where the ground shows nothing better.
};

enum class Profile : std::uint8_t { kPaper, kTerracut };

/// Which method runs.
struct MethodOptions {
  std::string method;  ///< As in tools/research/baselines/method_config.hpp; empty: by the others.
  Profile profile = Profile::kTerracut;
  stage::Stage last_stage = stage::Stage::kMinCut;
  std::vector<std::string> settings;  ///< KEY=VALUE, checked; docs/reference/parameters.md
};

enum class McapClouds : std::uint8_t { kAll, kPoints };

/// A recording for ROS 2 and its viewers.
struct McapOptions {
  std::filesystem::path path;  ///< NAME.mcap, or the folder of a bag; empty: none.
  McapClouds clouds = McapClouds::kPoints;
  double split_mb = 0, split_s = 0;  ///< Of a bag's files; 0: not for that.
};

/// Names of DDS topics that suit those who read them.
enum class DdsPreset : std::uint8_t { kRos, kAutoware, kNav2 };

/// ROS 2 messages over DDS. Names are those of ROS: "~/points" lies below the node's.
struct DdsOptions {
  bool publishes = false;  ///< --dds
  std::string node = "terracut";
  std::string in = "/points_raw";  ///< Clouds to be labelled.
  bool in_reliable = false;
  DdsPreset preset = DdsPreset::kRos;
  std::string points, ground, obstacles, road;  ///< Empty: the preset's; "off": none.
  std::string diagnostics = "/diagnostics";     ///< "off": none.
  std::string raw;  ///< Of clouds without labels, as a driver sends them; empty: labelled ones.
  bool reliable = true;
  int depth = 5;
  std::optional<int> domain;  ///< None: ROS_DOMAIN_ID, else 0.
  std::string interface;      ///< Empty: Cyclone's choice.
  int fragment_bytes = 63000;
  int receive_buffer_kib = 8192;
};

/// Where results go.
struct OutputOptions {
  std::filesystem::path labels, pcd, png;  ///< Folders.
  bool overwrite = false;                  ///< In them also what was made of another input.
  std::string made_of;                     ///< RunFiles::made_of
  std::filesystem::path json;              ///< File.
  std::vector<std::string> metadata;       ///< KEY=VALUE, for the MCAP file.
  McapOptions mcap;
  std::string foxglove;                       ///< ADDRESS:PORT or PORT; empty: not served.
  std::vector<std::string> foxglove_origins;  ///< Of pages elsewhere that may connect to it.
  std::string view;                           ///< Where a browser sees frames; empty, off: nowhere.
  /// Names of coordinate frames (pipeline/publish/stream.hpp); the sensor's "off": none.
  std::string frame_id = "terracut_ground", sensor_frame_id = "terracut_lidar";
  std::filesystem::path truth;  ///< Folder of NNNNNN.label: scores the labels.
  DdsOptions dds;
};

/// Each KEY=VALUE in two.
[[nodiscard]] inline std::vector<std::pair<std::string, std::string>> key_values_of(
    const std::vector<std::string>& texts) {
  std::vector<std::pair<std::string, std::string>> pairs;
  for (const std::string& text : texts) {
    const std::size_t sign = text.find('=');
    pairs.emplace_back(text.substr(0, sign), text.substr(sign + 1));
  }
  return pairs;
}

/// The vehicle's motion on its CAN bus. The signals are named as in the DBC file that simulated
/// drives have beside them.
struct MotionOptions {
  std::filesystem::path dbc;              ///< What the frames mean.
  vehicle::MotionFigure speed, yaw_rate;  ///< Their signals stand below, with commas between.
  std::string speed_signals = "SPEED", yaw_rate_signals = "YAW_RATE";
  double max_age_ms = 100, timeout_ms = 500;
  double sensor_ahead_m = 0, sensor_left_m = 0;  ///< From the middle of the rear axle.
  frame::FrameInstant deskew_to = frame::FrameInstant::kEnd;
};

enum class ListenVia : std::uint8_t { kSocket, kLibpcap };

/// Where packets come in.
struct ListenOptions {
  std::string address = "0.0.0.0:2368";  ///< ADDRESS:PORT or PORT, IPv4.
  ListenVia via = ListenVia::kSocket;
  std::string interface;  ///< Empty: anywhere. libpcap needs one.
  std::string multicast;  ///< Group to join; empty: none.
  bool share_port = false;
  std::uint16_t device_port = 7788;  ///< Of a Ruby128's DIFOP; 0: not heard.
  double gather_ms = 20;             ///< How long packets may wait to be fetched together.
};

/// What the threads that have a deadline, and the one that hears the vehicle, ask of the system.
struct RealtimeOptions {
  int receive_priority = 80, segment_priority = 70;  ///< SCHED_FIFO; 0: shared scheduling.
  std::optional<int> receive_core, segment_core;     ///< None: any.
  int can_priority = 60;                             ///< SCHED_FIFO; 0: shared scheduling.
  bool lock_memory = true;
};

/// The last seconds of packets, kept and written when something goes wrong.
struct RecorderOptions {
  double seconds = 10;           ///< 0: nothing is kept.
  std::filesystem::path folder;  ///< Empty: nothing is written.
};

/// How others see what the process does.
struct WatchOptions {
  std::string metrics = "127.0.0.1:9464";  ///< ADDRESS:PORT or PORT of /metrics; "off": none.
  std::string name = "terracut";           ///< Of the status page, for `terracut top`.
  std::string health_can;                  ///< CAN interface that hears of it; empty: none.
};

/// How often packets are played, and how fast.
struct PlayOptions {
  double rate = 0;  ///< 0 as fast as possible, 1 as recorded.
  int loops = 1;    ///< Passes; 0: until interrupted.
};

/// Where datagrams are sent, and what goes wrong on the way.
struct SendOptions {
  std::string to;         ///< ADDRESS[:PORT]
  std::string interface;  ///< Empty: by the routes.
  PlayOptions play{.rate = 1};
  std::string faults;        ///< tools/lab/send/fault_script.hpp
  std::string foreign_from;  ///< Dotted IPv4.
};

/// A simulated drive.
struct SimulateOptions {
  std::string scene = "street";
  std::uint64_t seed = 1;
  double duration_s = 3;
  double spin_hz = 10;
  packets::ReturnMode returns = packets::ReturnMode::kSingle;
  ruby128::RubyTimestamp timestamp = ruby128::RubyTimestamp::kUtcMicroseconds;
  double noise_m = 0.015;
  double speed_mps = -1;    ///< < 0: what is usual in the scene.
  double yaw_rate_dps = 0;  ///< Not 0: on an arc.
};

/// Recorded scans that become packets.
struct EncodeOptions {
  bool keep_compensation = false;  ///< Do not put the sensor's motion back.
};

struct EvalOptions {
  std::string dataset;                  ///< A built-in class table, own or simulated.
  std::filesystem::path root;           ///< Of simulated: scenes, separated by commas.
  std::vector<std::string> sequences;   ///< Empty: all with labels.
  std::string frames;                   ///< FIRST-LAST[:STEP]; empty: all.
  std::vector<std::string> methods;     ///< Empty: the profile.
  std::vector<std::string> variants;    ///< NAME=METHOD,KEY=VALUE,...
  std::optional<bool> through_packets;  ///< None: straight into the image.
  bool find_mount = false;              ///< Of each sequence by itself.
  int jobs = 0;                         ///< 0: one a core.
  std::filesystem::path classes;        ///< Empty: the dataset's own table.
  std::filesystem::path predictions, report;
  std::filesystem::path changes;  ///< With it no journal.
};

enum class FleetFormat : std::uint8_t { kLabels, kMcap };

/// Recordings of a fleet, labelled by many processes.
struct FleetOptions {
  std::filesystem::path root;      ///< To look for drives in.
  std::filesystem::path manifest;  ///< tools/cli/fleet/manifest.hpp
  std::string shard = "1/1";       ///< Which part of it, I/N.
  FleetFormat format = FleetFormat::kLabels;
  std::filesystem::path status;  ///< Folder to report on instead of labelling.
};

/// Two labelings of the same recordings.
struct CompareOptions {
  std::filesystem::path before, after;  ///< Folders.
  int most = 10;                        ///< How many drives and frames to name.
  bool trust_sums = false;              ///< Leave files unread whose sums are the same.
};

/// All of them; a command looks at those that the table of settings gives it.
struct Options {
  CaptureOptions capture;
  MountOptions mount;
  MethodOptions method;
  MotionOptions motion;
  OutputOptions output;
  std::filesystem::path scans;

  ListenOptions listen;
  std::optional<double> patience_s;  ///< For the sensor at the start; none: as long as it takes.
  std::string can;  ///< CAN interface of the vehicle; empty: frames are not deskewed.
  std::filesystem::path trace;
  std::string stream;           ///< Where others get labelled points; empty: nowhere.
  ::mode_t stream_mode = 0660;  ///< Rights of a Unix socket's file.
  double deadline_ms = 50;      ///< From a frame's last packet to its labels.
  RealtimeOptions realtime;
  RecorderOptions recorder;
  WatchOptions watch;

  PlayOptions replay;
  std::string view_at = "127.0.0.1:8480";  ///< Where a browser sees a capture.
  std::filesystem::path can_recording;     ///< Of the vehicle's bus; empty: none.
  int bench_repeat = 10;                   ///< Passes over the capture's frames.
  int bench_core = -1;                     ///< To be pinned to; -1: the last one allowed.
  bool keep_mount = false;                 ///< Calibrate: the mount is given, not to be found.

  SimulateOptions simulate;
  EncodeOptions encode;
  std::filesystem::path written;  ///< -o, of what has one output.
  bool can_log = false;           ///< The vehicle's motion beside it, as a CAN log and its DBC.
  SendOptions send;

  EvalOptions eval;
  FleetOptions fleet;
  CompareOptions compare;

  std::string watched;  ///< Name of the process to ask; empty: the only one that runs.
  double wait_s = 30;   ///< For its answer.
  bool once = false;
  double interval_s = 1;
  bool print_json = false, print_default = false, print_table = false;

  std::vector<std::string> given;  ///< Options of the command line, "--seed".
};

}  // namespace terracut::cli
