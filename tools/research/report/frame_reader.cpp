// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "frame_reader.hpp"

#include <fmt/format.h>

#include "firmware_io/scan/label_file.hpp"

namespace terracut::report {

Status FrameReader::open(const std::string& sequence) {
  if (sequence == sequence_) return {};
  sequence_.clear();
  auto opened = dataset_.open(sequence);
  if (!opened) return tl::unexpected(opened.error());
  open_ = *std::move(opened);
  profile_ = scan::ring_profile(open_->rings(), mount_);
  scan_of_frame_.clear();
  for (std::size_t i = 0; i < open_->size(); ++i) scan_of_frame_[open_->frame(i)] = i;
  way_.reset();
  memory_ = std::make_unique<memory::FixedMemory>();
  way_ = std::make_unique<eval::DirectWay>(open_->shape(), mount_, *memory_);
  sequence_ = sequence;
  return {};
}

Status FrameReader::read(const std::string& sequence, const std::string& frame) {
  if (const Status opened = open(sequence); !opened) return opened;
  const auto found = scan_of_frame_.find(frame);
  if (found == scan_of_frame_.end()) {
    return fail(ErrorCode::kNotFound,
                fmt::format("{}/{}: the frame is not there any more", sequence, frame));
  }
  if (const Status read = open_->read(found->second, labelled_); !read) return read;
  const auto placed = way_->place(labelled_.scan.points, labelled_.rings.ring_of_point);
  if (!placed) return tl::unexpected(placed.error());
  placed_ = *placed;
  truth_.clear();
  is_road_.clear();
  for (const std::uint32_t point : placed_.point_of_return) {
    const std::uint16_t id = scan::semantic_class(labelled_.scan.labels[point]);
    truth_.push_back(classes_.role(id, datasets::GroundDefinition::kAll));
    is_road_.push_back(classes_.role(id, datasets::GroundDefinition::kRoad) ==
                       datasets::Role::kGround);
  }
  return {};
}

}  // namespace terracut::report
