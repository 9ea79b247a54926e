// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/sensor/ruby128_survey.hpp"

#include "firmware_io/packet/ruby128_wire.hpp"
#include "firmware_io/ruby128/packet_check.hpp"

namespace terracut::sensor {

void Ruby128Survey::add(std::span<const std::uint8_t> payload, std::int64_t stamp_ns) {
  const auto* packet = ruby128::packet_in(payload);
  if (packet == nullptr) return;
  packet::PacketAzimuths azimuths;
  auto reject = ruby128::check_ruby128_packet(payload, azimuths);
  if (reject && azimuths.columns == 0) return;  // the block ids contradict the model
  const bool may_have_sector =
      reject == frame::Reject::kAzimuthJump && ruby128::read_across_sector(azimuths, step_ticks_);
  if (may_have_sector && stream_.blind().is_inside(azimuths)) reject.reset();
  if (!reject) step_ticks_ = azimuths.step_ticks;
  const ruby128::RubyTimestamp encoding = timestamp_.add(packet->stamp);
  const std::int64_t device_ns = ruby128::read_ruby_timestamp(packet->stamp, encoding);
  last_.protocol_version = packet->protocol_version.value();
  last_.ahead_of_capture_s = static_cast<double>(device_ns - stamp_ns) * 1e-9;
  last_.temperature_deg_c = ruby128::ruby_temperature_deg_c(packet->temperature.value());
  azimuths.device_stamp_us = ruby128::ruby_even_stamp_us(device_ns, azimuths, !reject);
  if (reject == frame::Reject::kAzimuthOutOfRange) {
    stream_.add_out_of_range();
  } else {
    stream_.add(azimuths, !reject);
  }
}

Ruby128Facts Ruby128Survey::facts() const {
  Ruby128Facts facts = last_;
  static_cast<StreamFacts&>(facts) = stream_.facts();
  facts.timestamp = timestamp_.encoding();
  facts.timestamp_proven = timestamp_.complete();
  return facts;
}

}  // namespace terracut::sensor
