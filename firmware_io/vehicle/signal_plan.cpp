// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/vehicle/signal_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace terracut::vehicle {
namespace {

constexpr int kMostBits = 64;
constexpr int kFrameBits = 8 * static_cast<int>(can::CanFrame::kMostBytes);

/// Returns a little-endian number of `count` <= 9 bytes without its lowest `shift` bits.
std::uint64_t intel_bits(const std::uint8_t* bytes, unsigned count, unsigned shift) noexcept {
  std::uint64_t low = 0;
  for (unsigned i = 0; i < std::min(count, 8U); ++i) low |= std::uint64_t{bytes[i]} << 8 * i;
  low >>= shift;
  // A number of nine bytes always has a shift above 0, so shifting by (64 - shift) is valid.
  return count == 9 ? low | std::uint64_t{bytes[8]} << (64 - shift) : low;
}

std::uint64_t motorola_bits(const std::uint8_t* bytes, unsigned count, unsigned shift) noexcept {
  std::uint64_t high = 0;
  for (unsigned i = 0; i < std::min(count, 8U); ++i) high = high << 8 | bytes[i];
  return count == 9 ? high << (8 - shift) | bytes[8] >> shift : high >> shift;
}

double number_of(std::uint64_t bits, unsigned bit_count, DbcNumber number) noexcept {
  switch (number) {
    case DbcNumber::kFloat:
      return std::bit_cast<float>(static_cast<std::uint32_t>(bits));
    case DbcNumber::kDouble:
      return std::bit_cast<double>(bits);
    case DbcNumber::kSigned: {
      const unsigned above = kMostBits - bit_count;
      return static_cast<double>(static_cast<std::int64_t>(bits << above) >> above);
    }
    case DbcNumber::kUnsigned:
      break;
  }
  return static_cast<double>(bits);
}

}  // namespace

Expected<SignalPlan> SignalPlan::make(const DbcFile& file, std::string_view name) {
  const auto found = find_signal(file, name);
  if (!found) return tl::unexpected(found.error());
  const DbcMessage& message = *found->message;
  const DbcSignal& signal = *found->signal;
  const auto refuse = [&](ErrorCode code, int line, const std::string& what) {
    return fail(code, fmt::format("{}:{}: signal {}.{} {}", file.name, line, message.name,
                                  signal.name, what));
  };
  const auto id = message.id();
  if (!id) {
    return refuse(ErrorCode::kMalformed, message.line,
                  fmt::format("is in a message numbered {}, which is neither an 11-bit id nor a "
                              "29-bit one with bit 31 set",
                              message.written_id));
  }
  if (signal.multiplex == DbcMultiplex::kSelected) {
    return refuse(ErrorCode::kUnsupported, signal.line,
                  "is multiplexed: only some frames of its message hold it. terracut reads signals "
                  "that every frame holds");
  }
  if (signal.bit_count < 1 || signal.bit_count > kMostBits) {
    return refuse(ErrorCode::kMalformed, signal.line,
                  fmt::format("has {} bits; expected 1 to 64", signal.bit_count));
  }
  const bool wrong_float = signal.number == DbcNumber::kFloat && signal.bit_count != 32;
  const bool wrong_double = signal.number == DbcNumber::kDouble && signal.bit_count != 64;
  if (wrong_float || wrong_double) {
    return refuse(ErrorCode::kMalformed, signal.line,
                  fmt::format("is a floating-point number of {} bits; expected {}",
                              signal.bit_count, wrong_float ? 32 : 64));
  }
  // Treats either kind of signal as a run of bits: an Intel signal goes up from its lowest bit, a
  // Motorola signal down from its highest; for Motorola, the bits of each byte are counted from the
  // top.
  const int start = std::clamp(signal.start_bit, -1, kFrameBits);
  const int first_bit = signal.motorola ? start / 8 * 8 + 7 - start % 8 : start;
  const int last_bit = first_bit + (signal.bit_count - 1);
  if (start < 0 || last_bit >= kFrameBits || last_bit / 8 >= message.length) {
    return refuse(ErrorCode::kMalformed, signal.line,
                  fmt::format("({} bits from bit {}) does not fit into its message of {} bytes",
                              signal.bit_count, signal.start_bit, message.length));
  }
  SignalPlan plan;
  plan.id_ = *id;
  plan.first_byte_ = static_cast<std::uint8_t>(first_bit / 8);
  plan.byte_count_ = static_cast<std::uint8_t>(last_bit / 8 - first_bit / 8 + 1);
  plan.shift_ = static_cast<std::uint8_t>(signal.motorola ? 7 - last_bit % 8 : first_bit % 8);
  plan.bit_count_ = static_cast<std::uint8_t>(signal.bit_count);
  plan.motorola_ = signal.motorola;
  plan.number_ = signal.number;
  plan.factor_ = signal.factor;
  plan.offset_ = signal.offset;
  return plan;
}

std::optional<double> SignalPlan::value(const can::CanFrame& frame) const noexcept {
  if (frame.payload().size() < std::size_t{first_byte_} + byte_count_) return std::nullopt;
  const std::uint8_t* bytes = frame.data.data() + first_byte_;
  const std::uint64_t bits = (motorola_ ? motorola_bits(bytes, byte_count_, shift_)
                                        : intel_bits(bytes, byte_count_, shift_)) &
                             (~std::uint64_t{0} >> (kMostBits - bit_count_));
  return number_of(bits, bit_count_, number_) * factor_ + offset_;
}

}  // namespace terracut::vehicle
