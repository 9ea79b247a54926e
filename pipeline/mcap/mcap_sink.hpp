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
/// A path that ends in ".mcap" is one file. Any other path is the folder of a bag in rosbag2's
/// form: NAME_0.mcap, NAME_1.mcap, ... and metadata.yaml, which is written again whenever a file is
/// full.
///
/// An unattended recording (Config::unattended) never overwrites an older one and leaves free space
/// on the disk for other programs.
class McapSink final : public publish::FrameSink {
 public:
  struct Config {
    std::filesystem::path path;
    /// A bag begins a new file at this many bytes or this much time; 0: no such limit.
    std::uint64_t split_bytes = 0;
    std::int64_t split_ns = 0;
    /// True: records only the cloud of all points, whose labels tell ground from obstacles. False:
    /// ground, obstacles and, if labelled, road have a cloud each, too.
    bool points_alone = false;
    McapFile::Metadata metadata{};  ///< Stored in every file.
    /// True: takes the next free name: "drive_2.mcap" if "drive.mcap" exists or a killed process
    /// has left a part of it, "drive_2" if the folder "drive" is not empty, and so on. When the
    /// disk has no room left (files::check_room_left()), put() completes the file and fails.
    bool unattended = false;
  };

  /// Fails with kInvalidArgument if a single file is to be split.
  [[nodiscard]] static Status check(const Config& config);
  /// Fails with the errors of check(), kInvalidArgument for a folder not empty, or kWriteFailed.
  [[nodiscard]] static Expected<std::unique_ptr<McapSink>> open(Config config,
                                                                publish::RunFacts facts);

  /// Returns the memory used while the queue is full of frames with this many returns: the queue, a
  /// frame before it and a frame behind it, the message, its chunk, the compressed chunk, and
  /// zstd's own.
  [[nodiscard]] static constexpr std::size_t memory_bytes(std::size_t returns) noexcept {
    constexpr std::size_t kZstd_bytes = std::size_t{2} << 20;
    return returns * sizeof(points::LabelledPoint) * (kQueueFrames + 5) + kZstd_bytes;
  }

  /// The queue holds frames of 1.5 seconds, because disks stall at times.
  static constexpr std::size_t kQueueFrames = 16;

  /// Returns the path of the file or of the bag's folder.
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
  /// Makes sure that a file is open, and that both the file's limits and the disk allow another
  /// message at this time. Each file begins with the transform.
  [[nodiscard]] Status make_room(std::int64_t time_ns);
  [[nodiscard]] Status close_file();

  Config config_;
  publish::RunFacts facts_;
  std::vector<std::size_t> topics_;  ///< Per channel: index into ros_messages::kTopics.
  std::vector<Channel> channels_;
  std::optional<McapFile> file_;
  std::vector<BagFile> closed_;
  publish::Diagnoses diagnoses_;
  std::vector<std::byte> message_;
};

}  // namespace terracut::mcap
