// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/mcap/mcap_sink.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <utility>

#include "pipeline/ros_messages/diagnostic_array.hpp"
#include "pipeline/ros_messages/transform.hpp"
#include "rt/files/part_file.hpp"
#include "rt/files/room_left.hpp"
#include "rt/files/whole_file.hpp"

namespace terracut::mcap {
namespace {

namespace fs = std::filesystem;
using ros_messages::CloudOf;

bool is_recorded(const ros_messages::Topic& topic, const McapSink::Config& config,
                 const publish::RunFacts& facts) {
  if (!ros_messages::is_made(topic, facts)) return false;
  return !topic.cloud || *topic.cloud == CloudOf::kAll || !config.points_alone;
}

/// Returns a bag's name, which is its folder's: "drive" for "out/drive/".
std::string bag_name(const fs::path& folder) {
  const fs::path name = folder.has_filename() ? folder.filename() : folder.parent_path().filename();
  return name == "." || name == ".." ? "bag" : name.string();
}

/// Makes the folder of a bag, or accepts one that is empty.
Status make_bag_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    return fail(ErrorCode::kWriteFailed,
                fmt::format("{}: cannot be made: {}", folder.string(), error.message()));
  }
  if (!fs::is_empty(folder, error)) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("{}: there is something in it; a bag has a folder of its own, and a "
                            "single file a name that ends in .mcap",
                            folder.string()));
  }
  return {};
}

}  // namespace

Status McapSink::check(const Config& config) {
  const bool splits = config.split_bytes > 0 || config.split_ns > 0;
  if (is_bag(config.path) || !splits) return {};
  return fail(ErrorCode::kInvalidArgument,
              fmt::format("{} is one file; expected a folder, for one that is split",
                          config.path.string()));
}

fs::path McapSink::free_place(const fs::path& path) {
  const fs::path plain = path.has_filename() ? path : path.parent_path();  // for "drive/"
  for (std::uint64_t number = 1;; ++number) {
    fs::path place = plain;
    if (number > 1) {
      const fs::path ending = is_bag(plain) ? fs::path() : plain.extension();
      const fs::path stem = is_bag(plain) ? plain.filename() : plain.stem();
      place.replace_filename(fmt::format("{}_{}{}", stem.string(), number, ending.string()));
    }
    std::error_code error;
    if (fs::is_directory(place, error) && is_bag(plain)) {
      if (fs::is_empty(place, error) || error) return place;
    } else if (!fs::exists(fs::symlink_status(place, error)) && !files::has_part(place)) {
      return place;
    }
  }
}

Expected<std::unique_ptr<McapSink>> McapSink::open(Config config, publish::RunFacts facts) {
  if (const Status status = check(config); !status) return tl::unexpected(status.error());
  if (config.unattended) {
    if (const Status room = files::check_room_left(config.path); !room) {
      return tl::unexpected(room.error());
    }
    config.path = free_place(config.path);
  }
  std::unique_ptr<McapSink> sink(new McapSink(std::move(config), std::move(facts)));
  if (sink->is_bag()) {
    if (const Status made = make_bag_folder(sink->config_.path); !made) {
      return tl::unexpected(made.error());
    }
  }
  // Opens the first file now, so that errors show before the first frame.
  auto file = McapFile::create(sink->next_path(), sink->channels_, sink->config_.metadata);
  if (!file) return tl::unexpected(file.error());
  sink->file_.emplace(*std::move(file));
  return sink;
}

McapSink::McapSink(Config config, publish::RunFacts facts)
    : config_(std::move(config)), facts_(std::move(facts)) {
  for (std::size_t i = 0; i < ros_messages::kTopics.size(); ++i) {
    const ros_messages::Topic& topic = ros_messages::kTopics[i];
    if (!is_recorded(topic, config_, facts_)) continue;
    const Qos qos = i == ros_messages::kTransformsTopic ? Qos::kLatched : Qos::kReliable;
    topics_.push_back(i);
    channels_.push_back({std::string(topic.name), std::string(topic.schema.type),
                         std::string(topic.schema.definition), offered_qos_of(qos)});
  }
}

std::size_t McapSink::channel_of(std::size_t topic) const {
  return static_cast<std::size_t>(std::ranges::find(topics_, topic) - topics_.begin());
}

fs::path McapSink::next_path() const {
  if (!is_bag()) return config_.path;
  return config_.path / fmt::format("{}_{}.mcap", bag_name(config_.path), closed_.size());
}

Status McapSink::put(const publish::LabelledFrame& frame) {
  const std::int64_t time_ns = ros_messages::publish_time_ns_of(frame.record);
  if (const Status room = make_room(time_ns); !room) return room;
  for (std::size_t channel = 0; channel < topics_.size(); ++channel) {
    const ros_messages::Topic& topic = ros_messages::kTopics[topics_[channel]];
    if (topic.write == nullptr) continue;
    topic.write(frame, facts_.frame_id, message_);
    if (const Status added = file_->add_message(channel, time_ns, message_); !added) return added;
  }
  return {};
}

Status McapSink::put_figures(const status::MonitorSnapshot& figures) {
  if (const Status room = make_room(figures.taken_ns); !room) return room;
  ros_messages::write_diagnostic_array(figures.taken_ns, diagnoses_.of(figures), message_);
  return file_->add_message(channel_of(ros_messages::kDiagnosticsTopic), figures.taken_ns,
                            message_);
}

Status McapSink::finish() {
  return close_file();
}

Status McapSink::make_room(std::int64_t time_ns) {
  if (config_.unattended) {
    if (const Status room = files::check_room_left(config_.path); !room) {
      const Status closed = close_file();
      return closed ? room : closed;
    }
  }
  const McapFile::Span span = file_->span();
  const bool is_empty = file_->is_empty();
  const bool is_full =
      !is_empty && ((config_.split_bytes > 0 && file_->bytes() >= config_.split_bytes) ||
                    (config_.split_ns > 0 && time_ns > 0 &&
                     time_ns - static_cast<std::int64_t>(span.first_ns) >= config_.split_ns));
  if (is_full) {
    if (const Status closed = close_file(); !closed) return closed;
    auto file = McapFile::create(next_path(), channels_, config_.metadata);
    if (!file) return tl::unexpected(file.error());
    file_.emplace(*std::move(file));
  }
  if ((!is_empty && !is_full) || facts_.sensor_frame_id.empty()) return {};
  ros_messages::write_mount_transform(time_ns, facts_, message_);
  return file_->add_message(channel_of(ros_messages::kTransformsTopic), time_ns, message_);
}

Status McapSink::close_file() {
  if (const Status closed = file_->close(); !closed) return closed;
  BagFile closed{file_->path().filename().string(), file_->span(), {}};
  for (std::size_t channel = 0; channel < channels_.size(); ++channel) {
    closed.messages.push_back(file_->messages_of(channel));
  }
  closed_.push_back(std::move(closed));
  file_.reset();
  if (!is_bag()) return {};
  return files::write_whole_file(config_.path / "metadata.yaml", bag_metadata(channels_, closed_));
}

}  // namespace terracut::mcap
