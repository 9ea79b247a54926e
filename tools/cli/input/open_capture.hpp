// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "calib/sensor_calibration.hpp"
#include "firmware_io/capture/pcap_source.hpp"
#include "firmware_io/frame/loss_counters.hpp"
#include "rt/error.hpp"
#include "tools/cli/options.hpp"
#include "tools/cli/settings/sensor_choice.hpp"

namespace terracut::cli {

/// A capture ready to be read from its beginning, and what its packets are decoded with.
struct OpenCapture {
  capture::PcapSource source;
  SensorChoice sensor;
  calib::SensorCalibration calibration;
  std::string sensor_line;       ///< Model, spin rate, return mode, for logs and reports.
  std::string calibration_line;  ///< Origin and fingerprint; a warning where it is not the unit's.
};

/// Opens the capture, of which one unit's datagrams alone are read, and chooses sensor and
/// calibration (sensor_choice.hpp, unit_calibration.hpp). Says on stderr which they are.
[[nodiscard]] Expected<OpenCapture> open_capture(const CaptureOptions& options);

/// Says how many datagrams were left out because others sent them, where --from did not ask for
/// that. Once the capture was read.
void warn_of_other_senders(const OpenCapture& capture, const CaptureOptions& options);

/// --start and --duration, by the stamps of the capture.
class CaptureWindow {
 public:
  enum class Place : std::uint8_t { kBefore, kInside, kAfter };

  explicit CaptureWindow(const CaptureOptions& options);

  [[nodiscard]] Place place(std::int64_t stamp_ns) noexcept;

 private:
  std::int64_t start_ns_, end_ns_;
  std::optional<std::int64_t> first_ns_;
};

/// kNothingCameOut for a capture that gave no frame, naming the checks its packets failed.
/// `offered`: datagrams that the decoder was given.
[[nodiscard]] Error nothing_came_out(const capture::PcapSource& source, std::uint64_t offered,
                                     const frame::LossCounters& losses);

}  // namespace terracut::cli
