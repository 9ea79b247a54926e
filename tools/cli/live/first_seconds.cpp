// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "first_seconds.hpp"

#include <fmt/format.h>

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "calib/hdl64e_stream_table.hpp"
#include "firmware_io/capture/sensor_probe.hpp"
#include "firmware_io/hdl64e/status_stream_reader.hpp"
#include "firmware_io/hdl64e/wire.hpp"
#include "firmware_io/ruby128/device_reader.hpp"
#include "tools/cli/calibration_choice.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/stop_signal.hpp"

namespace terracut::cli {
namespace {

using firmware_io::Datagram;
using firmware_io::SensorModel;
using SteadyClock = std::chrono::steady_clock;

constexpr std::pair<const char*, SensorModel> kSensors[] = {{"hdl64e", SensorModel::kHdl64e},
                                                            {"ruby128", SensorModel::kRuby128}};

/// What came from one address.
struct Sender {
  firmware_io::SensorProbe probe;
  firmware_io::StatusStreamReader hdl64e_status;
  firmware_io::Ruby128DeviceReader ruby128_device;

  void add(std::span<const std::uint8_t> payload) {
    probe.add(payload);
    (void)ruby128_device.add(payload);
    const auto packet = firmware_io::Hdl64ePacketView::of(payload);
    if (packet && packet->is_hdl64e()) {
      hdl64e_status.add(packet->status_type(), packet->status_value(), packet->stamp_us());
    }
  }
  [[nodiscard]] bool has_calibration(SensorModel model) const {
    return model == SensorModel::kRuby128 ? ruby128_device.has_calibration()
                                          : hdl64e_status.has_table();
  }
};

class Listening {
 public:
  Listening(LiveSource& source, const LiveOptions& options) : source_(source), options_(options) {}

  Expected<SensorOnAir> run() {
    open_device_port();
    const auto end = SteadyClock::now() + std::chrono::duration<double>(options_.patience_s);
    while (!knows_enough() && SteadyClock::now() < end && !stop_wanted()) {
      constexpr std::int64_t kAWhile_ns = 50'000'000;
      hear(source_, kAWhile_ns);
      if (device_) hear(*device_, 0);
    }
    return conclude();
  }

 private:
  /// More senders than these are somebody's port scan.
  static constexpr std::size_t kMostSenders = 64;

  [[nodiscard]] bool wants(SensorModel model) const {
    for (const auto& [name, known] : kSensors) {
      if (known == model)
        return options_.capture.sensor == "auto" || options_.capture.sensor == name;
    }
    return false;
  }

  void open_device_port() {
    if (!wants(SensorModel::kRuby128) || !options_.capture.calibration.empty()) return;
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
    for (const Datagram& datagram : source.receive(timeout_ns)) {
      const auto known = senders_.find(datagram.source_address);
      if (known == senders_.end() && senders_.size() >= kMostSenders) continue;
      senders_[datagram.source_address].add(datagram.payload);
    }
  }

  [[nodiscard]] bool knows_enough() const {
    for (const auto& [address, sender] : senders_) {
      for (const auto& [name, model] : kSensors) {
        if (!wants(model) || !sender.probe.knows(model)) continue;
        if (!options_.capture.calibration.empty() || sender.has_calibration(model)) return true;
      }
    }
    return false;
  }

  [[nodiscard]] Expected<SensorOnAir> conclude() const {
    std::vector<std::pair<std::uint32_t, SensorModel>> found;
    for (const auto& [address, sender] : senders_) {
      for (const auto& [name, model] : kSensors) {
        if (wants(model) && sender.probe.packets_of(model) > 0) found.emplace_back(address, model);
      }
    }
    if (found.empty()) return tl::unexpected(nobody());
    if (found.size() > 1) return tl::unexpected(several(found));
    const auto [address, model] = found.front();
    const Sender& sender = senders_.at(address);
    auto calibration = calibration_of(model, sender);
    if (!calibration) return tl::unexpected(calibration.error());
    return SensorOnAir{.address = address,
                       .model = model,
                       .columns = options_.capture.columns.value_or(sender.probe.columns(model)),
                       .spin_hz = sender.probe.spin_hz(model),
                       .dual_return = sender.probe.dual_return(model),
                       .calibration = *std::move(calibration)};
  }

