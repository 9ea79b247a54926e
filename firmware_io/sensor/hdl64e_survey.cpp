// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/sensor/hdl64e_survey.hpp"

#include <algorithm>

#include "firmware_io/hdl64e/packet_check.hpp"

namespace terracut::sensor {

void Hdl64eSurvey::add(std::span<const std::uint8_t> payload) {
  const auto* packet = hdl64e::packet_in(payload);
  if (packet == nullptr) return;
  status_.add(packet->status_type, packet->status_value, packet->stamp_us.value());
  packet::PacketAzimuths azimuths;
  const auto reject = hdl64e::check_hdl64e_packet(payload, azimuths);
  if (reject && azimuths.columns == 0) return;  // the block ids contradict the model
  if (reject == frame::Reject::kAzimuthOutOfRange) {
    stream_.add_out_of_range();
  } else {
    stream_.add(azimuths, !reject);
  }
}

Hdl64eFacts Hdl64eSurvey::facts() const {
  Hdl64eFacts facts{stream_.facts(), status_.latest(), status_.holes(), std::nullopt};
  if (status_.has_table()) {
    facts.table.emplace();
    std::copy(status_.table().begin(), status_.table().end(), facts.table->begin());
  }
  return facts;
}

}  // namespace terracut::sensor
