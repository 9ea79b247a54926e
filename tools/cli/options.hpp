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
#include "calib/ouster/ouster_product.hpp"
#include "calib/sensor/sensor_model.hpp"
#include "firmware_io/frame/deskew_info.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "firmware_io/ruby128/timestamp.hpp"
#include "firmware_io/vehicle/motion_signals.hpp"
#include "pipeline/scene/wanted.hpp"
#include "pipeline/stage/stage.hpp"
#include "tools/lab/packets/return_mode.hpp"
#include "tools/research/detection/assumptions.hpp"

/// The options of a command, from command line and configuration file. Names, ranges and meanings
/// are in the table of settings (settings/setting_table.cpp); the values here are the defaults.
/// Empty paths, texts and optionals mean "not given". Angles are degrees, as typed.
namespace terracut::cli {

/// Selects the datagrams of a capture or live stream and how they become points.
struct CaptureOptions {
  std::filesystem::path file;
  std::string topic;  ///< Of a bag, to read; empty: its only one.
  std::optional<std::uint16_t> port;
  std::string from;                           ///< Dotted IPv4 of the sender, with or without port.
  std::string to;                             ///< Dotted IPv4 of the destination.
  std::string vlan, mac;                      ///< As in firmware_io/streams/stream_text.hpp.
  std::optional<sensor::SensorModel> sensor;  ///< If empty, detected from the packets.
  std::filesystem::path calibration;
  bool nominal_calibration = false;
  std::optional<int> columns;  ///< If empty, chosen by the spin rate.
  frame::CellOwner cell_owner = frame::CellOwner::kStrongest;
  std::optional<ruby128::RubyTimestamp> timestamp;  ///< If empty, found out.
  double clock_offset_s = 0;
  hdl64e::GeometryModel geometry = hdl64e::GeometryModel::kManual;
  std::optional<int> reorder_packets;  ///< If empty, 2, or 0 in live runs.
  double start_s = 0;
  std::optional<double> duration_s;
};

/// The mount of the sensor on the vehicle.
struct MountOptions {
  std::filesystem::path setup;
  std::optional<double> height_m, roll_deg, pitch_deg;  ///< Override the setup's figures.
  bool may_guess = false;  ///< Assume a level mount at 1.73 m if the ground shows nothing better.
  /// Frame on the ground, above which /tf_static states the mount; empty: any of
  /// input/tree_mount.hpp; "off": none.
  std::string base_frame;
};

enum class Profile : std::uint8_t { kPaper, kTerracut };

/// The method to run.
struct MethodOptions {
  std::string method;  ///< See tools/research/baselines/method_config.hpp; empty: see below.
  Profile profile = Profile::kTerracut;
  stage::Stage last_stage = stage::Stage::kMinCut;
  std::vector<std::string> settings;  ///< KEY=VALUE, checked; docs/reference/parameters.md
  bool heights = false;  ///< Also gives each return's height above the ground, to every output.
  scene::Wanted scene;   ///< What is to be found in each frame, too; it needs heights.

