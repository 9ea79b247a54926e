// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/ouster/head_reader.hpp"

#include <bit>
#include <cstdlib>

namespace terracut::ouster {
namespace {

/// Returns the mean time from column to column; 0 if fewer than two are valid.
std::int64_t column_ns_of(const PacketFormat& format, const PacketHead& head,
                          std::span<const std::uint8_t> payload) noexcept {
  const int last = static_cast<int>(std::bit_width(head.valid)) - 1;
  if (last <= head.stamped_column) return 0;
  const auto span_ns =
      static_cast<std::int64_t>(format.head(payload.data(), last).stamp_ns - head.stamp_ns);
  return span_ns / (last - head.stamped_column);
}

/// Returns the number of columns of a mode that is nearest to what was measured.
int nearest_columns(std::int64_t columns) noexcept {
  int nearest = kColumnsPerFrame.front();
  for (const int candidate : kColumnsPerFrame) {
    if (std::llabs(candidate - columns) < std::llabs(nearest - columns)) nearest = candidate;
  }
  return nearest;
}

}  // namespace

std::optional<frame::Reject> HeadReader::read(std::span<const std::uint8_t> payload, int rows,
                                              packet::PacketAzimuths& azimuths) noexcept {
  const std::optional<PacketFormat> format = format_of(payload, rows);
  if (!format) return frame::Reject::kWrongMagic;
  if (const std::optional<PacketHead> head = head_of(*format, payload)) {
    learn(*format, *head, column_ns_of(*format, *head, payload));
  }
  return read_packet(mode_, payload, azimuths);
}

void HeadReader::learn(const PacketFormat& format, const PacketHead& head,
                       std::int64_t column_ns) noexcept {
  constexpr std::int64_t kShortest_ns = 20'000, kLongest_ns = 500'000;
  const auto stamp_ns = static_cast<std::int64_t>(head.stamp_ns);
  mode_.format = format;
  if (column_ns < kShortest_ns || column_ns > kLongest_ns) return;
  const auto rate_of = [&](int columns) {
    return 1e9 / (static_cast<double>(column_ns) * columns);
  };
  if (!is_sure_) {
    constexpr std::int64_t kFrameAt10Hz_ns = 100'000'000;
    mode_.columns_per_frame = nearest_columns(kFrameAt10Hz_ns / column_ns);
    while (mode_.columns_per_frame < head.first_measurement + format.columns &&
           mode_.columns_per_frame < kColumnsPerFrame.back()) {
      mode_.columns_per_frame *= 2;
    }
    mode_.rate_hz = rate_of(mode_.columns_per_frame);
  }
  const Seen seen{stamp_ns, head.first_measurement + head.stamped_column};
  // A number that falls, within the longest frame, tells the frame's end.
  constexpr std::int64_t kLongestFrame_ns = 220'000'000;
  if (last_ && seen.measurement < last_->measurement && stamp_ns > last_->stamp_ns &&
      stamp_ns - last_->stamp_ns < kLongestFrame_ns) {
    const std::int64_t columns = (stamp_ns - last_->stamp_ns + column_ns / 2) / column_ns;
    mode_.columns_per_frame = nearest_columns(columns + last_->measurement - seen.measurement);
    mode_.rate_hz = rate_of(mode_.columns_per_frame);
    is_sure_ = true;
  }
  last_ = seen;
}

}  // namespace terracut::ouster