  [[nodiscard]] Error nobody() const {
    std::string heard;
    for (const auto& [address, sender] : senders_) {
      std::string models = sender.probe.foreign_models();
      if (models.empty()) {
        models = fmt::format("{} datagrams of no sensor known here",
                             sender.probe.packets_of(SensorModel::kUnknown));
      }
      heard += fmt::format("{}{} from {}", heard.empty() ? "" : "; ", models,
                           firmware_io::ipv4_text(address));
    }
    if (const auto& counted = source_.counters(); heard.empty() && counted.foreign > 0) {
      heard = fmt::format("{} datagrams from other addresses than --from", counted.foreign);
    }
    const std::string& sensor = options_.capture.sensor;
    return {ErrorCode::kUnsupported,
            fmt::format("no data packets of {} came to {} within {:g} s: {}",
                        sensor == "auto" ? "an HDL-64E or RS-Ruby128" : sensor, source_.name(),
                        options_.patience_s,
                        heard.empty() ? "nothing came at all; `terracut doctor` and tcpdump tell "
                                        "whether anything reaches this machine"
                                      : heard)};
  }

  [[nodiscard]] static Error several(
      const std::vector<std::pair<std::uint32_t, SensorModel>>& found) {
    std::string all;
    for (const auto& [address, model] : found) {
      all += fmt::format("{}{} at {}", all.empty() ? "" : ", ", to_string(model),
                         firmware_io::ipv4_text(address));
    }
    return {ErrorCode::kInvalidArgument,
            fmt::format("several sensors send here: {}; choose one with --from", all)};
  }

  [[nodiscard]] Expected<calib::SensorCalibration> calibration_of(SensorModel model,
                                                                  const Sender& sender) const {
    return choose_calibration(options_.capture, model, [&] {
      return model == SensorModel::kRuby128 ? told_by_ruby128(sender) : told_by_hdl64e(sender);
    });
  }

  [[nodiscard]] Expected<calib::SensorCalibration> told_by_ruby128(const Sender& sender) const {
    auto told = sender.ruby128_device.calibration();
    if (told) return *std::move(told);
    return fail(ErrorCode::kNoCalibration,
                fmt::format("no angles of this RS-Ruby128: none were given, and what it says of "
                            "itself to port {} does not hold them: {}. Give the unit's angle.csv "
                            "with --calibration FILE, or consent to the model's table with "
                            "--nominal-calibration",
                            options_.listen.device_port, told.error().message));
  }

  [[nodiscard]] static Expected<calib::SensorCalibration> told_by_hdl64e(const Sender& sender) {
    if (!sender.hdl64e_status.has_table()) {
      return fail(ErrorCode::kNoCalibration,
                  fmt::format("none was given, and {} bytes of the table in the packets are "
                              "missing; give the unit's db.xml or yaml with --calibration FILE",
                              sender.hdl64e_status.holes()));
    }
    auto table = calib::parse_stream_table(sender.hdl64e_status.table());
    if (!table) return tl::unexpected(table.error());
    return std::move(table->calibration);
  }

  LiveSource& source_;
  const LiveOptions& options_;
  rt::FixedMemory memory_;  ///< Of the device port's socket.
  std::optional<LiveSource> device_;
  std::map<std::uint32_t, Sender> senders_;
};

}  // namespace

Expected<SensorOnAir> listen_for_sensor(LiveSource& source, const LiveOptions& options) {
  return Listening(source, options).run();
}

}  // namespace terracut::cli