  [[nodiscard]] bool gives_heights() const noexcept { return heights || scene.any(); }
};

enum class McapClouds : std::uint8_t { kAll, kPoints };

/// A recording for ROS 2 and its viewers.
struct McapOptions {
  std::filesystem::path path;  ///< NAME.mcap, or the folder of a bag; empty: none.
  McapClouds clouds = McapClouds::kPoints;
  double split_mb = 0, split_s = 0;  ///< Limits of a bag's files; 0: no limit.
};

/// A preset of DDS topic names for common readers.
enum class DdsPreset : std::uint8_t { kRos, kAutoware, kNav2 };

/// ROS 2 messages over DDS. Names are ROS names: "~/points" is relative to the node's name.
struct DdsOptions {
  bool publishes = false;  ///< --dds
  std::string node = "terracut";
  std::string in = "/points_raw";  ///< Clouds to be labelled.
  bool in_reliable = false;
  std::string frame;  ///< Frame of the answers; empty: that of their clouds.
  DdsPreset preset = DdsPreset::kRos;
  std::string points, ground, obstacles, road;  ///< Topics; empty: the preset's; "off": none.
  std::string diagnostics = "/diagnostics";     ///< Topic; "off": none.
  std::string objects = "~/objects";            ///< Topic, where there are objects; "off": none.
  std::string free_way = "~/free_way";          ///< Topic, where it is found; "off": none.
  std::string sectors;                          ///< Topic of labelled sectors; empty: none.
  std::string raw;  ///< Topic of unlabelled clouds, as a driver sends them; empty: labelled.
  bool reliable = true;
  int depth = 5;
  std::optional<int> domain;  ///< If empty, ROS_DOMAIN_ID or 0.
  std::string interface;      ///< Network interface; empty: Cyclone's choice.
  int fragment_bytes = 63000;
  int receive_buffer_kib = 8192;
};

/// The outputs of a run.
struct OutputOptions {
  std::filesystem::path labels, pcd, png;  ///< Folders to write to; empty: none.
  bool overwrite = false;                  ///< Also replace files made of another input.
  std::string made_of;                     ///< Name of the input; see RunFiles::made_of.
  std::filesystem::path json;              ///< File of the report; empty: none.
  std::vector<std::string> metadata;       ///< KEY=VALUE, for the MCAP file.
  McapOptions mcap;
  std::string foxglove;                       ///< ADDRESS:PORT or PORT; empty: not served.
  std::vector<std::string> foxglove_origins;  ///< Foreign pages that may connect to it.
  std::string view;  ///< Address for frames in a browser; empty or off: none.
  /// Names of coordinate frames (pipeline/publish/run_facts.hpp); the sensor's may be "off": none.
  std::string frame_id = "terracut_ground", sensor_frame_id = "terracut_lidar";
  std::filesystem::path truth;  ///< Folder of NNNNNN.label files against which labels are scored.
  DdsOptions dds;
};

/// Splits each KEY=VALUE into its two parts.
[[nodiscard]] inline std::vector<std::pair<std::string, std::string>> key_values_of(
    const std::vector<std::string>& texts) {
  std::vector<std::pair<std::string, std::string>> pairs;
  for (const std::string& text : texts) {
    const std::size_t sign = text.find('=');
    pairs.emplace_back(text.substr(0, sign), text.substr(sign + 1));
  }
  return pairs;
}

/// The vehicle's motion on its CAN bus. The default signal names are those of the DBC files of
/// simulated drives.
struct MotionOptions {
  std::filesystem::path dbc;              ///< Defines the signals of CAN frames.
  vehicle::MotionFigure speed, yaw_rate;  ///< Names of signals, separated by commas.
  std::string speed_signals = "SPEED", yaw_rate_signals = "YAW_RATE";
  double max_age_ms = 100, timeout_ms = 500;
  double sensor_ahead_m = 0, sensor_left_m = 0;  ///< From the middle of the rear axle.
  frame::FrameInstant deskew_to = frame::FrameInstant::kEnd;
};

enum class ListenVia : std::uint8_t { kSocket, kLibpcap };

/// The source of packets.
struct ListenOptions {
  std::string address = "0.0.0.0:2368";  ///< ADDRESS:PORT or PORT, IPv4.
  ListenVia via = ListenVia::kSocket;
  std::string interface;  ///< Network interface; empty: any. libpcap needs one.
  std::string multicast;  ///< Multicast group to join; empty: none.
  bool share_port = false;
  std::uint16_t device_port = 7788;  ///< Port of a Ruby128's DIFOP packets; 0: not received.
  double gather_ms = 2;              ///< Time for which packets may be collected.
};

/// Scheduling of the threads with a deadline and of the vehicle's CAN thread.
struct RealtimeOptions {
  int priority = 80;        ///< SCHED_FIFO; 0: shared scheduling.
  std::optional<int> core;  ///< The core to run on; empty: any.
  int can_priority = 60;    ///< SCHED_FIFO; 0: shared scheduling.
  bool lock_memory = true;
};

/// The recorder that keeps the last seconds of packets and writes them when an event asks for it.
struct RecorderOptions {
  double seconds = 10;           ///< Seconds kept; 0: no packets are kept.
  std::filesystem::path folder;  ///< Folder of dumps; empty: none are written.
};

/// How the process can be watched.
struct WatchOptions {
  std::string metrics = "127.0.0.1:9464";  ///< ADDRESS:PORT or PORT of /metrics; "off": none.
  std::string name = "terracut";           ///< Name of the status page, for `terracut top`.
  std::string health_can;                  ///< CAN interface for health reports; empty: none.
};

/// How often and how fast packets are played.
struct PlayOptions {
  double rate = 0;  ///< 0: as fast as possible; 1: as recorded.
  int loops = 1;    ///< Number of passes; 0: until interrupted.
};

/// The destination of datagrams, and injected faults.
struct SendOptions {
  std::string to;         ///< ADDRESS[:PORT]
  std::string interface;  ///< Network interface; empty: chosen by routing.
  PlayOptions play{.rate = 1};
  std::string faults;        ///< Faults to inject, as in tools/lab/send/fault_script.hpp
  std::string foreign_from;  ///< Dotted IPv4.
};

/// A simulated drive.
struct SimulateOptions {
  std::string scene = "street";
  std::string pattern;  ///< Of simulator::shot_patterns(); empty: a sensor with rows.
  std::uint64_t seed = 1;
  double duration_s = 3;
  double spin_hz = 10;
  packets::ReturnMode returns = packets::ReturnMode::kSingle;
  ruby128::RubyTimestamp timestamp = ruby128::RubyTimestamp::kUtcMicroseconds;
  ouster::Product product = ouster::Product::kOs1;
  double noise_m = 0.015;
  double speed_mps = -1;    ///< Speed; below 0: the scene's usual speed.
  double yaw_rate_dps = 0;  ///< Not 0: the vehicle drives an arc.
};

/// Recorded scans to be turned into packets.
struct EncodeOptions {
  bool keep_compensation = false;  ///< True: does not restore the sensor's motion.
};

struct EvalOptions {
  std::string dataset;                  ///< A built-in class table, "own", "simulated", "hazards",
                                        ///< "objects", "free" or "sight".
  std::filesystem::path root;           ///< For simulated: scenes, separated by commas.
  std::vector<std::string> more_roots;  ///< Of the last four: the words after `root`.
  std::vector<std::string> kinds;       ///< Kinds of hazards; empty: all.
  int trials = 3;                       ///< Hazards of a kind for each ground, range and frame.
  std::vector<std::string> sequences;   ///< Sequences; empty: all with labels.
  std::string frames;                   ///< FIRST-LAST[:STEP]; empty: all.
  std::vector<std::string> methods;     ///< Empty: the profile's.
  std::vector<std::string> variants;    ///< NAME=METHOD,KEY=VALUE,...
  std::optional<bool> through_packets;  ///< If empty, directly into the image.
  bool find_mount = false;              ///< True: finds the mount of each sequence.
  int jobs = 0;                         ///< Parallel jobs; 0: one per core.
  std::filesystem::path classes;        ///< Empty: the dataset's own table.
  std::filesystem::path predictions, report;
  std::filesystem::path hazard_scans;  ///< Folder for scans with hazards; empty: none are written.
  std::filesystem::path changes;       ///< Given: no journal is kept.
};

enum class FleetFormat : std::uint8_t { kLabels, kMcap };

/// Recordings of a fleet, labelled by many processes.
struct FleetOptions {
  std::filesystem::path root;      ///< Folder searched for drives.
  std::filesystem::path manifest;  ///< tools/cli/fleet/manifest.hpp
  std::string shard = "1/1";       ///< Part I of N to label, as I/N.
  FleetFormat format = FleetFormat::kLabels;
  std::filesystem::path status;  ///< Folder to report on instead of labelling.
};

/// The ground on which obstacles are to be found; tools/research/detection/assumptions.hpp.
struct DetectionOptions {
  double slope = detection::Assumptions{}.slope;
  double roughness_m = detection::Assumptions{}.roughness_m;
};

/// Two labelings of the same recordings.
struct CompareOptions {
  std::filesystem::path before, after;  ///< Folders with labels.
  int most = 10;                        ///< Most drives and frames to list.
  bool trust_sums = false;              ///< Skip files whose checksums agree.
};

/// The options of all commands; each reads those that the table of settings assigns to it.
struct Options {
  CaptureOptions capture;
  MountOptions mount;
  MethodOptions method;
  MotionOptions motion;
  OutputOptions output;
  std::filesystem::path scans;

