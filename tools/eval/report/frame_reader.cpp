// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "frame_reader.hpp"

#include <fmt/format.h>

namespace terracut::evaluation::report {

Status FrameReader::open(const std::string& sequence) {
  if (sequence == sequence_) return {};
  sequence_.clear();
  auto reader = firmware_io::ScanReader::open(root_ / "sequences" / sequence);
  if (!reader) return tl::unexpected(reader.error());
  reader_ = std::make_unique<firmware_io::ScanReader>(*std::move(reader));
  const auto fitted = reader_->fit_rings();
  if (!fitted) return tl::unexpected(fitted.error());
  calibration_ = firmware_io::hdl64e_calibration(fitted->table);
  profile_ = calib::ring_profile(calibration_, mount_);
  scan_of_frame_.clear();
  for (std::size_t i = 0; i < reader_->size(); ++i) scan_of_frame_[reader_->file(i).name] = i;
  way_.reset();
  memory_ = std::make_unique<rt::FixedMemory>();
  way_ = std::make_unique<DirectWay>(calibration_, mount_, *memory_);
  sequence_ = sequence;
  return {};
}

Status FrameReader::read(const std::string& sequence, const std::string& frame) {
  if (const Status opened = open(sequence); !opened) return opened;
  const auto found = scan_of_frame_.find(frame);
  if (found == scan_of_frame_.end() || !reader_->file(found->second).labels) {
    return fail(
        ErrorCode::kNotFound,
        fmt::format("{}/{}: the frame or its labels are not there any more", sequence, frame));
  }
  if (const Status read = reader_->read(found->second, scan_, rings_); !read) return read;
  const auto placed = way_->place(scan_.points, rings_.ring_of_point);
  if (!placed) return tl::unexpected(placed.error());
  placed_ = *placed;
  truth_.clear();
  for (const std::uint32_t point : placed_.point_of_return) {
    const ClassEntry* const entry = classes_.find(static_cast<std::uint16_t>(scan_.labels[point]));
    truth_.push_back(entry == nullptr ? Role::kIgnored : entry->role(GroundDefinition::kAll));
  }
  return {};
}

}  // namespace terracut::evaluation::report
