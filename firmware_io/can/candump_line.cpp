// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/can/candump_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <limits>
#include <optional>

namespace terracut::can {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::uint32_t kErrorBit = 0x20000000;
constexpr unsigned kFdBit = 4, kRateSwitchBit = 1, kPassiveBit = 2;
constexpr std::string_view kSpace = " \t";

tl::unexpected<CandumpFault> malformed(std::string_view what) noexcept {
  return tl::unexpected(CandumpFault{what, true});
}
tl::unexpected<CandumpFault> no_frame(std::string_view what) noexcept {
  return tl::unexpected(CandumpFault{what, false});
}

template <class Whole>
std::optional<Whole> whole_number(std::string_view digits, int base) noexcept {
  Whole value = 0;
  if (digits.empty() || digits.front() == '-') return std::nullopt;
  const auto [end, error] =
      std::from_chars(digits.data(), digits.data() + digits.size(), value, base);
  if (error != std::errc{} || end != digits.data() + digits.size()) return std::nullopt;
  return value;
}

/// Removes the first word of `text` and returns it.
std::string_view next_word(std::string_view& text) noexcept {
  const std::size_t begin = std::min(text.find_first_not_of(kSpace), text.size());
  const std::size_t end = std::min(text.find_first_of(kSpace, begin), text.size());
  const std::string_view word = text.substr(begin, end - begin);
  text.remove_prefix(end);
  return word;
}

/// Parses "1700000000.123456".
std::optional<std::int64_t> stamp_from(std::string_view text) noexcept {
  const std::size_t dot = text.find('.');
  if (dot == std::string_view::npos) return std::nullopt;
  const std::string_view decimals = text.substr(dot + 1);
  if (decimals.size() > 9) return std::nullopt;
  const auto seconds = whole_number<std::int64_t>(text.substr(0, dot), 10);
  auto fraction = whole_number<std::int64_t>(decimals, 10);
  if (!seconds || !fraction) return std::nullopt;
  for (std::size_t digits = decimals.size(); digits < 9; ++digits) *fraction *= 10;
  if (*seconds > std::numeric_limits<std::int64_t>::max() / kSecond_ns - 1) return std::nullopt;
  return *seconds * kSecond_ns + *fraction;
}

/// Reads hex digits, two a byte, with or without dots between bytes. False for anything else or too
/// many bytes.
bool read_data(std::string_view text, std::size_t most_bytes, CanFrame& frame) noexcept {
  std::size_t count = 0;
  while (!text.empty()) {
    if (count > 0 && text.front() == '.') text.remove_prefix(1);
    if (text.size() < 2 || count == most_bytes) return false;
    const auto byte = whole_number<std::uint8_t>(text.substr(0, 2), 16);
    if (!byte) return false;
    frame.data[count++] = *byte;
    text.remove_prefix(2);
  }
  frame.length = static_cast<std::uint8_t>(count);
  return true;
}

/// Reads the part after the id, "#...": classic data or a remote frame. Returns the rest of the
/// line.
std::optional<std::string_view> read_classic(std::string_view body, CanFrame& frame) noexcept {
  // A suffix "_9" to "_F" is the length code on the wire; the frame still has 8 bytes of data.
  if (const std::size_t mark = body.find('_'); mark != std::string_view::npos) {
    const auto code = whole_number<unsigned>(body.substr(mark + 1), 16);
    if (!code || *code < 9 || *code > 15) return "the length behind '_' is not 9 to F";
    body = body.substr(0, mark);
  }
  if (body.starts_with('R')) {
    frame.remote = true;
    if (body.size() == 1) return std::nullopt;
    const auto length = whole_number<unsigned>(body.substr(1), 16);
    if (!length || *length > CanFrame::kMostClassicBytes) {
      return "a remote frame asks for 0 to 8 bytes";
    }
    frame.length = static_cast<std::uint8_t>(*length);
    return std::nullopt;
  }
  if (!read_data(body, CanFrame::kMostClassicBytes, frame)) {
    return "its data are not up to 8 bytes in hexadecimal digits";
  }
  return std::nullopt;
}

std::optional<std::string_view> read_fd(std::string_view body, CanFrame& frame) noexcept {
  const auto flags = whole_number<unsigned>(body.substr(0, 1), 16);
  if (!flags) return "expected a hexadecimal digit of flags behind '##'";
  frame.fd = true;
  frame.bit_rate_switch = (*flags & kRateSwitchBit) != 0;
  frame.sender_passive = (*flags & kPassiveBit) != 0;
  if (!read_data(body.substr(1), CanFrame::kMostBytes, frame)) {
    return "its data are not up to 64 bytes in hexadecimal digits";
  }
  if (!is_fd_length(frame.length)) return "no CAN FD frame has this many bytes";
  return std::nullopt;
}

bool read_id(std::string_view digits, CanFrame& frame) noexcept {
  const auto number = whole_number<std::uint32_t>(digits, 16);
  if (!number) return false;
  if (digits.size() == 3) {
    frame.id = {*number, false};
  } else if (digits.size() == 8) {
    frame.error = (*number & kErrorBit) != 0;
    frame.id = {frame.error ? *number & CanId::kExtendedMost : *number, !frame.error};
    if (frame.error) return *number <= (kErrorBit | CanId::kExtendedMost);
  } else {
    return false;
  }
  return frame.id.valid();
}

}  // namespace

