// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/sensor/sensor_probe.hpp"

#include <fmt/format.h>

#include <cmath>

#include "firmware_io/hdl64e/hdl64e_sensor.hpp"
#include "firmware_io/packet/ruby128_wire.hpp"
#include "firmware_io/packet/sensor_recognition.hpp"
#include "firmware_io/ruby128/packet_check.hpp"
#include "firmware_io/ruby128/ruby128_sensor.hpp"

namespace terracut::sensor {
namespace {

constexpr std::uint64_t kEnoughPackets = 50;
/// A longer step between packets is a gap, across which the head's rotation is unknown.
constexpr std::int64_t kLongestStep_us = 5'000;
/// Sensors keep to their set spin rate within 2 %, but KITTI's sensor runs at 9.65 Hz.
constexpr double kNominalTolerance = 0.03;

/// Returns the firing period. An HDL-64E fires every 48 us; in dual return mode, and some S3 units
/// in every mode, every 57.6 us.
double firing_s(SensorModel model, bool fires_slowly) {
  if (model == SensorModel::kRuby128) return ruby128::kRubyBlock_ns * 1e-9;
  if (const auto* layout = velodyne::layout_of(model)) return layout->firing_ns * 1e-9;
  if (hesai::Models::has(model)) return hesai::layout_of(model).column_ns * 1e-9;
  if (robosense::Models::has(model)) return robosense::layout_of(model).column_ns * 1e-9;
  if (model == SensorModel::kHdl64eS1) return hdl64e::kS1UpperFiring_ns * 1e-9;
  return (fires_slowly ? hdl64e::kFiringTimesDual : hdl64e::kFiringTimesSingle48).column_ns * 1e-9;
}

/// True if a step between adjacent packets is closer to that of a 57.6 us firing period than to
/// that of 48 us.
bool is_slow_step(std::int64_t step_us) {
  constexpr std::int64_t kBetween_ns =
      (hdl64e::kFiringTimesSingle48.packet_ns() + hdl64e::kFiringTimesSingle57.packet_ns()) / 2;
  constexpr std::int64_t kLongest_ns = hdl64e::kFiringTimesSingle57.packet_ns() * 9 / 8;
  return step_us * 1000 > kBetween_ns && step_us * 1000 < kLongest_ns;
}

/// Returns the nominal spin rate near `seen_hz`, or else `seen_hz` itself; nothing outside 5 to 20
/// Hz, because no sensor rotates slower or faster.
std::optional<double> head_spin_hz(double seen_hz) {
  for (const double nominal_hz : {5.0, 10.0, 15.0, 20.0}) {
    if (std::abs(seen_hz - nominal_hz) < kNominalTolerance * nominal_hz) return nominal_hz;
  }
  return seen_hz > 5 && seen_hz < 20 ? std::optional(seen_hz) : std::nullopt;
}

}  // namespace

void SensorProbe::Head::add(const packet::PacketAzimuths& azimuths) {
  ++packets;
  dual_packets += azimuths.dual_return ? 1 : 0;
  if (last) {
    const std::int64_t step_us = azimuths.device_stamp_us - last->device_stamp_us;
    const int step_cdeg = beams::step_cdeg(last->first_cdeg(), azimuths.first_cdeg());
    if (step_us > 0 && step_us < kLongestStep_us && step_cdeg > 0) {
      rotated_cdeg += step_cdeg;
      time_us += step_us;
      slow_steps += is_slow_step(step_us) ? 1 : 0;
    }
  }
  last = azimuths;
}

void SensorProbe::add(const packet::Datagram& datagram) {
  const SensorModel model = recognise_sensor_as(named_, datagram.payload);
  ++votes_[model];
  if (model == SensorModel::kOtherVelodyne) other_product_ = datagram.payload.back();
  if (!is_decoded(model)) return;
  packet::PacketAzimuths azimuths;
  const auto reject = reader_.read(model, datagram, azimuths);
  if (!reject) azimuths_[model].add(azimuths);
  if (reject == frame::Reject::kAzimuthJump &&
      beams::step_cdeg(azimuths.first_cdeg(), azimuths.last_cdeg()) < 0) {
    ++backward_packets_[model];
  }
}

std::uint64_t SensorProbe::backward_packets(SensorModel model) const {
  const auto found = backward_packets_.find(model);
  return found == backward_packets_.end() ? 0 : found->second;
}

std::uint64_t SensorProbe::packets_of(SensorModel model) const {
  const auto found = votes_.find(model);
  return found == votes_.end() ? 0 : found->second;
}

const SensorProbe::Head* SensorProbe::head_of(SensorModel model) const {
  const auto found = azimuths_.find(model);
  return found == azimuths_.end() ? nullptr : &found->second;
}

bool SensorProbe::knows(SensorModel model) const {
  const Head* head = head_of(model);
  return head != nullptr && head->packets >= kEnoughPackets && head->time_us > 0;
}

double SensorProbe::spin_hz(SensorModel model) const {
  const Head* head = head_of(model);
  if (head == nullptr || head->time_us == 0) return 0;
  return static_cast<double>(head->rotated_cdeg) / beams::kRevolution_cdeg * 1e6 /
         static_cast<double>(head->time_us);
}

bool SensorProbe::dual_return(SensorModel model) const {
  const Head* head = head_of(model);
  return head != nullptr && 2 * head->dual_packets > head->packets;
}

int SensorProbe::columns(SensorModel model) const {
  if (is_ouster(model)) {
    constexpr int kUsual = 1024;
    const Head* const head = head_of(model);
    return head == nullptr ? kUsual : packet::kRevolution_ticks / head->last->step_ticks;
  }
  const std::optional<double> hz = head_spin_hz(spin_hz(model));
  if (!knows(model) || !hz) {
    constexpr double kUsual_hz = 10;
    return static_cast<int>(1 / (kUsual_hz * firing_s(model, false)));
  }
  const Head& head = *head_of(model);
  const bool fires_slowly = dual_return(model) || 2 * head.slow_steps > head.packets;
  // A Hesai's packets tell how fast their blocks follow one another.
  const double period_s = hesai::Models::has(model)
                              ? head.last->nominal_period_ns * 1e-9 *
                                    (head.last->dual_return ? 2 : 1) / head.last->columns
                              : firing_s(model, fires_slowly);
  return static_cast<int>(std::lround(1 / (*hz * period_s)));
}

std::string SensorProbe::foreign_models() const {
  std::string text;
  for (const auto& [model, packets] : votes_) {
    if (is_decoded(model) || model == SensorModel::kUnknown ||
        model == SensorModel::kRoboSenseDeviceInfo || model == SensorModel::kVelodynePosition) {
      continue;
    }
    const std::string_view name = to_string(model);
    text += fmt::format("{}{} packets of a{}{}", text.empty() ? "" : ", ", packets,
                        name.starts_with("other") ? "n" : " ", name);
    if (model == SensorModel::kOtherVelodyne) {
      text += fmt::format(
          " model (product number 0x{:02X}; if it fires as one that is read does, name that with "
          "--sensor)",
          other_product_);
    }
  }
  return text;
}

}  // namespace terracut::sensor
