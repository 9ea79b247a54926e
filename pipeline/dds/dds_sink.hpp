// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "calib/mount/mount.hpp"
#include "diagnostics_writer.hpp"
#include "free_way_writer.hpp"
#include "object_writer.hpp"
#include "participant.hpp"
#include "pipeline/publish/frame_sink.hpp"
#include "pipeline/publish/run_facts.hpp"
#include "pipeline/ros_messages/point_cloud.hpp"
#include "ros_types.h"
#include "topic_writer.hpp"

namespace terracut::dds {

/// Publishes labelled frames as ROS 2 messages: labelled points, whole and by sectors; ground,
/// obstacles and road separately; their objects and free way; points without labels in the sensor
/// frame, as its driver would send them; diagnostics; and the sensor's transform.
class DdsSink final : public publish::FrameSink {
 public:
  struct Config {
    Participant::Config participant{};
    Quality quality{};
    /// Topics from dds_topic(); an empty topic is not published.
    std::string points{}, sectors{}, ground{}, obstacles{}, road{}, raw{}, objects{},
        object_markers{}, sector_objects{}, free_way{}, diagnostics{}, tf_static{};
    /// How long a frame waits for reliable readers to acknowledge earlier frames; 0: no wait.
    std::int64_t patience_ns = 0;
  };

  /// Returns the errors of Participant::open() and TopicWriter::open().
  [[nodiscard]] static Expected<std::unique_ptr<DdsSink>> open(const Config& config,
                                                               const publish::RunFacts& facts);

  [[nodiscard]] std::string_view name() const noexcept override { return "dds"; }
  [[nodiscard]] bool wants_sectors() const noexcept override { return sectors_.has_value(); }
  [[nodiscard]] Status put(const publish::LabelledFrame& frame) override;
  [[nodiscard]] Status put_sector(const publish::LabelledSector& sector) override;
  [[nodiscard]] Status put_figures(const status::MonitorSnapshot& figures) override;
  [[nodiscard]] Status finish() override;
  [[nodiscard]] std::vector<status::NamedCount> losses() const override;

  /// Returns the current number of readers of the topic `points`.
  [[nodiscard]] std::uint32_t readers() const { return points_ ? points_->readers() : 0; }
  [[nodiscard]] int domain() const noexcept { return participant_.domain(); }

 private:
  using Writer = std::optional<TopicWriter>;

  explicit DdsSink(Participant participant) noexcept : participant_(std::move(participant)) {}
  void await_readers();
  /// Publishes those of the points that belong to a cloud, with their heights if there are any.
  /// `time_of_first_s` is added to their times.
  void put_points(Writer& writer, std::span<const points::LabelledPoint> points,
                  std::span<const float> heights_m, std::int64_t stamp_ns, float time_of_first_s,
                  ros_messages::CloudOf which);
  void put_raw(const publish::LabelledFrame& frame);
  /// Publishes the points that have been put into bytes_, of `step` bytes each.
  void write(TopicWriter& writer, std::int64_t stamp_ns, std::string& frame_id,
             std::vector<sensor_msgs_msg_dds__PointField_>& fields, std::size_t step);

  Participant participant_;
  Config config_;
  std::string frame_id_, sensor_frame_id_;
  mount::RigidTransform T_lidar_vehicle_{};
  Writer points_, sectors_, ground_, obstacles_, road_, raw_, tf_static_;
  std::optional<ObjectWriter> objects_;
  std::optional<FreeWayWriter> free_way_;
  std::optional<DiagnosticsWriter> diagnostics_;
  std::vector<sensor_msgs_msg_dds__PointField_> fields_, fields_with_height_, raw_fields_;
  std::vector<std::uint8_t> bytes_;  ///< Bytes of the points of one message.
  int behind_ = 0;  ///< Number of successive frames that some reader acknowledged too late.
  std::atomic<std::uint64_t> unacknowledged_{0}, refused_{0};
};

}  // namespace terracut::dds
