// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "pipeline/mcap/bag_metadata.hpp"
#include "pipeline/mcap/mcap_file.hpp"
#include "pipeline/publish/diagnosis.hpp"
#include "pipeline/publish/frame_sink.hpp"
#include "pipeline/publish/run_facts.hpp"
#include "pipeline/ros_messages/topics.hpp"
#include "pipeline/stream/labelled_frame_wire.hpp"

namespace terracut::mcap {

/// Records labelled frames, the run's diagnostics and the mount's transform for ROS 2 and its
/// viewers.
///
/// A path that ends in ".mcap" is one file. Any other is the folder of a bag as rosbag2 makes it:
/// NAME_0.mcap, NAME_1.mcap, ... with metadata.yaml beside them, which is renewed with each file
/// that is full.
///
/// One that nobody watches over (Config::unattended) never takes the place of an older one and
/// leaves room on the disk to others.
class McapSink final : public publish::FrameSink {
 public:
  struct Config {
    std::filesystem::path path;
    /// A bag's file ends when it has so many bytes or spans so much time; 0: not for that.
    std::uint64_t split_bytes = 0;
    std::int64_t split_ns = 0;
    /// Only points, whose label tells ground from obstacles; else also ground and obstacles, and
    /// road where the stream has it, in clouds of their own.
    bool points_alone = false;
    McapFile::Metadata metadata{};  ///< Kept in every file.
    /// It goes to the next place that is free: beside "drive.mcap" or what a killed process left of
    /// it to "drive_2.mcap", beside a folder with anything in it, "drive", to "drive_2", and so on.
    /// It ends, whole, with an error of put() where no room is left (files::check_room_left()).
    bool unattended = false;
  };

  /// kInvalidArgument: a split of a single file.
  [[nodiscard]] static Status check(const Config& config);
  /// kInvalidArgument: as check(), or a bag's folder that holds something already. kWriteFailed.
  [[nodiscard]] static Expected<std::unique_ptr<McapSink>> open(Config config,
                                                                publish::Stream stream);

  /// What frames of so many returns take in memory where the queue is full: it, the frames in work
  /// at either end, the message, its chunk and that compressed, and what zstd works with.
  [[nodiscard]] static constexpr std::size_t memory_bytes(std::size_t returns) noexcept {
    constexpr std::size_t kZstd_bytes = std::size_t{2} << 20;
    return returns * sizeof(stream::LabelledPoint) * (kQueueFrames + 5) + kZstd_bytes;
  }

  /// A second and a half: disks stop now and then.
  static constexpr std::size_t kQueueFrames = 16;

  /// The file, or the bag's folder.
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return config_.path; }
  [[nodiscard]] std::string_view name() const noexcept override { return "mcap"; }
  [[nodiscard]] std::size_t queue_frames() const noexcept override { return kQueueFrames; }
  [[nodiscard]] Status put(const publish::LabelledFrame& frame) override;
  [[nodiscard]] Status put_figures(const status::MonitorSnapshot& figures) override;
  [[nodiscard]] Status finish() override;

 private:
  McapSink(Config config, publish::Stream stream);
  [[nodiscard]] bool is_bag() const { return is_bag(config_.path); }
  [[nodiscard]] static bool is_bag(const std::filesystem::path& path) {
    return path.extension() != ".mcap";
  }
  [[nodiscard]] static std::filesystem::path free_place(const std::filesystem::path& path);
  [[nodiscard]] std::size_t channel_of(std::size_t topic) const;
  [[nodiscard]] std::filesystem::path next_path() const;
  /// There is a file, and room in it and on its disk for a message of this time; each begins with
  /// the transform.
  [[nodiscard]] Status make_room(std::int64_t time_ns);
  [[nodiscard]] Status close_file();

  Config config_;
  publish::Stream stream_;
  std::vector<std::size_t> topics_;  ///< Of ros_messages::kTopics, one a channel.
  std::vector<Channel> channels_;
  std::optional<McapFile> file_;
  std::vector<BagFile> closed_;
  publish::Diagnoses diagnoses_;
  std::vector<std::byte> message_;
};

}  // namespace terracut::mcap
