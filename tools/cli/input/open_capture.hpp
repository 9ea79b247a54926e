// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "calib/sensor_calibration.hpp"
#include "firmware_io/capture/capture_clock.hpp"
#include "firmware_io/capture/pcap_source.hpp"
#include "firmware_io/decode/decoder.hpp"
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
/// calibration (sensor_choice.hpp, unit_calibration.hpp, calibration_beside()).
[[nodiscard]] Expected<OpenCapture> open_capture(const CaptureOptions& options);

/// On stderr, for who prints no report that has these lines.
void say_what_is_read(const OpenCapture& capture);

/// The datagrams of that unit once more, from the beginning and with counters of their own.
[[nodiscard]] Expected<capture::PcapSource> open_again(const OpenCapture& capture,
                                                       const CaptureOptions& options);

/// Says how many datagrams of a pass were left out because others sent them, or sent them
/// elsewhere, where no option asked for that.
void warn_of_other_senders(const OpenCapture& capture, const capture::PcapCounters& pass,
                           const CaptureOptions& options);

/// The datagrams of a capture between --start and --duration, which go by the time that it has been
/// running (CaptureClock). Without either every datagram is among them, whatever its stamp. Those
/// outside are counted, but for the rest of the file behind some that are past the end.
class CapturePart {
 public:
  /// `source` must outlive this; it is read from where it stands, its beginning.
  CapturePart(capture::PcapSource& source, const CaptureOptions& options);

  /// The next one, valid until the next call. Null at the end, where the capture breaks off, and
  /// when stop_wanted().
  [[nodiscard]] const packet::Datagram* next();

  [[nodiscard]] const capture::CaptureClock& clock() const noexcept { return clock_; }
  [[nodiscard]] std::uint64_t before_start() const noexcept { return before_start_; }
  [[nodiscard]] std::uint64_t behind_end() const noexcept { return behind_end_; }
  /// Where it broke off; empty: it did not.
  [[nodiscard]] const std::string& fault() const noexcept { return fault_; }
  /// Whether it was left because of stop_wanted().
  [[nodiscard]] bool stopped() const noexcept { return stopped_; }
  /// Warns of what is odd about what was read: where it broke off, and stamps that step back.
  void warn_of_oddities() const;

 private:
  /// So many in a row are past the end before it is believed: a few may have odd stamps.
  static constexpr int kSurelyPast_packets = 32;

  [[nodiscard]] bool is_inside(std::int64_t since_begin_ns) noexcept;

  capture::PcapSource& source_;
  std::int64_t start_ns_, end_ns_;
  capture::CaptureClock clock_;
  bool has_begun_ = false;  ///< The part, not the capture.
  int past_end_ = 0;        ///< In a row.
  std::uint64_t before_start_ = 0, behind_end_ = 0;
  std::optional<packet::Datagram> datagram_;
  std::string fault_;
  bool stopped_ = false;
};

/// kNothingCameOut for a part of `source` that gave no frame, naming the checks its packets failed.
/// `offered`: datagrams that the decoder was given.
[[nodiscard]] Error nothing_came_out(const capture::PcapSource& source, const CapturePart& part,
                                     std::uint64_t offered, const decode::Decoder& decoder);

}  // namespace terracut::cli
