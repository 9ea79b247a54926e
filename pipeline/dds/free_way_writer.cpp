// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "free_way_writer.hpp"

#include <utility>
#include <vector>

#include "pipeline/free_way/outline.hpp"
#include "pipeline/free_way/way_grid.hpp"
#include "pipeline/ros_messages/free_way_messages.hpp"
#include "pipeline/ros_messages/header.hpp"
#include "ros_time.hpp"
#include "sequence_of.hpp"

namespace terracut::dds {
namespace {

std_msgs_msg_dds__Header_ header_of(const publish::LabelledFrame& frame, std::string& frame_id) {
  return {ros_time(ros_messages::stamp_ns_of(frame.record)), frame_id.data()};
}

}  // namespace

Expected<FreeWayWriter> FreeWayWriter::open(const Participant& participant, const std::string& scan,
                                            const Quality& quality) {
  auto of_scan = TopicWriter::open(participant, scan, kLaserScan, quality);
  if (!of_scan) return tl::unexpected(of_scan.error());
  auto of_polygon = TopicWriter::open(participant, scan + "/polygon", kPolygonStamped, quality);
  if (!of_polygon) return tl::unexpected(of_polygon.error());
  auto of_grid = TopicWriter::open(participant, scan + "/grid", kOccupancyGrid, quality);
  if (!of_grid) return tl::unexpected(of_grid.error());
  return FreeWayWriter(*std::move(of_scan), *std::move(of_polygon), *std::move(of_grid));
}

Status FreeWayWriter::write(const publish::LabelledFrame& frame, std::string& frame_id) {
  using Write = Status (FreeWayWriter::*)(const publish::LabelledFrame&, std::string&);
  const std::pair<TopicWriter*, Write> of_topics[] = {{&scan_, &FreeWayWriter::write_scan},
                                                      {&polygon_, &FreeWayWriter::write_polygon},
                                                      {&grid_, &FreeWayWriter::write_grid}};
  for (const auto& [topic, write_one] : of_topics) {
    if (topic->readers() == 0) continue;
    if (Status written = (this->*write_one)(frame, frame_id); !written) return written;
  }
  return {};
}

Status FreeWayWriter::write_scan(const publish::LabelledFrame& frame, std::string& frame_id) {
  using ros_messages::WayScan;
  WayScan scan = ros_messages::way_scan(frame);
  sensor_msgs_msg_dds__LaserScan_ message{};
  message.header = header_of(frame, frame_id);
  message.angle_min = scan.first_rad;
  message.angle_max = scan.last_rad;
  message.angle_increment = scan.step_rad;
  message.scan_time = scan.turn_s;
  message.range_min = WayScan::kRangeMin_m;
  message.range_max = WayScan::kRangeMax_m;
  message.ranges = sequence_of<dds_sequence_float>(scan.ranges_m);
  message.intensities = sequence_of<dds_sequence_float>(scan.seen_m);
  return scan_.write(&message);
}

Status FreeWayWriter::write_polygon(const publish::LabelledFrame& frame, std::string& frame_id) {
  std::vector<geometry_msgs_msg_dds__Point32_> points;
  for (const Corner& corner : free_way::outline(frame.free_way)) {
    points.push_back({corner.x_m, corner.y_m, 0});
  }
  const geometry_msgs_msg_dds__PolygonStamped_ message{
      header_of(frame, frame_id),
      {sequence_of<dds_sequence_geometry_msgs_msg_dds__Point32_>(points)}};
  return polygon_.write(&message);
}

Status FreeWayWriter::write_grid(const publish::LabelledFrame& frame, std::string& frame_id) {
  using free_way::WayGrid;
  WayGrid grid;
  grid.fill(frame.free_way);
  std::vector<std::int8_t> cells(grid.cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    cells[i] = static_cast<std::int8_t>(grid.cells[i]);
  }
  nav_msgs_msg_dds__OccupancyGrid_ message{};
  message.header = header_of(frame, frame_id);
  message.info.map_load_time = message.header.stamp;
  message.info.resolution = WayGrid::kCell_m;
  message.info.width = message.info.height = WayGrid::kSide;
  constexpr auto kFirst_m = static_cast<double>(WayGrid::kFirst_m);
  message.info.origin = {{kFirst_m, kFirst_m, 0}, {0, 0, 0, 1}};
  message.data = sequence_of<dds_sequence_int8>(cells);
  return grid_.write(&message);
}

}  // namespace terracut::dds
