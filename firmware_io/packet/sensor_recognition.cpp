// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/packet/sensor_recognition.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>

#include "calib/ouster/ouster_calibration.hpp"
#include "firmware_io/packet/hdl64e_wire.hpp"
#include "firmware_io/packet/hesai_wire.hpp"
#include "firmware_io/packet/robosense_wire.hpp"
#include "firmware_io/packet/ruby128_wire.hpp"

namespace terracut::sensor {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::size_t kPositionBytes = 512;
// The Ruby Lite has the Ruby128's header and blocks of 4 + 3 bytes a channel, but four blocks of 80
// channels.
constexpr std::size_t kFirstRubyBlockAt = offsetof(ruby128::ruby128_wire::Packet, blocks);
constexpr std::size_t kRuby128BlockBytes = sizeof(ruby128::ruby128_wire::Block);
constexpr std::size_t kRubyLiteBlockBytes = 4 + 3 * 80;
constexpr std::array<std::uint8_t, 4> kOlderMsopStart{0x55, 0xAA, 0x05, 0x0A};
constexpr std::array<std::uint8_t, 8> kDifopStart{0xA5, 0xFF, 0x00, 0x5A, 0x11, 0x11, 0x55, 0x55};

template <std::size_t kSize>
bool starts_with(Bytes payload, const std::array<std::uint8_t, kSize>& start) noexcept {
  return payload.size() >= kSize && std::equal(start.begin(), start.end(), payload.begin());
}

/// Returns the model whose packets carry this product number.
SensorModel product(std::uint8_t number) noexcept {
  const auto* const found = std::ranges::find(kSensorTable, number, &SensorRow::product_number);
  return number == 0 || found == kSensorTable.end() ? SensorModel::kOtherVelodyne : found->model;
}

SensorModel velodyne_model(const hdl64e::wire::Packet& packet) noexcept {
  if (hdl64e::is_hdl64e_s1(packet)) return SensorModel::kHdl64eS1;
  if (hdl64e::is_hdl64e(packet)) return SensorModel::kHdl64e;
  const bool are_upper = std::ranges::all_of(packet.blocks, [](const hdl64e::wire::Block& block) {
    return block.id.value() == hdl64e::kUpperBlockId;
  });
  if (are_upper) return product(packet.status_value);
  // In dual return the two returns of a firing are in adjacent blocks, so each block id occurs
  // twice in a row.
  const bool is_single = packet.blocks[1].id.value() == hdl64e::kLowerBlockId &&
                         packet.blocks[2].id.value() == hdl64e::kVls128ThirdId;
  const bool is_dual = packet.blocks[2].id.value() == hdl64e::kLowerBlockId &&
                       packet.blocks[4].id.value() == hdl64e::kVls128ThirdId;
  if (is_single || is_dual) return SensorModel::kVls128;
  return SensorModel::kUnknown;
}

/// True for a Ruby Plus: by its manual byte 31 is 5 for the Ruby family, and byte 32 is the model.
bool is_ruby_plus(Bytes payload) noexcept {
  return payload[31] == 5 && payload[32] == 1;
}

SensorModel robosense_model(Bytes payload) noexcept {
  if (starts_with(payload, kDifopStart)) return SensorModel::kRoboSenseDeviceInfo;
  for (const robosense::PacketLayout& layout : robosense::kLayouts) {
    if (is_surely_of(layout, payload)) return layout.model;
  }
  if (starts_with(payload, kOlderMsopStart)) return SensorModel::kOtherRoboSense;
  if (!starts_with(payload, ruby128::kRubyMagic)) return SensorModel::kUnknown;
  // Only the first byte of a block's head is the id; the second is the number of the return.
  const auto block_at = [&](std::size_t at) { return payload[at] == ruby128::kRubyBlockId; };
  if (!block_at(kFirstRubyBlockAt)) return SensorModel::kOtherRoboSense;
  const bool by_128 = block_at(kFirstRubyBlockAt + kRuby128BlockBytes) &&
                      block_at(kFirstRubyBlockAt + 2 * kRuby128BlockBytes);
  const bool by_80 = block_at(kFirstRubyBlockAt + kRubyLiteBlockBytes) &&
                     block_at(kFirstRubyBlockAt + 2 * kRubyLiteBlockBytes) &&
                     block_at(kFirstRubyBlockAt + 3 * kRubyLiteBlockBytes);
  if (by_128) return is_ruby_plus(payload) ? SensorModel::kRubyPlus : SensorModel::kRuby128;
  return by_80 ? SensorModel::kRubyLite : SensorModel::kOtherRoboSense;
}

SensorModel hesai_model(Bytes payload) noexcept {
  const auto* const found = std::ranges::find_if(
      hesai::kLayouts,
      [&](const hesai::PacketLayout& layout) { return hesai::is_surely_of(layout, payload); });
  return found == hesai::kLayouts.end() ? SensorModel::kUnknown : found->model;
}

std::string_view velodyne_return_mode(std::uint8_t mode) noexcept {
  switch (mode) {
    case 0x37:
      return "strongest return";
    case 0x38:
      return "last return";
    case 0x39:
      return "dual return";
    case 0x3A:
      return "dual return with confidence";
    default:
      return "return mode not known";
  }
}

/// By the Ruby Plus manual, byte 31 is 5 for the Ruby family and byte 32 the model. Another decoder
/// reads bytes 30 and 31, so all three are shown.
std::string_view ruby_model(Bytes payload) noexcept {
  if (payload[31] != 5) return "";
  switch (payload[32]) {
    case 1:
      return "; by the Ruby Plus manual: Ruby Plus";
    case 2:
      return "; by the Ruby Plus manual: Ruby 80";
    case 3:
      return "; by the Ruby Plus manual: Ruby 80V";
    case 4:
      return "; by the Ruby Plus manual: Ruby 48V";
    default:
      return "";
  }
}

/// Names the models that have these blocks, of payloads of another RoboSense.
std::string_view other_robosense(Bytes payload) noexcept {
  constexpr std::array<std::uint8_t, 2> kBlockStart{0xFF, 0xEE};
  const auto has_blocks = [&](std::size_t count, std::size_t bytes) {
    for (std::size_t block = 0; block < count; ++block) {
      const Bytes start = payload.subspan(42 + block * bytes, 2);
      if (!std::equal(start.begin(), start.end(), kBlockStart.begin())) return false;
    }
    return true;
  };
  if (payload.size() != ruby128::kRubyPacketBytes) return {};
  if (has_blocks(8, 4 + 3 * 48)) return "8 blocks of 48 channels, an Airy's";
  if (!has_blocks(12, 4 + 3 * 32)) return {};
  return starts_with(payload, kOlderMsopStart)
             ? "12 blocks of 32 channels, an RS-16's, RS-32's or Bpearl's; an RS-32 has to be "
               "named "
               "with --sensor"
             : "12 blocks of 32 channels, a Helios's; one with 32 lasers has to be named with "
               "--sensor";
}

}  // namespace

