// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "first_seconds.hpp"

#include <fmt/format.h>

#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "calib/hdl64e_stream_table.hpp"
#include "heard_senders.hpp"
#include "tools/cli/calibration_choice.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/stop_signal.hpp"

namespace terracut::cli {
namespace {

using firmware_io::SensorModel;
using SteadyClock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

/// Another sensor at the same port shows within this time, after the first.
constexpr std::int64_t kSettled_ns = 300'000'000;
/// A sensor that turns tells its calibration within this, if at all: an HDL-64E takes 1.2 s.
constexpr std::int64_t kTold_ns = 6'000'000'000;

std::optional<SensorModel> wanted_model(const std::string& sensor) {
  if (sensor == "hdl64e") return SensorModel::kHdl64e;
  if (sensor == "ruby128") return SensorModel::kRuby128;
  return std::nullopt;
}

class Listening {
 public:
  Listening(LiveSource& source, const LiveOptions& options, const OnWaiting& on_waiting)
      : source_(source),
        options_(options),
        on_waiting_(on_waiting),
        senders_(wanted_model(options.capture.sensor)) {}

  Expected<SensorOnAir> run() {
    open_device_port();
    const auto begun = SteadyClock::now();
    const auto is_over = [&] {
      return options_.patience_s && SteadyClock::now() - begun >= Seconds(*options_.patience_s);
    };
    while (!knows_enough() && !is_over() && !stop_wanted()) {
      constexpr std::int64_t kAWhile_ns = 50'000'000;
      hear(source_, kAWhile_ns);
      if (device_) hear(*device_, 0);
      on_waiting_(waits_for());
    }
    return conclude();
  }

 private:
  void open_device_port() {
    if (!senders_.wants(SensorModel::kRuby128) || !options_.capture.calibration.empty()) return;
    if (options_.listen.device_port == 0) return;
    ListenOptions listen = options_.listen;
    listen.share_port = true;  // who else listens there shall go on doing so
    auto opened = LiveSource::open(listen, options_.listen.device_port, std::nullopt, memory_);
    if (opened) {
      device_.emplace(*std::move(opened));
    } else if (options_.capture.sensor == "ruby128") {
      warn("the sensor's device information is not heard: " + opened.error().message);
    }
  }

  void hear(LiveSource& source, std::int64_t timeout_ns) {
    for (const firmware_io::Datagram& datagram : source.receive(timeout_ns)) {
      senders_.add(datagram);
    }
  }

  [[nodiscard]] bool knows_enough() const {
    const auto sensors = senders_.turning();
    if (sensors.empty() || senders_.known_for_ns() < kSettled_ns) return false;
    return sensors.size() > 1 || !options_.capture.calibration.empty() ||
           senders_.has_told(sensors.front()) || senders_.known_for_ns() >= kTold_ns;
  }

  /// For people: what is missing.
  [[nodiscard]] std::string waits_for() const {
    if (const auto sensors = senders_.turning(); !sensors.empty()) {
      return fmt::format("{} at {} is heard; waiting for its calibration",
                         to_string(sensors.front().model),
                         firmware_io::ipv4_text(sensors.front().address));
    }
    const std::string heard = heard_instead();
    return fmt::format("waiting for {} at {}{}", sensor_name(), source_.name(),
                       heard.empty() ? "" : ": " + heard);
  }

  [[nodiscard]] Expected<SensorOnAir> conclude() const {
    auto found = senders_.turning();
    if (found.empty()) found = senders_.steady();
    if (found.empty()) return tl::unexpected(nobody());
    if (found.size() > 1) return tl::unexpected(several(found));
    const auto [address, model] = found.front();
    const firmware_io::SensorProbe& probe = senders_.probe(address);
    auto calibration = calibration_of(model, address);
    if (!calibration) return tl::unexpected(calibration.error());
    return SensorOnAir{.address = address,
                       .model = model,
                       .columns = options_.capture.columns.value_or(probe.columns(model)),
                       .spin_hz = probe.spin_hz(model),
                       .dual_return = probe.dual_return(model),
                       .calibration = *std::move(calibration)};
  }

  [[nodiscard]] std::string sensor_name() const {
    const std::string& sensor = options_.capture.sensor;
    return sensor == "auto" ? "an HDL-64E or RS-Ruby128" : sensor;
  }
  [[nodiscard]] std::string heard_instead() const {
    std::string heard = senders_.others();
    if (const auto& counted = source_.counters(); heard.empty() && counted.foreign > 0) {
      heard = fmt::format("{} datagrams from other addresses than --from", counted.foreign);
    }
    return heard;
  }

  [[nodiscard]] Error nobody() const {
    const std::string heard = heard_instead();
    const std::string patience =
        options_.patience_s ? fmt::format(" within {:g} s", *options_.patience_s) : "";
    return {ErrorCode::kUnsupported,
            fmt::format("no data packets of {} came to {}{}: {}", sensor_name(), source_.name(),
                        patience,
                        heard.empty() ? "nothing came at all; `terracut doctor` and tcpdump tell "
                                        "whether anything reaches this machine"
                                      : heard)};
  }

  [[nodiscard]] static Error several(const std::vector<HeardSenders::Sensor>& found) {
    std::string all;
    for (const auto& [address, model] : found) {
      all += fmt::format("{}{} at {}", all.empty() ? "" : ", ", to_string(model),
                         firmware_io::ipv4_text(address));
    }
    return {ErrorCode::kInvalidArgument,
            fmt::format("several sensors send here: {}; choose one with --from", all)};
  }

  [[nodiscard]] Expected<calib::SensorCalibration> calibration_of(SensorModel model,
                                                                  std::uint32_t address) const {
    return choose_calibration(options_.capture, model, [&] {
      return model == SensorModel::kRuby128 ? told_by_ruby128(address) : told_by_hdl64e(address);
    });
  }

  [[nodiscard]] Expected<calib::SensorCalibration> told_by_ruby128(std::uint32_t address) const {
    auto told = senders_.ruby128_device(address).calibration();
    if (told) return *std::move(told);
    return fail(ErrorCode::kNoCalibration,
                fmt::format("no angles of this RS-Ruby128: none were given, and what it says of "
                            "itself to port {} does not hold them: {}. Give the unit's angle.csv "
                            "with --calibration FILE, or consent to the model's table with "
                            "--nominal-calibration",
                            options_.listen.device_port, told.error().message));
  }

  [[nodiscard]] Expected<calib::SensorCalibration> told_by_hdl64e(std::uint32_t address) const {
    const firmware_io::StatusStreamReader& status = senders_.hdl64e_status(address);
    if (!status.has_table()) {
      return fail(ErrorCode::kNoCalibration,
                  fmt::format("none was given, and {} bytes of the table in the packets are "
                              "missing; give the unit's db.xml or yaml with --calibration FILE",
                              status.holes()));
    }
    auto table = calib::parse_stream_table(status.table());
    if (!table) return tl::unexpected(table.error());
    return std::move(table->calibration);
  }

  LiveSource& source_;
  const LiveOptions& options_;
  const OnWaiting& on_waiting_;
  rt::FixedMemory memory_;  ///< Of the device port's socket.
  std::optional<LiveSource> device_;
  HeardSenders senders_;
};

}  // namespace

Expected<SensorOnAir> listen_for_sensor(LiveSource& source, const LiveOptions& options,
                                        const OnWaiting& on_waiting) {
  return Listening(source, options, on_waiting).run();
}

}  // namespace terracut::cli
