// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <span>

#include "calib/hdl64e_calibration.hpp"
#include "firmware_io/capture/pcap_writer.hpp"
#include "firmware_io/drive/return_mode.hpp"
#include "firmware_io/hdl64e/status_stream_writer.hpp"
#include "firmware_io/hdl64e/wire.hpp"
#include "firmware_io/labelled_return.hpp"
#include "rt/error.hpp"

namespace terracut::firmware_io {

/// Sends an HDL-64E's data packets into a capture: UDP port 2368, factory addresses, the unit's
/// calibration in the status bytes. Not real-time safe (the file). One thread.
class Hdl64ePacketSender {
 public:
  /// The error is that of a calibration which does not fit into the status stream.
  [[nodiscard]] static Expected<Hdl64ePacketSender> create(
      const calib::Hdl64eCalibration& calibration, ReturnMode returns);

  /// The next packet. `first_column`: which of its group's columns it begins with.
  [[nodiscard]] Status send(std::span<const FiringColumn, kColumnsPerPacketSingle> columns,
                            int first_column, PcapWriter& capture);

 private:
  explicit Hdl64ePacketSender(const StatusStreamWriter& status) noexcept : status_(status) {}

  StatusStreamWriter status_;
  Hdl64ePacketBuffer packet_;
};

}  // namespace terracut::firmware_io
