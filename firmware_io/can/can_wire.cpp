// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/can/can_wire.hpp"

#include <linux/can.h>

#include <algorithm>
#include <cstring>

namespace terracut::can {
namespace {

static_assert(kClassicWireBytes == CAN_MTU && kFdWireBytes == CANFD_MTU);

constexpr std::size_t kLengthAt = 4;
constexpr std::size_t kFlagsAt = 5;
// The value of CANFD_FDF, which the headers of older kernels lack.
constexpr std::uint8_t kFdFlag = 0x04;
constexpr std::uint8_t kXlFlag = 0x80;  // in the fifth byte, which holds the length in other frames

std::uint32_t id_word(std::span<const std::uint8_t> bytes, CanIdOrder order) noexcept {
  if (order == CanIdOrder::kBigEndian) {
    return std::uint32_t{bytes[0]} << 24 | std::uint32_t{bytes[1]} << 16 |
           std::uint32_t{bytes[2]} << 8 | bytes[3];
  }
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data(), sizeof word);
  return word;
}

}  // namespace

tl::expected<CanFrame, CanReject> parse_can_wire(std::span<const std::uint8_t> bytes,
                                                 CanIdOrder order) noexcept {
  if (bytes.size() < kWireHeaderBytes) return tl::unexpected(CanReject::kTruncated);
  if ((bytes[kLengthAt] & kXlFlag) != 0) return tl::unexpected(CanReject::kXl);
  const std::uint8_t flags = bytes[kFlagsAt];
  const std::size_t length = bytes[kLengthAt];

  CanFrame frame;
  frame.fd = (flags & kFdFlag) != 0 || bytes.size() == kFdWireBytes;
  if (length > (frame.fd ? CanFrame::kMostBytes : CanFrame::kMostClassicBytes)) {
    return tl::unexpected(CanReject::kLength);
  }
  const std::uint32_t word = id_word(bytes, order);
  frame.error = (word & CAN_ERR_FLAG) != 0;
  frame.remote = !frame.error && (word & CAN_RTR_FLAG) != 0;
  frame.id.extended = !frame.error && (word & CAN_EFF_FLAG) != 0;
  frame.id.number = word & CAN_EFF_MASK;
  if (!frame.error && !frame.id.valid()) return tl::unexpected(CanReject::kId);
  frame.bit_rate_switch = frame.fd && (flags & CANFD_BRS) != 0;
  frame.sender_passive = frame.fd && (flags & CANFD_ESI) != 0;
  frame.length = static_cast<std::uint8_t>(length);
  if (frame.remote) return frame;
  const auto data = bytes.subspan(kWireHeaderBytes);
  if (data.size() < length) return tl::unexpected(CanReject::kTruncated);
  std::copy_n(data.begin(), length, frame.data.begin());
  return frame;
}

std::size_t write_can_wire(const CanFrame& frame,
                           std::span<std::uint8_t, kFdWireBytes> bytes) noexcept {
  std::fill(bytes.begin(), bytes.end(), std::uint8_t{0});
  std::uint32_t word = frame.id.number;
  if (frame.id.extended) word |= CAN_EFF_FLAG;
  if (frame.remote) word |= CAN_RTR_FLAG;
  if (frame.error) word |= CAN_ERR_FLAG;
  std::memcpy(bytes.data(), &word, sizeof word);
  bytes[kLengthAt] = frame.length;
  if (frame.fd) {
    bytes[kFlagsAt] = static_cast<std::uint8_t>(kFdFlag | (frame.bit_rate_switch ? CANFD_BRS : 0) |
                                                (frame.sender_passive ? CANFD_ESI : 0));
  }
  const auto payload = frame.payload();
  std::copy(payload.begin(), payload.end(), bytes.begin() + kWireHeaderBytes);
  return frame.fd ? kFdWireBytes : kClassicWireBytes;
}

}  // namespace terracut::can
