// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "fault_script.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>

#include "rt/number_of.hpp"

namespace terracut::send {
namespace {

using rt::number_of;

constexpr double kLongest_s = 1e6;
constexpr std::uint64_t kMostPackets = 1'000'000'000;
constexpr std::string_view kSeparators = ",; \t\r\n";

enum class Amount : std::uint8_t { kPackets, kDuration, kShift };

struct Word {
  FaultKind kind;
  std::string_view name;
  Amount amount;
};
constexpr std::array kWords = {
    Word{FaultKind::kLoss, "loss", Amount::kPackets},
    Word{FaultKind::kReorder, "reorder", Amount::kPackets},
    Word{FaultKind::kDuplicate, "duplicate", Amount::kPackets},
    Word{FaultKind::kPause, "pause", Amount::kDuration},
    Word{FaultKind::kBurst, "burst", Amount::kDuration},
    Word{FaultKind::kForeign, "foreign", Amount::kPackets},
    Word{FaultKind::kTruncate, "truncate", Amount::kPackets},
    Word{FaultKind::kClock, "clock", Amount::kShift},
};

const Word& word_of(FaultKind kind) noexcept {
  return kWords[static_cast<std::size_t>(kind)];
}

std::string known_words() {
  std::string text;
  for (const Word& word : kWords) text += (text.empty() ? "" : ", ") + std::string(word.name);
  return text;
}

bool drop_suffix(std::string_view& text, std::string_view suffix) {
  if (!text.ends_with(suffix)) return false;
  text.remove_suffix(suffix.size());
  return true;
}

/// Parses "2.5s", "400ms", "3" (seconds).
std::optional<std::int64_t> nanoseconds_of(std::string_view text) {
  double unit_s = 1;
  if (drop_suffix(text, "ms")) {
    unit_s = 1e-3;
  } else {
    drop_suffix(text, "s");
  }
  const auto number = number_of<double>(text);
  if (!number || !(std::abs(*number * unit_s) <= kLongest_s)) return std::nullopt;
  return std::llround(*number * unit_s * 1e9);
}

/// Parses "+2.0s", "-150ms".
std::optional<std::int64_t> shift_of(std::string_view text) {
  if (text.empty() || (text.front() != '+' && text.front() != '-')) return std::nullopt;
  const auto size_ns = nanoseconds_of(text.substr(1));
  if (!size_ns || *size_ns <= 0) return std::nullopt;
  return text.front() == '-' ? -*size_ns : *size_ns;
}

std::optional<std::uint64_t> packets_of(std::string_view text) {
  if (!drop_suffix(text, "packets")) drop_suffix(text, "packet");
  const auto count = number_of<std::uint64_t>(text);
  if (!count || *count < 1 || *count > kMostPackets) return std::nullopt;
  return count;
}

Expected<Fault> parse_fault(std::string_view text) {
  const auto refuse = [&](const std::string& expected) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("fault '{}': expected {}", text, expected));
  };
  const auto at = text.find('@');
  const auto colon = text.find(':', at == text.npos ? 0 : at);
  if (at == text.npos || colon == text.npos) {
    return refuse("KIND@TIME:AMOUNT like loss@2.5s:20packets or pause@5s:0.4s");
  }
  const std::string_view name = text.substr(0, at);
  const std::string_view amount = text.substr(colon + 1);
  const Word* word = nullptr;
  for (const Word& each : kWords) {
    if (each.name == name) word = &each;
  }
  if (word == nullptr) return refuse(fmt::format("one of {}, found '{}'", known_words(), name));

  Fault fault{.kind = word->kind};
  const auto time_ns = nanoseconds_of(text.substr(at + 1, colon - at - 1));
  if (!time_ns || *time_ns < 0) {
    return refuse("a time since the start like 2.5s or 400ms after the @, at most 1e6 s");
  }
  fault.at_ns = *time_ns;
  if (word->amount == Amount::kPackets) {
    const auto packets = packets_of(amount);
    if (!packets) return refuse("a number of packets from 1 to 1000000000 after the colon");
    fault.packets = *packets;
  } else if (word->amount == Amount::kDuration) {
    const auto span_ns = nanoseconds_of(amount);
    if (!span_ns || *span_ns <= 0) {
      return refuse("a duration like 0.4s or 50ms after the colon, more than 0, at most 1e6 s");
    }
    fault.span_ns = *span_ns;
  } else {
    const auto shift_ns = shift_of(amount);
    if (!shift_ns) return refuse("a jump with its sign like +2.0s or -150ms after the colon");
    fault.span_ns = *shift_ns;
  }
  return fault;
}

double seconds(std::int64_t ns) noexcept {
  return static_cast<double>(ns) * 1e-9;
}

}  // namespace

std::string_view to_string(FaultKind kind) noexcept {
  return word_of(kind).name;
}

std::string to_string(const Fault& fault) {
  const Word& word = word_of(fault.kind);
  const std::string start = fmt::format("{}@{:.10g}s:", word.name, seconds(fault.at_ns));
  switch (word.amount) {
    case Amount::kPackets:
      return fmt::format("{}{}packets", start, fault.packets);
    case Amount::kDuration:
      return fmt::format("{}{:.10g}s", start, seconds(fault.span_ns));
    case Amount::kShift:
      break;
  }
  return fmt::format("{}{:+.10g}s", start, seconds(fault.span_ns));
}

Expected<FaultScript> parse_fault_script(std::string_view text) {
  FaultScript script;
  while (true) {
    const auto begin = text.find_first_not_of(kSeparators);
    if (begin == text.npos) return script;
    text.remove_prefix(begin);
    const std::string_view one = text.substr(0, text.find_first_of(kSeparators));
    auto fault = parse_fault(one);
    if (!fault) return tl::unexpected(fault.error());
    script.push_back(*fault);
    text.remove_prefix(one.size());
  }
}

}  // namespace terracut::send