tl::expected<CandumpLine, CandumpFault> parse_candump_line(std::string_view line) noexcept {
  if (line.ends_with('\r')) line.remove_suffix(1);
  std::string_view rest = line;
  const std::string_view stamp = next_word(rest);
  if (!stamp.starts_with('(')) return no_frame("it does not begin with a stamp in parentheses");
  if (!stamp.ends_with(')')) return malformed("its stamp has no closing parenthesis");
  const auto stamp_ns = stamp_from(stamp.substr(1, stamp.size() - 2));
  if (!stamp_ns) {
    return malformed(
        "its stamp is not seconds, a point and 1 to 9 decimals (date stamps, as of "
        "`candump -t A`, are not read)");
  }
  CandumpLine parsed;
  parsed.frame.stamp_ns = *stamp_ns;
  parsed.interface = next_word(rest);
  const std::string_view text = next_word(rest);
  const std::size_t mark = text.find('#');
  if (mark == std::string_view::npos) {
    return malformed("there is no '#' behind its id; expected the format of `candump -l`");
  }
  // A CAN XL line has five digits before the mark: two of the network and three of the priority.
  // The id of any other frame has 3 or 8 digits.
  if (mark == 5) return no_frame("it is a CAN XL frame");
  CanFrame& frame = parsed.frame;
  if (!read_id(text.substr(0, mark), frame)) {
    return malformed("its id is not 3 hexadecimal digits up to 7FF, or 8");
  }
  const std::string_view body = text.substr(mark + 1);
  const auto fault =
      body.starts_with('#') ? read_fd(body.substr(1), frame) : read_classic(body, frame);
  if (fault) return malformed(*fault);
  if (frame.error && (frame.fd || frame.remote)) {
    return malformed("an error frame is neither FD nor remote");
  }
  const std::string_view direction = next_word(rest);
  if ((!direction.empty() && direction != "R" && direction != "T") || !next_word(rest).empty()) {
    return malformed("more stands behind the frame than R or T");
  }
  return parsed;
}

std::string candump_line(const CanFrame& frame, std::string_view interface) {
  const std::int64_t seconds = frame.stamp_ns / kSecond_ns;
  const std::int64_t nanoseconds = frame.stamp_ns % kSecond_ns;
  std::string line = nanoseconds % 1000 == 0
                         ? fmt::format("({:010}.{:06}) {} ", seconds, nanoseconds / 1000, interface)
                         : fmt::format("({:010}.{:09}) {} ", seconds, nanoseconds, interface);
  const std::uint32_t number = frame.error ? frame.id.number | kErrorBit : frame.id.number;
  line += frame.error || frame.id.extended ? fmt::format("{:08X}#", number)
                                           : fmt::format("{:03X}#", number);
  if (frame.remote) {
    line += frame.length == 0 ? std::string("R") : fmt::format("R{}", frame.length);
  } else if (frame.fd) {
    line += fmt::format("#{:X}", kFdBit | (frame.bit_rate_switch ? kRateSwitchBit : 0) |
                                     (frame.sender_passive ? kPassiveBit : 0));
  }
  for (const std::uint8_t byte : frame.payload()) line += fmt::format("{:02X}", byte);
  return line + '\n';
}

}  // namespace terracut::can
