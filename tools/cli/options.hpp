// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

/// What each subcommand was asked to do: filled by arguments.cpp, read by the commands. Empty paths
/// and optionals mean "not given". Angles are degrees here, as typed.
namespace terracut::cli {

/// Which datagrams of a capture, and how they become points.
struct CaptureOptions {
  std::filesystem::path file;
  std::optional<std::uint16_t> port;     ///< --port
  std::string from;                      ///< --from, dotted IPv4
  std::string sensor = "auto";           ///< --sensor auto|hdl64e|ruby128
  std::filesystem::path calibration;     ///< --calibration
  bool nominal_calibration = false;      ///< --nominal-calibration
  std::optional<int> columns;            ///< --columns, [16, 36000]; else by the spin rate
  std::string cell_owner = "strongest";  ///< --cell-owner strongest|last|first|both
  std::string timestamp = "auto";        ///< --timestamp auto|calendar|us|ns
  double clock_offset_s = 0;             ///< --clock-offset
  std::string geometry = "manual";       ///< --geometry manual|ros
  std::optional<int> reorder_packets;    ///< --reorder-packets, [0, 16]; else 2, live 0
  double start_s = 0;                    ///< --start, [0, 1e9]
  std::optional<double> duration_s;      ///< --duration, (0, 1e9]
};

/// How the sensor stands on the vehicle.
struct MountOptions {
  std::filesystem::path setup;                          ///< --setup
  std::optional<double> height_m, roll_deg, pitch_deg;  ///< --mount-...; win over --setup
};

/// Which method runs.
struct MethodOptions {
  std::string method;                ///< --method, pipeline/ground_method.hpp; empty: by the others
  std::string profile = "terracut";  ///< --profile paper|terracut
  std::string stages = "mrf";        ///< --stages elevation|adjacent|mrf
  std::vector<std::string> settings;  ///< --set KEY=VALUE, checked; docs/parameters.md
};

/// Where results go.
struct OutputOptions {
  std::filesystem::path labels, pcd, png;  ///< Folders.
  std::filesystem::path json;              ///< File.
  std::filesystem::path truth;             ///< Folder of NNNNNN.label: scores the labels.
};

/// One figure of the vehicle's motion: which signals of the DBC file it is made of.
struct MotionFigureOptions {
  std::string signals{};      ///< MESSAGE.SIGNAL or SIGNAL; several, with commas between: the mean.
  std::string unit = "file";  ///< "file": as the DBC file says.
  double scale = 1;           ///< On top; -1 turns the sign round.
  std::string sign{};         ///< Signal: negative when not 0. Empty: none.
  std::string valid{};        ///< Signal that says whether it is valid. Empty: none.
  double valid_value = 1;     ///< What that has to be.
};

/// The vehicle's motion on its CAN bus. The signals are named as in the DBC file that simulated
/// drives have beside them.
struct MotionOptions {
  std::filesystem::path dbc;  ///< --dbc: what the frames mean.
  MotionFigureOptions speed{.signals = "SPEED"}, yaw_rate{.signals = "YAW_RATE"};
  double max_age_ms = 100, timeout_ms = 500;
  double sensor_ahead_m = 0, sensor_left_m = 0;  ///< From the middle of the rear axle.
  std::string deskew_to = "end";                 ///< --deskew-to start|middle|end
};

struct ReplayOptions {
  CaptureOptions capture;
  MountOptions mount;
  MethodOptions method;
  MotionOptions motion;
  std::filesystem::path can;  ///< --can: recording of the vehicle's bus; empty: none.
  OutputOptions output;
  double rate = 0;  ///< --rate: 0 as fast as possible, 1 as recorded
  int loops = 1;    ///< --loop: passes over the capture, 0 until interrupted
};

struct SegmentOptions {
  std::filesystem::path scans;
  std::filesystem::path calibration;  ///< Empty: fitted from the scans.
  MountOptions mount;
  MethodOptions method;
  OutputOptions output;  ///< truth is not used: it lies beside the scans
};

struct SendOptions {
  std::filesystem::path file;
  std::optional<std::uint16_t> port;  ///< --port
  std::string from;                   ///< --from, dotted IPv4
  std::string to;                     ///< --to ADDRESS[:PORT]
  std::string interface;              ///< --interface
  double rate = 1;                    ///< --rate: 1 as recorded, 0 as fast as possible
  int loops = 1;                      ///< --loop: passes over the capture, 0 until interrupted
  std::string faults;                 ///< --faults, firmware_io/live/fault_script.hpp
  std::string foreign_from;           ///< --foreign-from, dotted IPv4
  std::filesystem::path json;
};

struct SimulateOptions {
  std::string sensor = "hdl64e";  ///< --sensor hdl64e|ruby128
  std::string scene = "street";
  std::uint64_t seed = 1;
  double duration_s = 3;
  double spin_hz = 10;             ///< --spin-hz, [5, 20]
  std::string returns = "single";  ///< --returns single|dual
  std::string timestamp = "us";    ///< --timestamp calendar|us|ns, of a Ruby128
  double noise_m = 0.015;
  double speed_mps = -1;    ///< --speed; < 0: what is usual in the scene
  double yaw_rate_dps = 0;  ///< --yaw-rate, [-57, 57]; not 0: on an arc
  bool can_log = false;     ///< The vehicle's motion beside the capture, as a CAN log and its DBC.
  std::filesystem::path calibration;  ///< Empty: the built-in nominal unit.
  MountOptions mount;
  std::filesystem::path output;  ///< Empty: nothing is kept.
  SendOptions udp;               ///< --udp is its `to`; empty: nothing is sent. `file` is not used.
};

struct EncodeOptions {
  std::string sensor = "hdl64e";  ///< --sensor hdl64e|ruby128
  std::filesystem::path scans;
  std::filesystem::path calibration;  ///< Empty: fitted from the scans.
  bool undo_compensation = false;     ///< Refuse where the motion cannot be put back.
  bool keep_compensation = false;     ///< Do not put it back.
  bool can_log = false;               ///< The motion that was put back, as a CAN log and its DBC.
  std::filesystem::path output;
};

struct CalibrateOptions {
  CaptureOptions capture;
  MountOptions mount;  ///< Start of the estimate, or fixed with --keep-mount.
  MethodOptions method;
  bool keep_mount = false;
  std::filesystem::path output;
};

struct InfoOptions {
  std::filesystem::path file;
  std::filesystem::path json;
};

struct PlanOptions {
  std::string sensor = "hdl64e";  ///< --sensor hdl64e|ruby128
  MethodOptions method;
  std::filesystem::path json;
};

struct ParametersOptions {};

struct Configuration;  // configuration.hpp

struct ConfigOptions {
  bool print_default = false;
  bool print_table = false;  ///< --print-table: for docs/configuration.md.
  std::shared_ptr<const Configuration> configuration;  ///< The one in force; never null.
};

struct DoctorOptions {
  std::string interface;            ///< --interface; empty: every one that is up
  std::uint16_t port = 2368;        ///< --port
  std::optional<int> receive_core;  ///< From the configuration, as are those below.
  std::optional<int> segment_core;
  bool json = false;
};

struct BenchOptions {
  CaptureOptions capture;
  MountOptions mount;
  MethodOptions method;
  int repeat = 10;  ///< Passes over the capture's frames.
  int core = -1;    ///< --core: pin to it; -1: the last one allowed.
  std::filesystem::path json;
};

struct EvalOptions {
  std::string dataset = "semantickitti";         ///< semantickitti|koblenz|simulated
  std::filesystem::path root;                    ///< Of simulated: scenes, separated by commas.
  std::vector<std::string> sequences;            ///< --sequences; empty: all with labels
  std::string frames;                            ///< --frames FIRST-LAST[:STEP]; empty: all
  std::vector<std::string> methods{"terracut"};  ///< --method
  std::vector<std::string> variants;             ///< --variant NAME=METHOD,KEY=VALUE,...
  std::vector<std::string> settings;             ///< --set KEY=VALUE, for every method, checked
  std::optional<std::string> through;            ///< --through image|packets; else the former
  int jobs = 0;                                  ///< --jobs; 0: one a core
  MountOptions mount;
  std::optional<std::string> sensor;   ///< --sensor hdl64e|ruby128; these four: of simulated
  std::optional<std::string> returns;  ///< --returns single|dual
  std::optional<double> duration_s;    ///< --duration, (0, 3600]
  std::optional<std::uint64_t> seed;   ///< --seed
  std::filesystem::path classes;       ///< --classes; empty: the dataset's own table
  std::filesystem::path predictions;   ///< --predictions
  std::filesystem::path json;          ///< --json
  std::filesystem::path report;        ///< --report
  std::filesystem::path changes;       ///< --changes; with it no journal
};

struct CompareOptions {
  std::filesystem::path before, after;  ///< Reports of eval.
  std::string method = "terracut";      ///< --method
  std::string method_after;             ///< --method-after; empty: the same
  double significance = 0.05;           ///< --significance, (0, 1)
  std::filesystem::path json;           ///< --json
};

struct DumpOptions {
  std::string name;    ///< Of the running process; empty: the only one that runs.
  double wait_s = 30;  ///< --wait, [0, 3600]: for its answer.
};

struct TopOptions {
  std::string name;  ///< Status page of the process to watch; empty: the only one that runs.
  bool once = false;
  bool json = false;      ///< --json: print the figures for programs, once.
  double interval_s = 1;  ///< --interval, [0.1, 3600]
};

}  // namespace terracut::cli
