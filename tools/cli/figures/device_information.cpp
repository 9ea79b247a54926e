// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/figures/device_information.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cstdint>
#include <string_view>

namespace terracut::cli {
namespace {

using sensor::DeviceReader;
using sensor::SensorModel;
using Json = nlohmann::ordered_json;

/// Describes the angles in DIFOP: "complete, fingerprint ...", or why they cannot be used.
std::string calibration_in(const DeviceReader& device, SensorModel model) {
  const auto& calibration = device.calibration(model);
  if (!calibration) return calibration.error().message;
  return fmt::format("complete, fingerprint {:016x}", calib::fingerprint(*calibration));
}

/// Returns two digits a byte: "00:1c:23".
std::string hex_text(const std::array<std::uint8_t, 6>& bytes, std::string_view separator) {
  return fmt::format("{:02x}", fmt::join(bytes, separator));
}

}  // namespace

std::string device_text(const DeviceReader& device, SensorModel model) {
  const auto& info = device.newest();
  if (!info) return {};
  // The other models send what is said of frames and time elsewhere.
  const bool is_ruby128 = model == SensorModel::kRuby128;
  const std::string frames =
      is_ruby128 ? fmt::format(", frames at {}", info->rpm_actual.value()) : "";
  const std::string time =
      is_ruby128 ? fmt::format("  time         by {}, status {}\n",
                               ruby128::sync_mode_name(info->sync_mode), info->sync_status)
                 : "";
  return fmt::format(
      "  serial       {}\n  set to       {} rpm{}; return mode {} ({})\n"
      "  network      {} to {}, data port {}, device port {}, MAC {}\n"
      "{}  calibration  {}\n"
      "  changes      {} of the serial number, {} of the angles\n",
      hex_text(info->serial, ""), info->rpm_set.value(), frames, info->return_mode,
      info->return_mode == (is_ruby128 ? 3 : 0) ? "dual" : "single",
      fmt::join(info->device_address, "."), fmt::join(info->destination_address, "."),
      info->data_port.value(), info->device_port.value(), hex_text(info->mac, ":"), time,
      calibration_in(device, model), device.counters().serial_changes,
      device.counters().angle_changes);
}

Json device_json(const DeviceReader& device, SensorModel model) {
  const auto& info = device.newest();
  if (!info) return {};
  Json json{{"packets", device.counters().packets},
            {"serial", hex_text(info->serial, "")},
            {"rpm_set", info->rpm_set.value()},
            {"return_mode", info->return_mode},
            {"data_port", info->data_port.value()},
            {"device_port", info->device_port.value()},
            {"calibration", calibration_in(device, model)},
            {"serial_changes", device.counters().serial_changes},
            {"angle_changes", device.counters().angle_changes}};
  if (model != SensorModel::kRuby128) return json;
  json["rpm_actual"] = info->rpm_actual.value();
  json["sync_mode"] = ruby128::sync_mode_name(info->sync_mode);
  json["sync_status"] = info->sync_status;
  return json;
}

}  // namespace terracut::cli