SensorModel recognise_sensor(Bytes payload) noexcept {
  if (const auto* packet = hdl64e::packet_in(payload)) return velodyne_model(*packet);
  if (payload.size() == ruby128::kRubyPacketBytes) return robosense_model(payload);
  if (payload.size() == kPositionBytes) {
    // There is NMEA text at offset 206 if a GPS is connected, else zeros.
    constexpr std::size_t kSentenceAt = 206;
    const std::uint8_t first = payload[kSentenceAt];
    if (first == '$' || first == 0) return SensorModel::kVelodynePosition;
  }
  if (const SensorModel model = hesai_model(payload); model != SensorModel::kUnknown) return model;
  const auto format = ouster::format_of(payload);
  return format ? ouster::model_of_rows(format->rows) : SensorModel::kUnknown;
}

SensorModel recognise_sensor_as(std::optional<SensorModel> named, Bytes payload) noexcept {
  const SensorModel model = recognise_sensor(payload);
  if (named && is_ouster(*named) && is_ouster(model)) {
    return ouster::format_of(payload, ouster::rows_of(*named)) ? *named : model;
  }
  const auto* const hesai =
      named ? std::ranges::find(hesai::kLayouts, *named, &hesai::PacketLayout::model)
            : hesai::kLayouts.end();
  if (hesai != hesai::kLayouts.end() && hesai::is_of(*hesai, payload)) return *named;
  const auto* const robosense =
      named ? std::ranges::find(robosense::kLayouts, *named, &robosense::PacketLayout::model)
            : robosense::kLayouts.end();
  if (robosense != robosense::kLayouts.end() && is_of(*robosense, payload)) return *named;
  // The VLS-128 needs no name: its block ids identify it.
  const bool may_be_named = model == SensorModel::kOtherVelodyne && named &&
                            has_factory_table(*named) && *named != SensorModel::kVls128;
  return may_be_named ? *named : model;
}

std::string describe_sensor_hints(Bytes payload) {
  const SensorModel model = recognise_sensor(payload);
  if (row_of(model).product_number != 0 || model == SensorModel::kOtherVelodyne) {
    return fmt::format("product number 0x{:02X}, {}", payload[1205],
                       velodyne_return_mode(payload[1204]));
  }
  if (const auto format = ouster::format_of(payload); is_ouster(model) && format) {
    return fmt::format("profile {}", ouster::row_of(format->profile).name);
  }
  switch (model) {
    case SensorModel::kOtherRoboSense:
      return std::string(other_robosense(payload));
    case SensorModel::kRs32:
    case SensorModel::kHelios:
      return fmt::format("type bytes {:02X} {:02X} {:02X}", payload[30], payload[31], payload[32]);
    case SensorModel::kRuby128:
    case SensorModel::kRubyPlus:
    case SensorModel::kRubyLite:
      return fmt::format("type bytes {:02X} {:02X} {:02X}{}{}", payload[30], payload[31],
                         payload[32], ruby_model(payload),
                         (payload[7] & 3) == 3 ? "; dual return" : "");
    default:
      return {};
  }
}

}  // namespace terracut::sensor
