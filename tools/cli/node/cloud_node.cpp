// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "cloud_node.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "calib/mount/mount_finder.hpp"
#include "calib/mount/mount_pose.hpp"
#include "pipeline/dds/cloud_buffer.hpp"
#include "pipeline/dds/ros_time.hpp"
#include "rt/measure/milliseconds.hpp"
#include "rt/measure/thread_cpu_clock.hpp"
#include "tools/cli/console.hpp"

namespace terracut::cli {
namespace {

/// At most kMostWaiting clouds, some hundred milliseconds, wait to be labelled. As many answers may
/// wait to be written, plus those to the first clouds, which are labelled together; each may have a
/// scene besides.
constexpr std::size_t kMostWaiting = 4, kMostAnswers = 2 * (kMostWaiting + mount::kFramesToFind);
/// If no cloud comes for this long, rows and mount are learnt from the clouds so far.
constexpr std::chrono::seconds kPatience{1};

}  // namespace

CloudNode::CloudNode(const Options& options, dds::CloudReader reader,
                     dds::TransformReader transforms, NodeAnswers answers, NodeNews& news)
    : news_(news),
      base_frame_(bag::frame_name(options.mount.base_frame)),
      answer_frame_(bag::frame_name(options.output.dds.frame)),
      transforms_(std::move(transforms)),
      reader_(std::move(reader)),
      answers_(std::move(answers)),
      labeller_(options),
      came_(kMostWaiting),
      answered_(kMostAnswers) {
  try {
    taker_ = std::jthread([this] { take_clouds(); });
    labelling_ = std::jthread([this] { label_clouds(); });
    writer_ = std::jthread([this] { write_answers(); });
  } catch (...) {  // the system refused a thread; earlier ones must end
    end();
    throw;
  }
}

CloudNode::~CloudNode() {
  end();
  first_clouds_.clear();
}

void CloudNode::end() {
  finish_ = true;
  for (std::jthread* const thread : {&taker_, &labelling_, &writer_}) {
    if (thread->joinable()) thread->join();
  }
}

void CloudNode::take_clouds() {
  constexpr std::int64_t kLookAtEnd_ns = 50'000'000;
  std::uint32_t number = 0;
  while (!finish_) {
    reader_.wait(kLookAtEnd_ns);
    while (dds::TakenCloud cloud = reader_.take()) {
      look_for_gap(*cloud);
      Job job{std::move(cloud), {}, {}};
      job.record.info.number = number++;
      job.record.info.complete = true;
      job.record.info.last_packet_ns = measure::realtime_ns();
      job.record.closing_packet_ns = job.record.info.last_packet_ns;
      news_.came(job.record.info.last_packet_ns);
      if (came_.push_out(std::move(job))) news_.count(NoAnswer::kPushedOut);
    }
  }
  came_.close();
}

void CloudNode::look_for_gap(const dds::RosCloud& cloud) {
  if (reader_.writers() > 1) return gaps_.restart();
  missing_ += gaps_.missing_before(dds::ns_of(cloud.header.stamp));
}

void CloudNode::label_clouds() {
  while (!came_.is_over()) {
    auto job = came_.pop(kPatience);
    if (!job) {
      if (!first_clouds_.empty()) set_up();
      continue;
    }
    job->record.handed_over_ns = measure::realtime_ns();
    if (labeller_.skip_if_late(job->record)) {  // so that a late cloud does not delay the next one
      news_.add(job->record);
      continue;
    }
    if (!read(*job->cloud) || !place(*job)) continue;
    if (labeller_.is_ready()) {
      label(*std::move(job));
    } else {
      learn_from(*std::move(job));
    }
  }
  answered_.close();
}

bool CloudNode::read(const dds::RosCloud& cloud) {
  if (const auto read = labeller_.read(dds::point_buffer_of(cloud, fields_)); !read) {
    news_.count(read.error().fault);
    say_once(std::string("clouds are refused: ") + read.error().message);
    return false;
  }
  if (labeller_.has_places()) return true;
  news_.count(NoAnswer::kNoPlace);
  say_once("clouds are refused: no point of them is a place");
  return false;
}

bool CloudNode::place(Job& job) {
  if (answer_frame_.empty()) return true;
  const std::string frame = bag::frame_name(job.cloud->header.frame_id);
  if (dds::MovedCloud::can_move(*job.cloud)) {
    job.T_answer_cloud = transforms_.tree().transform(frame, answer_frame_);
  }
  if (job.T_answer_cloud) return true;
  news_.count(NoAnswer::kNoTransform);
  say_once(
      fmt::format("clouds are refused: /tf_static does not join their frame '{:.100}' with '{}'",
                  frame, answer_frame_));
  return false;
}

void CloudNode::look_for_mount(const dds::RosCloud& cloud) {
  if (base_frame_ == "off" || !labeller_.is_mount_open()) return;
  const std::string frame = bag::frame_name(cloud.header.frame_id);
  if (is_vehicle_frame(frame)) return;
  const auto found = mount_in(transforms_.tree(), frame, base_frame_, "/tf_static");
  if (!found) return;
  if (is_new(found->note)) say(found->note);
  if (found->mount) labeller_.state_mount(*found->mount);
}

void CloudNode::learn_from(Job job) {
  look_for_mount(*job.cloud);
  first_clouds_.push_back(std::move(job));
  if (labeller_.learn_from_cloud()) set_up();
}

void CloudNode::set_up() {
  std::vector<Job> first = std::exchange(first_clouds_, {});
  if (const Status ready = labeller_.set_up(); !ready) {
    for (std::size_t i = 0; i < first.size(); ++i) refuse_rows(ready.error());
    return;
  }
  news_.set_sensor(labeller_.sensor());
  for (Job& job : first) {
    // There is no deadline, because nothing can be labelled before the sensor is known.
    job.record.info.last_packet_ns = 0;
    if (read(*job.cloud)) label(std::move(job));
  }
}

void CloudNode::label(Job job) {
  if (const Status labelled = labeller_.label(job.record); !labelled) {
    refuse_rows(labelled.error());
    return;
  }
  news_.add(job.record);
  const status::Level level = job.record.level;
  if (level != status::Level::kSkipped) {
    job.labels = labeller_.point_labels();
    job.heights_m = labeller_.point_heights_m();
    std::optional<NodeScene> scene;
    if (answers_.wants_scene()) scene = empty_scene_of(job);
    if (!answered_.push(std::move(job))) news_.count(NoAnswer::kUnanswered);
    if (scene) find_scene(*std::move(scene), level);
  }
  labeller_.watch_mount();
  news_.set_mount(labeller_.mount());
}

NodeScene CloudNode::empty_scene_of(const Job& job) const {
  const std_msgs_msg_dds__Header_& header = job.cloud->header;
  const mount::Mount& mount = labeller_.mount_in_use();
  const mount::RigidTransform T_cloud_vehicle = mount::inverse(mount::T_vehicle_lidar(mount));
  NodeScene scene{.frame = {},
                  .mount = mount,
                  .cloud_frame = header.frame_id,
                  .answer_frame = header.frame_id,
                  .T_answer_vehicle = T_cloud_vehicle};
  scene.frame.record.info.first_packet_ns = dds::ns_of(header.stamp);
  scene.frame.record.info.last_packet_ns = scene.frame.record.info.first_packet_ns;
  if (job.T_answer_cloud) {
    scene.answer_frame = answer_frame_;
    scene.T_answer_vehicle = mount::chained(*job.T_answer_cloud, T_cloud_vehicle);
  }
  return scene;
}

void CloudNode::find_scene(NodeScene scene, status::Level level) {
  if (level != status::Level::kFull) return news_.count(NoAnswer::kNoScene);
  labeller_.find_scene(scene.frame);
  if (!answered_.push(std::move(scene))) news_.count(NoAnswer::kNoScene);
}

void CloudNode::refuse_rows(const Error& error) {
  news_.count(NoAnswer::kNoRows);
  say_once("clouds are refused: " + error.message);
}

void CloudNode::say_once(const std::string& what) {
  if (is_new(what)) warn(what + " (counted from now on, as losses)");
}

bool CloudNode::is_new(const std::string& text) {
  // Messages contain numbers, so there is no limit to their kinds.
  constexpr std::size_t kMostKinds = 16;
  if (said_.size() >= kMostKinds || std::ranges::count(said_, text) > 0) return false;
  said_.push_back(text);
  return true;
}

void CloudNode::write_answers() {
  bool said = false;
  while (!answered_.is_over()) {
    auto answer = answered_.pop(kPatience);
    if (!answer) continue;
    const Status written = std::visit([&](auto& some) { return write(some); }, *answer);
    if (written) continue;
    news_.count(NoAnswer::kUnwritten);
    if (!said) warn(written.error().message);
    said = true;
  }
}

Status CloudNode::write(const Job& job) {
  const status::FrameRecord& record = job.record;
  const auto since = [&](std::int64_t then_ns) {
    return then_ns == 0 ? 0.0 : measure::milliseconds(record.labels_ns - then_ns);
  };
  const NodeAnswers::Times times{since(record.closing_packet_ns),
                                 since(std::exchange(labels_before_ns_, record.labels_ns))};
  const dds::RosCloud& cloud =
      job.T_answer_cloud ? moved_.move(*job.cloud, *job.T_answer_cloud, answer_frame_) : *job.cloud;
  return answers_.write(cloud, job.labels, job.heights_m, times);
}

}  // namespace terracut::cli
