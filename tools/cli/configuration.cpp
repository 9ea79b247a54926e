// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "configuration.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace terracut::cli {
namespace {

using C = Configuration;
using F = SettingField;

constexpr std::array<std::string_view, 2> kVias{"socket", "libpcap"};
constexpr std::array<std::string_view, 3> kModels{"auto", "hdl64e", "ruby128"};
constexpr std::array<std::string_view, 4> kCellOwners{"strongest", "last", "first", "both"};
constexpr std::array<std::string_view, 4> kTimestamps{"auto", "calendar", "us", "ns"};
constexpr std::array<std::string_view, 3> kSimulatedTimestamps{"calendar", "us", "ns"};
constexpr std::array<std::string_view, 2> kGeometries{"manual", "ros"};
constexpr std::array<std::string_view, 2> kProfiles{"paper", "terracut"};
constexpr std::array<std::string_view, 3> kStages{"elevation", "adjacent", "mrf"};
constexpr std::array<std::string_view, 2> kReturns{"single", "dual"};
constexpr std::array<std::string_view, 5> kScenes{"street", "highway", "rural", "flat", "hill"};

constexpr std::array<std::string_view, 4> kSpeedUnits{"file", "m/s", "km/h", "mph"};
constexpr std::array<std::string_view, 3> kYawRateUnits{"file", "rad/s", "deg/s"};
constexpr std::array<std::string_view, 3> kStreamModes{"600", "660", "666"};
constexpr std::array<std::string_view, 3> kTurnInstants{"start", "middle", "end"};

constexpr double kLongest_s = 1e9;
constexpr double kMostLoops = std::numeric_limits<int>::max();
constexpr double kMostSeed = 9007199254740992;  // whole numbers are exact up to here
constexpr TextForm kAny = TextForm::kAny;

// clang-format off: a table reads better with an entry on two lines than one word a line.
constexpr std::array kSettings{
    Setting{"sensor.model", "--sensor", "", "Sensor model; auto: the one found (simulate, encode, plan: hdl64e)", 0, 0, kModels, kAny,
            [](C& c) noexcept -> F { return &c.live.capture.sensor; }},
    Setting{"sensor.calibration", "--calibration", "", "The unit's table: db.xml or yaml of an HDL-64E, angle.csv of a Ruby128 (default: the one in the packets)", 0, 0, {}, kAny,
            [](C& c) noexcept -> F { return &c.live.capture.calibration; }},
    Setting{"sensor.nominal_calibration", "--nominal-calibration", "", "Ruby128: take the model's table where there is none of the unit; heights may be off", 0, 0, {}, kAny,
            [](C& c) noexcept -> F { return &c.live.capture.nominal_calibration; }},
    Setting{"sensor.columns", "--columns", "columns", "Columns of the range image (default: firings a turn at the spin rate found)", 16, 36000, {}, kAny,
            [](C& c) noexcept -> F { return &c.live.capture.columns; }},
    Setting{"sensor.cell_owner", "--cell-owner", "", "Dual return: which return stands for its cell; all of them are labelled", 0, 0, kCellOwners, kAny,
            [](C& c) noexcept -> F { return &c.live.capture.cell_owner; }},
    Setting{"sensor.timestamp", "--timestamp", "", "Ruby128: how its stamps are encoded; auto: found out from the packets", 0, 0, kTimestamps, kAny,
            [](C& c) noexcept -> F { return &c.live.capture.timestamp; }},
    Setting{"sensor.clock_offset_s", "--clock-offset", "s", "To add to the device's clock where it is reported", -kLongest_s, kLongest_s, {}, kAny,
            [](C& c) noexcept -> F { return &c.live.capture.clock_offset_s; }},
    Setting{"sensor.geometry", "--geometry", "", "Meaning of the table: the maker's manual, or as ROS drivers take it", 0, 0, kGeometries, kAny,
            [](C& c) noexcept -> F { return &c.live.capture.geometry; }},

    Setting{"input.port", "--port", "", "Captures: only UDP datagrams to this port (default: any)", 0, 65535, {}, kAny,
            [](C& c) noexcept -> F { return &c.live.capture.port; }},
    Setting{"input.from", "--from", "", "Only datagrams of this IPv4 address (default: any)", 0, 0, {}, TextForm::kAddress,
            [](C& c) noexcept -> F { return &c.live.capture.from; }},
    Setting{"input.start_s", "--start", "s", "Captures: skip so much of the beginning", 0, kLongest_s, {}, kAny,
            [](C& c) noexcept -> F { return &c.live.capture.start_s; }},
    Setting{"input.duration_s", "--duration", "s", "Stop after so much (default: at the end; live: when interrupted)", 1e-6, kLongest_s, {}, kAny,
            [](C& c) noexcept -> F { return &c.live.capture.duration_s; }},
    Setting{"input.reorder_packets", "--reorder-packets", "packets", "How many packets late one may come and still find its turn, which waits for it (default: captures 2, live 0)", 0, 16, {}, kAny,
            [](C& c) noexcept -> F { return &c.live.capture.reorder_packets; }},
    Setting{"input.listen", "--listen", "", "live: address and port the sensor sends to; 0.0.0.0 hears broadcasts too", 0, 0, {}, TextForm::kEndpoint,
            [](C& c) noexcept -> F { return &c.live.listen.address; }},
    Setting{"input.via", "--via", "", "live: libpcap hears what a socket does not; it needs an interface and CAP_NET_RAW", 0, 0, kVias, kAny,
            [](C& c) noexcept -> F { return &c.live.listen.via; }},
    Setting{"input.interface", "--interface", "", "live: only what comes in here (default: anywhere)", 0, 0, {}, TextForm::kName,
            [](C& c) noexcept -> F { return &c.live.listen.interface; }},
    Setting{"input.multicast", "--multicast", "", "live: group to join (default: none)", 0, 0, {}, TextForm::kAddress,
            [](C& c) noexcept -> F { return &c.live.listen.multicast; }},
    Setting{"input.share_port", "--share-port", "", "live: let other programs that ask for the same hear the port too", 0, 0, {}, kAny,
            [](C& c) noexcept -> F { return &c.live.listen.share_port; }},
    Setting{"input.device_port", "--device-port", "", "live: of a Ruby128's device information, heard at the start for its angles; 0: do not", 0, 65535, {}, kAny,
            [](C& c) noexcept -> F { return &c.live.listen.device_port; }},
    Setting{"input.patience_s", "--patience", "s", "live: how long to wait for the sensor at the start (default: as long as it takes)", 0.1, kLongest_s, {}, kAny,
            [](C& c) noexcept -> F { return &c.live.patience_s; }},

    Setting{"mount.setup", "--setup", "", "Mount and ring distances found by `terracut calibrate`", 0, 0, {}, kAny,
            [](C& c) noexcept -> F { return &c.live.mount.setup; }},
    Setting{"mount.height_m", "--mount-height", "m", "From the ground to the sensor's origin (default: the setup's, else 1.73)", 0.2, 6, {}, kAny,
            [](C& c) noexcept -> F { return &c.live.mount.height_m; }},
    Setting{"mount.roll_deg", "--mount-roll", "deg", "Left side up (default: the setup's, else 0)", -28, 28, {}, kAny,
            [](C& c) noexcept -> F { return &c.live.mount.roll_deg; }},
    Setting{"mount.pitch_deg", "--mount-pitch", "deg", "Looking down in front (default: the setup's, else 0)", -28, 28, {}, kAny,
            [](C& c) noexcept -> F { return &c.live.mount.pitch_deg; }},

    Setting{"method.profile", "--profile", "", "paper: the method as printed; terracut: what measured better", 0, 0, kProfiles, kAny,
            [](C& c) noexcept -> F { return &c.live.method.profile; }},
    Setting{"method.stages", "--stages", "", "How far to refine: elevation map, + adjacent points, + random field (mrf)", 0, 0, kStages, kAny,
            [](C& c) noexcept -> F { return &c.live.method.stages; }},

    Setting{"motion.can", "--can", "", "live: CAN interface of the vehicle, whose motion is taken out of every turn (default: none)", 0, 0, {}, TextForm::kName,
            [](C& c) noexcept -> F { return &c.live.can; }},
    Setting{"motion.dbc", "--dbc", "", "DBC file that says what the vehicle's CAN frames mean (replay, live)", 0, 0, {}, kAny,
            [](C& c) noexcept -> F { return &c.live.motion.dbc; }},
    Setting{"motion.speed", "", "", "Speed: its signal in the DBC file, SIGNAL or MESSAGE.SIGNAL; several, with commas between: their mean", 0, 0, {}, kAny,
            [](C& c) noexcept -> F { return &c.live.motion.speed.signals; }},
    Setting{"motion.speed_unit", "", "", "Unit of these signals; file: as the DBC file says", 0, 0, kSpeedUnits, kAny,
            [](C& c) noexcept -> F { return &c.live.motion.speed.unit; }},
    Setting{"motion.speed_scale", "", "", "Factor on top; -1 turns the sign round", -1000, 1000, {}, kAny,
            [](C& c) noexcept -> F { return &c.live.motion.speed.scale; }},
    Setting{"motion.speed_sign", "", "", "Signal by which it is negative, when not 0 (default: none)", 0, 0, {}, kAny,
            [](C& c) noexcept -> F { return &c.live.motion.speed.sign; }},
    Setting{"motion.speed_valid", "", "", "Signal that says whether it is valid (default: none, it always is)", 0, 0, {}, kAny,
            [](C& c) noexcept -> F { return &c.live.motion.speed.valid; }},
    Setting{"motion.speed_valid_value", "", "", "What that signal has to be", -1e9, 1e9, {}, kAny,
            [](C& c) noexcept -> F { return &c.live.motion.speed.valid_value; }},
    Setting{"motion.yaw_rate", "", "", "Yaw rate, to the left positive: its signal in the DBC file, SIGNAL or MESSAGE.SIGNAL; several, with commas between: their mean", 0, 0, {}, kAny,
            [](C& c) noexcept -> F { return &c.live.motion.yaw_rate.signals; }},
    Setting{"motion.yaw_rate_unit", "", "", "Unit of these signals; file: as the DBC file says", 0, 0, kYawRateUnits, kAny,
            [](C& c) noexcept -> F { return &c.live.motion.yaw_rate.unit; }},
    Setting{"motion.yaw_rate_scale", "", "", "Factor on top; -1 turns the sign round", -1000, 1000, {}, kAny,
            [](C& c) noexcept -> F { return &c.live.motion.yaw_rate.scale; }},
    Setting{"motion.yaw_rate_sign", "", "", "Signal by which it is negative, when not 0 (default: none)", 0, 0, {}, kAny,
            [](C& c) noexcept -> F { return &c.live.motion.yaw_rate.sign; }},
    Setting{"motion.yaw_rate_valid", "", "", "Signal that says whether it is valid (default: none, it always is)", 0, 0, {}, kAny,
            [](C& c) noexcept -> F { return &c.live.motion.yaw_rate.valid; }},
    Setting{"motion.yaw_rate_valid_value", "", "", "What that signal has to be", -1e9, 1e9, {}, kAny,
            [](C& c) noexcept -> F { return &c.live.motion.yaw_rate.valid_value; }},
    Setting{"motion.max_age_ms", "", "ms", "Signals older than this are not used", 1, 1000, {}, kAny,
            [](C& c) noexcept -> F { return &c.live.motion.max_age_ms; }},
    Setting{"motion.timeout_ms", "", "ms", "Without speed and yaw rate for so long, the motion is lost", 1, 60000, {}, kAny,
            [](C& c) noexcept -> F { return &c.live.motion.timeout_ms; }},
    Setting{"motion.sensor_ahead_m", "", "m", "The sensor's place before the middle of the rear axle", -20, 20, {}, kAny,
            [](C& c) noexcept -> F { return &c.live.motion.sensor_ahead_m; }},
    Setting{"motion.sensor_left_m", "", "m", "... and to the left of it", -10, 10, {}, kAny,
            [](C& c) noexcept -> F { return &c.live.motion.sensor_left_m; }},
    Setting{"motion.deskew_to", "--deskew-to", "", "Instant of the turn at which all its returns are to lie where they were", 0, 0, kTurnInstants, kAny,
            [](C& c) noexcept -> F { return &c.live.motion.deskew_to; }},

    Setting{"output.labels", "--labels", "", "Folder for NNNNNN.label, SemanticKITTI predictions (replay, segment, live)", 0, 0, {}, kAny,
            [](C& c) noexcept -> F { return &c.output.labels; }},
    Setting{"output.pcd", "--pcd", "", "Folder for NNNNNN.pcd: x y z intensity ring label (replay, segment)", 0, 0, {}, kAny,
            [](C& c) noexcept -> F { return &c.output.pcd; }},
    Setting{"output.png", "--png", "", "Folder for pictures: from above and as the sensor sees it (replay, segment)", 0, 0, {}, kAny,
            [](C& c) noexcept -> F { return &c.output.png; }},
    Setting{"output.json", "--json", "", "File for the report: returns, losses and times (replay, segment, live)", 0, 0, {}, kAny,
            [](C& c) noexcept -> F { return &c.output.json; }},
    Setting{"output.truth", "--truth", "", "replay: folder of NNNNNN.label to score the labels against", 0, 0, {}, kAny,
            [](C& c) noexcept -> F { return &c.output.truth; }},
    Setting{"output.stream", "--stream", "", "live: where other programs get labelled points: ADDRESS:PORT, PORT or a socket's path (default: nowhere)", 0, 0, {}, TextForm::kStream,
            [](C& c) noexcept -> F { return &c.live.stream; }},
    Setting{"output.stream_mode", "--stream-mode", "", "live: who may read the stream at a socket's path: its owner, group too, or everybody", 0, 0, kStreamModes, kAny,
            [](C& c) noexcept -> F { return &c.live.stream_mode; }},
    Setting{"output.trace", "--trace", "", "live: file for the last frames as a trace, for ui.perfetto.dev", 0, 0, {}, kAny,
            [](C& c) noexcept -> F { return &c.live.trace; }},

    Setting{"deadline.limit_ms", "--deadline-ms", "ms", "live: from a turn's last packet to its labels", 1, 10000, {}, kAny,
            [](C& c) noexcept -> F { return &c.live.deadline_ms; }},

    Setting{"realtime.receive_priority", "--receive-priority", "", "live: SCHED_FIFO priority of the thread that receives; 0: none", 0, 99, {}, kAny,
            [](C& c) noexcept -> F { return &c.live.realtime.receive_priority; }},
    Setting{"realtime.segment_priority", "--segment-priority", "", "live: SCHED_FIFO priority of the thread that segments; 0: none", 0, 99, {}, kAny,
            [](C& c) noexcept -> F { return &c.live.realtime.segment_priority; }},
    Setting{"realtime.receive_core", "--receive-core", "", "live: the only core that thread runs on (default: any)", 0, 4095, {}, kAny,
            [](C& c) noexcept -> F { return &c.live.realtime.receive_core; }},
    Setting{"realtime.segment_core", "--segment-core", "", "live: the only core that thread runs on (default: any)", 0, 4095, {}, kAny,
            [](C& c) noexcept -> F { return &c.live.realtime.segment_core; }},
    Setting{"realtime.can_priority", "--can-priority", "", "live: SCHED_FIFO priority of the thread that hears the vehicle's CAN bus; 0: none", 0, 99, {}, kAny,
            [](C& c) noexcept -> F { return &c.live.realtime.can_priority; }},
    Setting{"realtime.lock_memory", "--no-lock-memory", "", "live: keep all memory of the process present", 0, 0, {}, kAny,
            [](C& c) noexcept -> F { return &c.live.realtime.lock_memory; }},

    Setting{"recorder.seconds", "--recorder-seconds", "s", "live: packets kept for a dump; 0: none", 0, 600, {}, kAny,
            [](C& c) noexcept -> F { return &c.live.recorder.seconds; }},
    Setting{"recorder.folder", "--recorder-folder", "", "live: where dumps go (default: none is written)", 0, 0, {}, kAny,
            [](C& c) noexcept -> F { return &c.live.recorder.folder; }},

    Setting{"metrics.address", "--metrics", "", "live: where Prometheus reads /metrics; off: nowhere", 0, 0, {}, TextForm::kEndpointOrOff,
            [](C& c) noexcept -> F { return &c.live.watch.metrics; }},
    Setting{"metrics.name", "--name", "", "live: name under which `terracut top` and `dump` find the process", 0, 0, {}, TextForm::kName,
            [](C& c) noexcept -> F { return &c.live.watch.name; }},
    Setting{"metrics.health_can", "--health-can", "", "live: CAN interface on which terracut says how it is, terracut_health.dbc (default: none)", 0, 0, {}, TextForm::kName,
            [](C& c) noexcept -> F { return &c.live.watch.health_can; }},

    Setting{"replay.rate", "--rate", "", "Pace by the capture's stamps: 1 as recorded, 0 flat out", 0, 1000, {}, kAny,
            [](C& c) noexcept -> F { return &c.replay.rate; }},
    Setting{"replay.loop", "--loop", "passes", "Passes over the capture; 0: until interrupted", 0, kMostLoops, {}, kAny,
            [](C& c) noexcept -> F { return &c.replay.loops; }},

    Setting{"simulate.scene", "--scene", "", "What is driven through", 0, 0, kScenes, kAny,
            [](C& c) noexcept -> F { return &c.simulate.scene; }},
    Setting{"simulate.seed", "--seed", "", "The same seed gives the same drive", 0, kMostSeed, {}, kAny,
            [](C& c) noexcept -> F { return &c.simulate.seed; }},
    Setting{"simulate.duration_s", "--duration", "s", "How long to drive", 0.1, 3600, {}, kAny,
            [](C& c) noexcept -> F { return &c.simulate.duration_s; }},
    Setting{"simulate.spin_hz", "--spin-hz", "Hz", "Turns a second: 5, 10 and 20 are the sensors' own", 5, 20, {}, kAny,
            [](C& c) noexcept -> F { return &c.simulate.spin_hz; }},
    Setting{"simulate.returns", "--returns", "", "single: the strongest; dual: the strongest and the last", 0, 0, kReturns, kAny,
            [](C& c) noexcept -> F { return &c.simulate.returns; }},
    Setting{"simulate.timestamp", "--timestamp", "", "Ruby128: how its stamps are encoded", 0, 0, kSimulatedTimestamps, kAny,
            [](C& c) noexcept -> F { return &c.simulate.timestamp; }},
    Setting{"simulate.noise_m", "--noise", "m", "Standard deviation of the range noise", 0, 1, {}, kAny,
            [](C& c) noexcept -> F { return &c.simulate.noise_m; }},

    Setting{"bench.repeat", "--repeat", "passes", "Passes over the capture", 1, 100000, {}, kAny,
            [](C& c) noexcept -> F { return &c.bench.repeat; }},
    Setting{"bench.core", "--core", "", "Processor core to stay on; -1: the last one allowed", -1, 4095, {}, kAny,
            [](C& c) noexcept -> F { return &c.bench.core; }},
};
// clang-format on

}  // namespace

std::span<const Setting> settings() noexcept {
  return kSettings;
}

const Setting* find_setting(std::string_view key) noexcept {
  const auto found = std::ranges::find(kSettings, key, &Setting::key);
  return found == kSettings.end() ? nullptr : &*found;
}

}  // namespace terracut::cli
