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
/// An unattended recording (Config::unattended) never overwrites an older one and leaves room on
/// the disk for others.
class McapSink final : public publish::FrameSink {
 public:
  struct Config {
    std::filesystem::path path;
    /// A bag's file ends at so many bytes or so much time; 0: no such limit.
    std::uint64_t split_bytes = 0;
    std::int64_t split_ns = 0;
    /// Records only points, whose label tells ground from obstacles; else also ground and
    /// obstacles, and road if there is one, in clouds of their own.
    bool points_alone = false;
    McapFile::Metadata metadata{};  ///< Stored in every file.
    /// Takes the next free name: "drive_2.mcap" if "drive.mcap" or a killed process's part of it
    /// exists, "drive_2" if the folder "drive" has anything in it, and so on. Ends with a complete
    /// file, and an error of put(), when the disk has no room left (files::check_room_left()).
    bool unattended = false;
  };

  /// kInvalidArgument: a split for a single file.
  [[nodiscard]] static Status check(const Config& config);
  /// kInvalidArgument: as check(), or a bag's folder that is not empty. kWriteFailed.
  [[nodiscard]] static Expected<std::unique_ptr<McapSink>> open(Config config,
                                                                publish::RunFacts facts);

  /// Returns the memory for frames of so many returns with a full queue: the queue, the frames in
  /// work at either end, the message, its chunk, the compressed chunk, and zstd's own.
  [[nodiscard]] static constexpr std::size_t memory_bytes(std::size_t returns) noexcept {
    constexpr std::size_t kZstd_bytes = std::size_t{2} << 20;
    return returns * sizeof(points::LabelledPoint) * (kQueueFrames + 5) + kZstd_bytes;
  }

  /// A second and a half, as disks stall at times.
  static constexpr std::size_t kQueueFrames = 16;

  /// Returns the file, or the bag's folder.
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return config_.path; }
  [[nodiscard]] std::string_view name() const noexcept override { return "mcap"; }
  [[nodiscard]] std::size_t queue_frames() const noexcept override { return kQueueFrames; }
  [[nodiscard]] Status put(const publish::LabelledFrame& frame) override;
  [[nodiscard]] Status put_figures(const status::MonitorSnapshot& figures) override;
  [[nodiscard]] Status finish() override;

 private:
  McapSink(Config config, publish::RunFacts facts);
  [[nodiscard]] bool is_bag() const { return is_bag(config_.path); }
  [[nodiscard]] static bool is_bag(const std::filesystem::path& path) {
    return path.extension() != ".mcap";
  }
  [[nodiscard]] static std::filesystem::path free_place(const std::filesystem::path& path);
  [[nodiscard]] std::size_t channel_of(std::size_t topic) const;
  [[nodiscard]] std::filesystem::path next_path() const;
  /// Makes sure that a file is open, with room in it and on its disk for a message of this time.
  /// Each file begins with the transform.
  [[nodiscard]] Status make_room(std::int64_t time_ns);
  [[nodiscard]] Status close_file();

  Config config_;
  publish::RunFacts facts_;
  std::vector<std::size_t> topics_;  ///< Indices into ros_messages::kTopics, one a channel.
  std::vector<Channel> channels_;
  std::optional<McapFile> file_;
  std::vector<BagFile> closed_;
  publish::Diagnoses diagnoses_;
  std::vector<std::byte> message_;
};

}  // namespace terracut::mcap