  ListenOptions listen;
  std::optional<double> patience_s;  ///< Time to find the sensor; none: unlimited.
  std::string can;  ///< CAN interface of the vehicle; empty: frames are not deskewed.
  std::filesystem::path trace;
  std::string stream;           ///< Where labelled points are sent; empty: nowhere.
  ::mode_t stream_mode = 0660;  ///< Permissions of a Unix socket's file.
  bool stream_sectors = false;  ///< Readers of the stream that ask for sectors get them.
  double deadline_ms = 50;      ///< From a frame's last packet to its labels.
  RealtimeOptions realtime;
  RecorderOptions recorder;
  WatchOptions watch;

  PlayOptions replay;
  std::string view_at = "127.0.0.1:8480";  ///< Address for a capture in a browser.
  /// Configuration with the method for a second labelling in the view; empty: none.
  std::filesystem::path beside;
  std::filesystem::path can_recording;  ///< Recording of the vehicle's bus; empty: none.
  int bench_repeat = 10;                ///< Passes over the capture's frames.
  int bench_core = -1;                  ///< Core to run on; -1: the last allowed core.
  bool keep_mount = false;  ///< Calibrate: use the given mount instead of estimating it.

  SimulateOptions simulate;
  EncodeOptions encode;
  std::filesystem::path written;  ///< -o of commands with one output.
  bool can_log = false;           ///< Write the vehicle's motion as CAN log and DBC.
  SendOptions send;

  EvalOptions eval;
  FleetOptions fleet;
  CompareOptions compare;
  DetectionOptions detection;

  std::string watched;  ///< Name of the process to ask; empty: the only running one.
  double wait_s = 30;   ///< Time to wait for its answer.
  bool once = false;
  double interval_s = 1;
  bool print_json = false, print_default = false, print_table = false;

  std::vector<std::string> given;  ///< Options of the command line, such as "--seed".
};

}  // namespace terracut::cli
