// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "configuration.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <memory>
#include <string>

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
    Setting{"input.patience_s", "--patience", "s", "live: how long to wait for the sensor at the start", 0.1, kLongest_s, {}, kAny,
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

    Setting{"motion.can", "", "", "live: CAN interface on which the vehicle tells its motion (default: none)", 0, 0, {}, TextForm::kName,
            [](C& c) noexcept -> F { return &c.live.motion.can; }},
    Setting{"motion.dbc", "", "", "DBC file that says what the vehicle's CAN frames mean (replay, live)", 0, 0, {}, kAny,
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
    Setting{"motion.max_age_ms", "", "ms", "Signals older than this are not used", 1, 10000, {}, kAny,
            [](C& c) noexcept -> F { return &c.live.motion.max_age_ms; }},
    Setting{"motion.timeout_ms", "", "ms", "Without speed and yaw rate for so long, the motion is lost", 1, 60000, {}, kAny,
            [](C& c) noexcept -> F { return &c.live.motion.timeout_ms; }},

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
    Setting{"output.stream", "--stream", "", "live: where other programs get labelled points: ADDRESS:PORT, PORT or a socket's path (default: nowhere)", 0, 0, {}, kAny,
            [](C& c) noexcept -> F { return &c.live.stream; }},
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

template <class... Visitors>
struct Overloaded : Visitors... {
  using Visitors::operator()...;
};

tl::unexpected<Error> wrong(std::string_view expected, std::string_view found) {
  return fail(ErrorCode::kInvalidArgument, fmt::format("expected {}, found '{}'", expected, found));
}

bool is_whole(const SettingField& field) {
  return !std::holds_alternative<double*>(field) &&
         !std::holds_alternative<std::optional<double>*>(field);
}

Expected<double> parse_number(const Setting& setting, bool whole, std::string_view text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool read = error == std::errc{} && end == text.data() + text.size();
  if (read && number >= setting.least && number <= setting.most &&
      (!whole || number == std::floor(number))) {
    return number;
  }
  return wrong(fmt::format("a {}number from {} to {}{}{}", whole ? "whole " : "", setting.least,
                           setting.most, setting.unit.empty() ? "" : " ", setting.unit),
               text);
}

bool is_address(std::string_view text) {
  in_addr address{};
  return ::inet_pton(AF_INET, std::string(text).c_str(), &address) == 1;
}

bool is_endpoint(std::string_view text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string_view::npos || !is_address(text.substr(0, colon))) return false;
  const std::string_view port = text.substr(colon + 1);
  std::uint16_t number = 0;
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), number);
  return error == std::errc{} && end == port.data() + port.size() && number != 0;
}

bool is_name(std::string_view text) {
  constexpr std::string_view kAllowed =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.";
  return !text.empty() && text.size() <= 64 && text.front() != '.' &&
         text.find_first_not_of(kAllowed) == std::string_view::npos;
}

std::string_view description(TextForm form) {
  switch (form) {
    case TextForm::kAddress:
      return "an IPv4 address";
    case TextForm::kEndpoint:
      return "an IPv4 ADDRESS:PORT";
    case TextForm::kEndpointOrOff:
      return "an IPv4 ADDRESS:PORT or off";
    case TextForm::kName:
      return "a name of letters, digits, '-', '_' and '.'";
    case TextForm::kAny:
      break;
  }
  return "text";
}

bool fits(TextForm form, std::string_view text) {
  switch (form) {
    case TextForm::kAddress:
      return is_address(text);
    case TextForm::kEndpoint:
      return is_endpoint(text);
    case TextForm::kEndpointOrOff:
      return text == "off" || is_endpoint(text);
    case TextForm::kName:
      return is_name(text);
    case TextForm::kAny:
      break;
  }
  return !text.empty();
}

Status check_text(const Setting& setting, std::string_view text) {
  if (!setting.choices.empty()) {
    if (std::ranges::find(setting.choices, text) != setting.choices.end()) return {};
    return wrong(fmt::format("one of {}", fmt::join(setting.choices, ", ")), text);
  }
  if (!fits(setting.form, text)) return wrong(description(setting.form), text);
  return {};
}

/// The model for commands that cannot find one out.
void take_model(const Configuration& configuration, std::string& sensor) {
  const std::string& model = configuration.live.capture.sensor;
  if (model != "auto") sensor = model;
}

MethodOptions method_of(const Configuration& configuration) {
  MethodOptions method = configuration.live.method;
  method.settings.clear();
  return method;
}

}  // namespace

std::span<const Setting> settings() noexcept {
  return kSettings;
}

const Setting* find_setting(std::string_view key) noexcept {
  const auto found = std::ranges::find(kSettings, key, &Setting::key);
  return found == kSettings.end() ? nullptr : &*found;
}

