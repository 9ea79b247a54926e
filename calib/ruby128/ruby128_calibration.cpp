// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/ruby128/ruby128_calibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <string_view>

#include "calib/beams/angle.hpp"
#include "calib/beams/elevation_rows.hpp"
#include "calib/text/fnv1a.hpp"

namespace terracut::ruby128 {
namespace {

using Channels = std::array<Ruby128Channel, kRuby128Lasers>;

constexpr std::int64_t kNoAngle = std::numeric_limits<std::int64_t>::min();

/// Allowed values in thousandths of a degree, both ends included. The ends are whole hundredths, so
/// that a value rounded to hundredths (the unit of DIFOP packets) stays in the span.
struct Span {
  std::int64_t low_mdeg, high_mdeg;
  bool contains(std::int64_t mdeg) const noexcept { return mdeg >= low_mdeg && mdeg <= high_mdeg; }
};
constexpr Span kLowestSpan{-26'000, -24'000};  // maker's table: -25
constexpr Span kHighestSpan{14'000, 16'000};   // maker's table: 15
constexpr Span kElevationSpan{kLowestSpan.low_mdeg, kHighestSpan.high_mdeg};
constexpr Span kOffsetSpan{-10'000, 10'000};     // maker's table: -5.95 .. 5.95
constexpr std::int64_t kMinSpread_mdeg = 5'000;  // maker's table: 11.9

const Ruby128Channel& at(const Channels& channels, int channel) noexcept {
  return channels[static_cast<std::size_t>(channel)];
}
std::int64_t elevation_mdeg(const Channels& channels, int channel) noexcept {
  return angle_mdeg(at(channels, channel).elevation_rad);
}
std::int64_t offset_mdeg(const Channels& channels, int channel) noexcept {
  return angle_mdeg(at(channels, channel).azimuth_offset_rad);
}

std::array<int, kRuby128Lasers> rows_of(const Channels& channels) noexcept {
  std::array<double, kRuby128Lasers> elevation_rad{};
  std::transform(channels.begin(), channels.end(), elevation_rad.begin(),
                 [](const Ruby128Channel& channel) { return channel.elevation_rad; });
  return beams::rows_of_elevations(elevation_rad);
}

/// True for the first channels of an RS-Ruby Plus, which has the same packets and nearly the same
/// spans but other angles, firing times and lens offset.
bool is_ruby_plus(const Channels& channels) noexcept {
  struct Angles {
    std::int64_t elevation_mdeg, offset_mdeg;
  };
  constexpr std::array<Angles, 6> kPlus{{{-11'780, 5'940},
                                         {-10'370, 2'390},
                                         {-9'270, -1'150},
                                         {-8'380, -4'690},
                                         {-16'070, 4'700},
                                         {-25'100, 1'170}}};
  constexpr std::int64_t kTolerance_mdeg = 500;  // units differ by hundredths of a degree
  const auto near = [](std::int64_t a, std::int64_t b) {
    return a >= b - kTolerance_mdeg && a <= b + kTolerance_mdeg;
  };
  for (std::size_t i = 0; i < kPlus.size(); ++i) {
    const int channel = static_cast<int>(i);
    if (!near(elevation_mdeg(channels, channel), kPlus[i].elevation_mdeg) ||
        !near(offset_mdeg(channels, channel), kPlus[i].offset_mdeg)) {
      return false;
    }
  }
  return true;
}

std::string outside(int channel, std::string_view what, double rad, Span span,
                    std::string_view hint) {
  return fmt::format("channel {} of 128: {} is {:.6g} deg, expected {:g} to {:g} deg{}",
                     channel + 1, what, beams::rad_to_deg(rad),
                     static_cast<double>(span.low_mdeg) / 1000.0,
                     static_cast<double>(span.high_mdeg) / 1000.0, hint);
}

/// Returns a hint at the mistake that may have put an elevation outside its span.
std::string_view hint_for_elevation(double rad) {
  if (std::abs(beams::rad_to_deg(rad)) > 40.0) {
    return "; this looks like degrees where radians were expected";
  }
  return "";
}
std::string_view hint_for_offset(double rad) {
  if (kElevationSpan.contains(angle_mdeg(rad))) return "; are the columns swapped?";
  return hint_for_elevation(rad);
}
std::string_view hint_for_view(const Channels& channels, int one_end, int other_end) {
  const std::int64_t view_mdeg =
      std::abs(elevation_mdeg(channels, one_end) - elevation_mdeg(channels, other_end));
  if (view_mdeg == 0) return "; this looks like an empty table";
  if (view_mdeg < 2'000) return "; this looks like radians where degrees were expected";
  return "";
}

/// Each check_...() function returns the fault that it finds in the table; empty if there is none.
std::string check_channels(const Channels& channels) {
  for (int number = 0; number < kRuby128Lasers; ++number) {
    const Ruby128Channel& channel = at(channels, number);
    if (!kElevationSpan.contains(angle_mdeg(channel.elevation_rad))) {
      return outside(number, "elevation", channel.elevation_rad, kElevationSpan,
                     hint_for_elevation(channel.elevation_rad));
    }
    if (!kOffsetSpan.contains(angle_mdeg(channel.azimuth_offset_rad))) {
      return outside(number, "azimuth offset", channel.azimuth_offset_rad, kOffsetSpan,
                     hint_for_offset(channel.azimuth_offset_rad));
    }
  }
  return {};
}

std::string check_rows(const Channels& channels) {
  const auto rows = rows_of(channels);
  const auto order = beams::order_of_rows(rows);
  const int lowest = order.front(), highest = order.back();
  if (!kLowestSpan.contains(elevation_mdeg(channels, lowest))) {
    return outside(lowest, "the lowest elevation of all", at(channels, lowest).elevation_rad,
                   kLowestSpan, hint_for_view(channels, lowest, highest));
  }
  if (!kHighestSpan.contains(elevation_mdeg(channels, highest))) {
    return outside(highest, "the highest elevation of all", at(channels, highest).elevation_rad,
                   kHighestSpan, hint_for_view(channels, highest, lowest));
  }
  for (std::size_t row = 1; row < order.size(); ++row) {
    const auto [first, second] = std::minmax(order[row - 1], order[row]);
    const double elevation_rad = at(channels, first).elevation_rad;
    if (angle_cdeg(elevation_rad) != angle_cdeg(at(channels, second).elevation_rad)) continue;
    return fmt::format(
        "channels {} and {} have the same elevation {:.3f} deg, expected 128 distinct ones (in "
        "hundredths of a degree)",
        first + 1, second + 1, beams::rad_to_deg(elevation_rad));
  }
  if (std::is_sorted(rows.begin(), rows.end()) || std::is_sorted(rows.rbegin(), rows.rend())) {
    return fmt::format(
        "elevations run in order from {:.3f} deg (channel 1) to {:.3f} deg (channel 128); this "
        "looks like a sorted table, expected the order of channels on the wire, which is not "
        "that of elevations",
        beams::rad_to_deg(channels.front().elevation_rad),
        beams::rad_to_deg(channels.back().elevation_rad));
  }
  return {};
}

std::string check_offsets(const Channels& channels) {
  int least = 0, most = 0;
  for (int channel = 1; channel < kRuby128Lasers; ++channel) {
    if (offset_mdeg(channels, channel) < offset_mdeg(channels, least)) least = channel;
    if (offset_mdeg(channels, channel) > offset_mdeg(channels, most)) most = channel;
  }
  if (offset_mdeg(channels, most) - offset_mdeg(channels, least) >= kMinSpread_mdeg) return {};
  return fmt::format(
      "all azimuth offsets lie between {:.3f} deg (channel {}) and {:.3f} deg (channel {}), "
      "expected some 12 deg from the least to the greatest",
      beams::rad_to_deg(at(channels, least).azimuth_offset_rad), least + 1,
      beams::rad_to_deg(at(channels, most).azimuth_offset_rad), most + 1);
}

}  // namespace

std::int64_t angle_mdeg(double rad) noexcept {
  const double mdeg = beams::rad_to_deg(rad) * 1000.0;
  return std::abs(mdeg) < 1e15 ? std::llround(mdeg) : kNoAngle;  // NaN gives kNoAngle as well
}

std::int64_t angle_cdeg(double rad) noexcept {
  const std::int64_t mdeg = angle_mdeg(rad);
  return mdeg == kNoAngle ? kNoAngle : (mdeg + (mdeg < 0 ? -5 : 5)) / 10;
}

Status validate(const Ruby128Calibration& calibration) {
  const Channels& channels = calibration.channels;
  const auto refuse = [&](ErrorCode code, std::string_view what) {
    return fail(code,
                fmt::format("RS-Ruby128 calibration{}{}: {}",
                            calibration.origin.empty() ? "" : " from ", calibration.origin, what));
  };
  if (is_ruby_plus(channels)) {
    return refuse(ErrorCode::kUnsupported,
                  "this is the table of an RS-Ruby Plus, whose firing times and lens differ too; "
                  "expected an RS-Ruby128");
  }
  for (const auto check : {check_channels, check_rows, check_offsets}) {
    if (const std::string what = check(channels); !what.empty()) {
      return refuse(ErrorCode::kMalformed, what);
    }
  }
  return {};
}

std::uint64_t fingerprint(const Ruby128Calibration& calibration) {
  text::Fnv1a hash;
  for (const Ruby128Channel& channel : calibration.channels) {
    hash.add(angle_cdeg(channel.elevation_rad));
    hash.add(angle_cdeg(channel.azimuth_offset_rad));
  }
  return hash.value();
}

std::array<int, kRuby128Lasers> rows_by_elevation(const Ruby128Calibration& calibration) {
  return rows_of(calibration.channels);
}

}  // namespace terracut::ruby128
