// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/ros_messages/free_way_messages.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

#include "pipeline/free_way/outline.hpp"
#include "pipeline/free_way/way_grid.hpp"
#include "pipeline/ros_messages/header.hpp"

namespace terracut::ros_messages {
namespace {

using free_way::Sector;

float range_m(const Sector& sector) noexcept {
  const float stop_m = sector.stop_m();
  const bool sees_nothing = sector.seen_m == 0 && std::isinf(stop_m);
  return sees_nothing ? std::numeric_limits<float>::quiet_NaN() : stop_m;
}

}  // namespace

WayScan way_scan(const publish::LabelledFrame& frame) {
  const std::vector<Sector>& sectors = frame.free_way;
  WayScan scan;
  if (sectors.empty()) return scan;
  const auto first = static_cast<std::size_t>(
      std::ranges::min_element(sectors, {}, &Sector::azimuth_rad) - sectors.begin());
  const std::size_t count = sectors.size();
  scan.first_rad = sectors[first].azimuth_rad;
  scan.step_rad = 2 * std::numbers::pi_v<float> / static_cast<float>(count);
  scan.last_rad = scan.first_rad + scan.step_rad * static_cast<float>(count - 1);
  const frame::FrameInfo& info = frame.record.info;
  scan.turn_s = static_cast<float>(info.last_packet_ns - info.first_packet_ns) * 1e-9F;
  scan.ranges_m.reserve(count);
  scan.seen_m.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {  // sectors go clockwise
    const Sector& sector = sectors[(first + count - i) % count];
    scan.ranges_m.push_back(range_m(sector));
    scan.seen_m.push_back(sector.seen_m);
  }
  return scan;
}

void write_free_way_scan(const publish::LabelledFrame& frame, std::string_view frame_id,
                         std::vector<std::byte>& message) {
  const WayScan scan = way_scan(frame);
  CdrWriter to(message);
  add_header(to, stamp_ns_of(frame.record), frame_id);
  for (const float number : {scan.first_rad, scan.last_rad, scan.step_rad, 0.0F, scan.turn_s,
                             WayScan::kRangeMin_m, WayScan::kRangeMax_m}) {
    to.add(number);
  }
  for (const std::vector<float>* numbers : {&scan.ranges_m, &scan.seen_m}) {
    to.add_length(numbers->size());
    for (const float number : *numbers) to.add(number);
  }
}

void write_free_way_polygon(const publish::LabelledFrame& frame, std::string_view frame_id,
                            std::vector<std::byte>& message) {
  const std::vector<Corner> corners = free_way::outline(frame.free_way);
  CdrWriter to(message);
  add_header(to, stamp_ns_of(frame.record), frame_id);
  to.add_length(corners.size());
  for (const Corner& corner : corners) {
    for (const float number : {corner.x_m, corner.y_m, 0.0F}) to.add(number);
  }
}

void write_free_way_grid(const publish::LabelledFrame& frame, std::string_view frame_id,
                         std::vector<std::byte>& message) {
  free_way::WayGrid grid;
  grid.fill(frame.free_way);
  const std::int64_t stamp_ns = stamp_ns_of(frame.record);
  CdrWriter to(message);
  add_header(to, stamp_ns, frame_id);
  add_time(to, stamp_ns);  // map_load_time
  to.add(free_way::WayGrid::kCell_m);
  for (int side = 0; side < 2; ++side) {
    to.add(static_cast<std::uint32_t>(free_way::WayGrid::kSide));
  }
  constexpr auto kFirst_m = static_cast<double>(free_way::WayGrid::kFirst_m);
  for (const double number : {kFirst_m, kFirst_m, 0.0, 0.0, 0.0, 0.0, 1.0}) to.add(number);
  std::ranges::copy(std::as_bytes(std::span(grid.cells)),
                    to.add_byte_sequence(grid.cells.size()).begin());
}

}  // namespace terracut::ros_messages
