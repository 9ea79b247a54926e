// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "node_labeller.hpp"
#include "node_news.hpp"
#include "node_topics.hpp"
#include "pipeline/dds/moved_cloud.hpp"
#include "pipeline/dds/transform_reader.hpp"
#include "rt/queues/bounded_queue.hpp"
#include "stamp_gaps.hpp"

namespace terracut::cli {

/// Takes clouds from DDS and writes answers, on three threads with bounded queues between them:
///
///   takes  --->  labels, before the deadline  --->  writes
///
/// Objects and the free way are looked for once labels were handed on, and left out if the cloud
/// was not labelled by the whole method: then time is short. They follow its labels.
/// If clouds wait to be labelled, the oldest are pushed out; if answers are not written in time,
/// the newest answer is left out. Both are counted.
class CloudNode {
 public:
  CloudNode(const Options& options, dds::CloudReader reader, dds::TransformReader transforms,
            NodeAnswers answers, NodeNews& news);
  ~CloudNode();

  /// Returns how many clouds are lost: as reported by DDS or as gaps in stamps show, whichever is
  /// more. For any thread.
  [[nodiscard]] std::uint64_t lost_clouds() const {
    return std::max(reader_.lost(), missing_.load(std::memory_order_relaxed));
  }

 private:
  struct Job {
    dds::TakenCloud cloud;
    status::FrameRecord record;
    std::vector<frame::Label> labels;
    std::vector<float> heights_m{};                         ///< Empty unless asked for.
    std::optional<mount::RigidTransform> T_answer_cloud{};  ///< Empty: answers stay in its frame.
  };

  void end();
  void take_clouds();
  void look_for_gap(const dds::RosCloud& cloud);
  void label_clouds();
  void write_answers();

  /// Returns false if the cloud is refused, which is then counted.
  [[nodiscard]] bool read(const dds::RosCloud& cloud);
  /// Looks up where the answers to a cloud lie. Returns false if it is refused, as read() does.
  [[nodiscard]] bool place(Job& job);
  /// Takes figures of the mount that are not stated from transforms.
  void look_for_mount(const dds::RosCloud& cloud);
  /// Keeps a first cloud for learning. It is answered, without deadline, once rows and mount are
  /// known.
  void learn_from(Job job);
  void set_up();
  void label(Job job);
  /// Returns when and where a cloud's scene was seen, before anything is found in it.
  [[nodiscard]] NodeScene empty_scene_of(const Job& job) const;
  /// Looks at the cloud labelled last, after its labels were handed on to be written.
  void find_scene(NodeScene scene, status::Level level);
  [[nodiscard]] Status write(const Job& job);
  [[nodiscard]] Status write(NodeScene& scene) { return answers_.write(scene); }
  void refuse_rows(const Error& error);
  void say_once(const std::string& what);
  /// True if it was not asked of this text before.
  [[nodiscard]] bool is_new(const std::string& text);

  NodeNews& news_;
  std::string base_frame_, answer_frame_;
  dds::TransformReader transforms_;  ///< For the labelling thread.
  dds::CloudReader reader_;          ///< Declared before queues of clouds in its memory.
  NodeAnswers answers_;
  dds::MovedCloud moved_;              ///< For the writing thread.
  std::int64_t labels_before_ns_ = 0;  ///< For the writing thread: when the last labels were made.
  NodeLabeller labeller_;
  std::vector<PointField> fields_;
  std::vector<Job> first_clouds_;
  std::vector<std::string> said_;
  queues::BoundedQueue<Job> came_;
  queues::BoundedQueue<std::variant<Job, NodeScene>> answered_;
  StampGaps gaps_;
  std::atomic<std::uint64_t> missing_{0};
  std::atomic<bool> finish_{false};
  std::jthread taker_, labelling_, writer_;  ///< Declared last: use all members.
};

}  // namespace terracut::cli
