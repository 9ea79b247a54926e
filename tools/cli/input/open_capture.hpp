// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "bag_pose.hpp"
#include "calib/sensor_calibration.hpp"
#include "firmware_io/capture/capture_clock.hpp"
#include "firmware_io/capture/capture_source.hpp"
#include "firmware_io/decode/decoder.hpp"
#include "rt/error.hpp"
#include "tools/cli/options.hpp"
#include "tools/cli/settings/sensor_choice.hpp"

namespace terracut::cli {

/// A capture about to be read from its beginning, and what is needed to decode its packets.
struct OpenCapture {
  capture::CaptureSource source;
  SensorChoice sensor;
  calib::SensorCalibration calibration;
  std::string sensor_line;       ///< Model, spin rate, return mode, for logs and reports.
  std::string calibration_line;  ///< Origin, fingerprint; warns if not the unit's.
  BagPose bag_pose;              ///< What a bag says of the mount.
};

/// Opens the capture, filtered to the datagrams of one unit, and chooses sensor and calibration
/// (sensor_choice.hpp, unit_calibration.hpp, calibration_beside()).
[[nodiscard]] Expected<OpenCapture> open_capture(const CaptureOptions& options);

/// Prints the sensor and calibration lines on stderr, for commands without a report.
void say_what_is_read(const OpenCapture& capture);

/// Opens the same unit's datagrams again, from the beginning and with separate counters.
[[nodiscard]] Expected<capture::CaptureSource> open_again(const OpenCapture& capture,
                                                          const CaptureOptions& options);

/// Reports how many datagrams of a pass were left out because of their sender or destination,
/// except if an option asked for that.
void warn_of_other_senders(const OpenCapture& capture, const capture::CaptureCounters& pass,
                           const CaptureOptions& options);

/// The datagrams of a capture between --start and --duration, by the capture's running time
/// (CaptureClock). Without these options all datagrams belong to the part, whatever their stamps.
/// Datagrams outside the part are counted; reading stops soon after its end.
class CapturePart {
 public:
  /// Reads `source`, which must be at its beginning and outlive this object.
  CapturePart(capture::CaptureSource& source, const CaptureOptions& options);

  /// Returns the next datagram, valid until the next call. Returns null at the end, where the
  /// capture breaks off, and when stop_wanted().
  [[nodiscard]] const packet::Datagram* next();

  [[nodiscard]] const capture::CaptureClock& clock() const noexcept { return clock_; }
  [[nodiscard]] std::uint64_t before_start() const noexcept { return before_start_; }
  [[nodiscard]] std::uint64_t behind_end() const noexcept { return behind_end_; }
  /// Returns where the capture broke off; empty if it did not.
  [[nodiscard]] const std::string& fault() const noexcept { return fault_; }
  /// True if reading ended because of stop_wanted().
  [[nodiscard]] bool stopped() const noexcept { return stopped_; }
  /// Warns if the capture broke off or its stamps step back.
  void warn_of_oddities() const;

 private:
  /// The part ends only after this many successive datagrams beyond it, because a few may have odd
  /// stamps.
  static constexpr int kSurelyPast_packets = 32;

  [[nodiscard]] bool is_inside(std::int64_t since_begin_ns) noexcept;

  capture::CaptureSource& source_;
  std::int64_t start_ns_, end_ns_;
  capture::CaptureClock clock_;
  bool has_begun_ = false;  ///< True once the part, not only the capture, has begun.
  int past_end_ = 0;        ///< Successive datagrams beyond the end.
  std::uint64_t before_start_ = 0, behind_end_ = 0;
  std::optional<packet::Datagram> datagram_;
  std::string fault_;
  bool stopped_ = false;
};

/// Returns kNothingCameOut for a part of `source` without a frame; the message names the checks
/// that its packets failed. `offered` is the number of datagrams given to the decoder.
[[nodiscard]] Error nothing_came_out(const capture::CaptureSource& source, const CapturePart& part,
                                     std::uint64_t offered, const decode::Decoder& decoder);

}  // namespace terracut::cli
