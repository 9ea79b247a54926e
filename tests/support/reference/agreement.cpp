// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "agreement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>

#include "firmware_io/frame/each_return.hpp"

namespace terracut::reference {
namespace {

using frame::Reject;

std::string describe(const PlacedReturn& beam) {
  return fmt::format("row {} column {} at ({:.5f}, {:.5f}, {:.5f}) m, {:.5f} m, intensity {}",
                     beam.row, beam.column, beam.x_m, beam.y_m, beam.z_m, beam.ground_range_m,
                     beam.intensity);
}

bool same_column(const PlacedReturn& expected, const PlacedReturn& found, int columns) {
  const int apart = std::abs(expected.column - found.column);
  return apart == 0 || (expected.on_border && (apart == 1 || apart == columns - 1));
}

bool same(const PlacedReturn& expected, const PlacedReturn& found, int columns) {
  const double tolerance_m = 0.001 + 1e-6 * expected.range_m;
  const double apart_m =
      std::hypot(expected.x_m - found.x_m, expected.y_m - found.y_m, expected.z_m - found.z_m);
  return expected.row == found.row && same_column(expected, found, columns) &&
         expected.intensity == found.intensity && apart_m <= tolerance_m &&
         std::abs(expected.ground_range_m - found.ground_range_m) <= tolerance_m;
}

}  // namespace

Refusal as_refusal(std::optional<Reject> reason) {
  if (!reason) return Refusal::kNone;
  switch (*reason) {
    case Reject::kAzimuthOutOfRange:
      return Refusal::kAzimuthRange;
    case Reject::kAzimuthMismatch:
      return Refusal::kUnequalFirings;
    case Reject::kAzimuthJump:
      return Refusal::kUneven;
    case Reject::kStationary:
      return Refusal::kNotRotating;
    case Reject::kWrongSize:
    case Reject::kWrongMagic:
    case Reject::kDeviceInfo:
    case Reject::kWrongModel:
      return Refusal::kOtherPacket;
    case Reject::kRepeated:
    case Reject::kLate:
    case Reject::kClockJump:
    case Reject::kCount:
      break;  // of the stream, not of the packet
  }
  return Refusal::kNone;
}

void ExpectedFrames::add(const Packet& packet, double unwrap_deg) {
  const double cp = std::cos(mount_.pitch_rad), sp = std::sin(mount_.pitch_rad);
  const double cr = std::cos(mount_.roll_rad), sr = std::sin(mount_.roll_rad);
  for (const Return& beam : packet.returns) {
    const Cell cell = cell_of(beam.beam_deg + unwrap_deg, columns_);
    PlacedReturn placed;
    placed.row = rows_[static_cast<std::size_t>(beam.laser)];
    placed.column = cell.column;
    placed.on_border = cell.border_deg < kBorder_deg;
    placed.intensity = beam.intensity;
    placed.range_m = std::hypot(beam.x_m, beam.y_m, beam.z_m);
    // Rolled about x, left side up; then pitched about y, front down; then lifted.
    const double rolled_y = beam.y_m * cr - beam.z_m * sr;
    const double rolled_z = beam.y_m * sr + beam.z_m * cr;
    placed.x_m = beam.x_m * cp + rolled_z * sp;
    placed.y_m = rolled_y;
    placed.z_m = -beam.x_m * sp + rolled_z * cp + mount_.height_m;
    placed.ground_range_m = std::hypot(placed.x_m, placed.y_m);
    frames_[cell.frame].push_back(placed);
  }
}

std::size_t HandedFrames::returns() const {
  std::size_t sum = 0;
  for (const auto& frame : frames_) sum += frame.size();
  return sum;
}

void HandedFrames::add(const frame::FrameInfo& info, const frame::RangeImage& image) {
  std::vector<PlacedReturn>& frame = frames_.emplace_back(info.returns);
  frame::for_each_return(image, [&](const frame::PlacedReturn& placed) {
    PlacedReturn& beam = frame.at(placed.return_index);
    beam.row = placed.row;
    beam.column = placed.column;
    beam.x_m = double{placed.point.x_m};
    beam.y_m = double{placed.point.y_m};
    beam.z_m = double{placed.point.z_m};
    beam.ground_range_m = double{placed.point.ground_range_m};
    beam.intensity = placed.point.intensity;
  });
}

std::string first_difference(const ExpectedFrames& expected, const HandedFrames& handed,
                             int columns) {
  if (expected.frames().size() != handed.frames().size()) {
    return fmt::format("{} frames expected, {} frames handed over", expected.frames().size(),
                       handed.frames().size());
  }
  std::size_t n = 0;
  for (const auto& [number, returns] : expected.frames()) {
    const std::vector<PlacedReturn>& frame = handed.frames()[n];
    for (std::size_t i = 0; i < std::min(returns.size(), frame.size()); ++i) {
      if (!same(returns[i], frame[i], columns)) {
        return fmt::format("frame {}, return {}: {} expected, is {}", n, i, describe(returns[i]),
                           describe(frame[i]));
      }
    }
    if (returns.size() != frame.size()) {
      return fmt::format("frame {}: {} returns expected, has {}", n, returns.size(), frame.size());
    }
    ++n;
  }
  return {};
}

}  // namespace terracut::reference