std::string allowed_text(const Setting& setting) {
  if (!setting.choices.empty()) return fmt::format("{}", fmt::join(setting.choices, ", "));
  Configuration scratch;
  return std::visit(
      Overloaded{[](const bool*) { return std::string("yes, no"); },
                 [](const std::filesystem::path*) { return std::string("file or folder"); },
                 [&](const std::string*) { return std::string(description(setting.form)); },
                 [&](const auto*) { return fmt::format("{} .. {}", setting.least, setting.most); }},
      setting.field(scratch));
}

Status apply_text(const Setting& setting, std::string_view text, const std::filesystem::path& base,
                  Configuration& configuration) {
  const SettingField field = setting.field(configuration);
  const auto set_number = [&]<class Value>(Value* value, auto cast) -> Status {
    const Expected<double> number = parse_number(setting, is_whole(field), text);
    if (!number) return tl::unexpected(number.error());
    *value = static_cast<decltype(cast)>(*number);
    return {};
  };
  return std::visit(
      Overloaded{
          [&](bool* value) -> Status {
            const bool yes = text == "yes" || text == "true";
            if (!yes && text != "no" && text != "false") return wrong("yes or no", text);
            *value = yes;
            return {};
          },
          [&](std::filesystem::path* value) -> Status {
            if (text.empty()) return wrong("a file or folder", text);
            *value = base / text;  // an absolute text replaces the base
            return {};
          },
          [&](std::string* value) -> Status {
            if (Status valid = check_text(setting, text); !valid) return valid;
            *value = std::string(text);
            return {};
          },
          [&](double* value) { return set_number(value, double{}); },
          [&](std::optional<double>* value) { return set_number(value, double{}); },
          [&](int* value) { return set_number(value, int{}); },
          [&](std::optional<int>* value) { return set_number(value, int{}); },
          [&](std::uint64_t* value) { return set_number(value, std::uint64_t{}); },
          [&](std::uint16_t* value) { return set_number(value, std::uint16_t{}); },
          [&](std::optional<std::uint16_t>* value) { return set_number(value, std::uint16_t{}); }},
      field);
}

std::string value_text(const Setting& setting, const Configuration& configuration) {
  Configuration copy = configuration;
  return std::visit(Overloaded{[](const bool* value) { return std::string(*value ? "yes" : "no"); },
                               [](const std::filesystem::path* value) { return value->string(); },
                               [](const std::string* value) { return *value; },
                               []<class T>(const std::optional<T>* value) {
                                 return *value ? fmt::format("{}", **value) : std::string();
                               },
                               [](const auto* value) { return fmt::format("{}", *value); }},
                    setting.field(copy));
}

void start_from(const Configuration& configuration, ReplayOptions& options) {
  options.capture = configuration.live.capture;
  options.mount = configuration.live.mount;
  options.method = method_of(configuration);
  options.motion = configuration.live.motion;
  options.output = configuration.output;
  options.rate = configuration.replay.rate;
  options.loops = configuration.replay.loops;
}

void start_from(const Configuration& configuration, SegmentOptions& options) {
  options.mount = configuration.live.mount;
  options.method = method_of(configuration);
  options.output = configuration.output;
  options.output.truth.clear();
}

void start_from(const Configuration& configuration, SimulateOptions& options) {
  options = configuration.simulate;
  take_model(configuration, options.sensor);
  options.calibration = configuration.live.capture.calibration;
  options.mount = configuration.live.mount;
}

void start_from(const Configuration& configuration, EncodeOptions& options) {
  take_model(configuration, options.sensor);
  options.calibration = configuration.live.capture.calibration;
}

void start_from(const Configuration& configuration, CalibrateOptions& options) {
  options.capture = configuration.live.capture;
  options.mount = configuration.live.mount;
  options.method = method_of(configuration);
}

void start_from(const Configuration& configuration, PlanOptions& options) {
  take_model(configuration, options.sensor);
  options.method = method_of(configuration);
}

void start_from(const Configuration& configuration, BenchOptions& options) {
  options.capture = configuration.live.capture;
  options.mount = configuration.live.mount;
  options.method = method_of(configuration);
  options.repeat = configuration.bench.repeat;
  options.core = configuration.bench.core;
}

void start_from(const Configuration& configuration, EvalOptions& options) {
  options.mount = configuration.live.mount;
}

void start_from(const Configuration& configuration, LiveOptions& options) {
  options = configuration.live;
  options.labels = configuration.output.labels;
  options.json = configuration.output.json;
  options.method = method_of(configuration);
}

void start_from(const Configuration& configuration, ConfigOptions& options) {
  options.configuration = std::make_shared<const Configuration>(configuration);
}

void start_from(const Configuration& configuration, DoctorOptions& options) {
  const std::string& listen = configuration.live.listen.address;
  options.interface = configuration.live.listen.interface;
  options.port = static_cast<std::uint16_t>(std::stoi(listen.substr(listen.rfind(':') + 1)));
  options.receive_core = configuration.live.realtime.receive_core;
  options.segment_core = configuration.live.realtime.segment_core;
}

}  // namespace terracut::cli
