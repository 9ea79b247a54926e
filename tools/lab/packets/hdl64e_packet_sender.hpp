// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <span>

#include "calib/hdl64e/hdl64e_calibration.hpp"
#include "firmware_io/capture/pcap_writer.hpp"
#include "firmware_io/hdl64e/firing_times.hpp"
#include "firmware_io/packet/hdl64e_wire.hpp"
#include "rt/error.hpp"
#include "tools/lab/packets/labelled_return.hpp"
#include "tools/lab/packets/return_mode.hpp"
#include "tools/lab/tables/status_stream_writer.hpp"

namespace terracut::packets {

/// Writes an HDL-64E's data packets into a capture: UDP port 2368, factory addresses, the unit's
/// calibration in the status bytes. Writes a file, so it is not real-time safe. One thread.
class Hdl64ePacketSender {
 public:
  /// Fails if a calibration does not fit into the status stream.
  [[nodiscard]] static Expected<Hdl64ePacketSender> create(
      const hdl64e::Hdl64eCalibration& calibration, ReturnMode returns);

  /// Writes the next packet from its columns. `first_column` is the index of the packet's first
  /// column in its group of firings.
  [[nodiscard]] Status send(std::span<const FiringColumn> columns, int first_column,
                            capture::PcapWriter& capture);

 private:
  explicit Hdl64ePacketSender(const tables::StatusStreamWriter& status) noexcept
      : status_(status) {}

  tables::StatusStreamWriter status_;
  hdl64e::wire::Packet packet_ = hdl64e::blank_packet();
};

}  // namespace terracut::packets
