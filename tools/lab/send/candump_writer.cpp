// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "candump_writer.hpp"

#include <fmt/format.h>

#include "firmware_io/can/candump_line.hpp"
#include "rt/files/whole_file.hpp"

namespace terracut::send {

Status CandumpWriter::write(const can::CanFrame& frame) {
  const auto refuse = [&](const std::string& what) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("{}: frame {}: {}", path_.string(), frames_, what));
  };
  if (frame.stamp_ns < 0) {
    return refuse(fmt::format("its stamp {} ns lies before 1970", frame.stamp_ns));
  }
  if (frame.error ? frame.id.number > can::CanId::kExtendedMost : !frame.id.valid()) {
    return refuse(fmt::format("id {:#x} is more than its format holds", frame.id.number));
  }
  if (frame.fd ? !can::is_fd_length(frame.length)
               : frame.length > can::CanFrame::kMostClassicBytes) {
    return refuse(fmt::format("no frame of its kind has {} bytes", frame.length));
  }
  if (frame.fd && (frame.remote || frame.error)) {
    return refuse("a CAN FD frame is neither remote nor an error");
  }
  text_ += can::candump_line(frame, interface_);
  ++frames_;
  return {};
}

Status CandumpWriter::finish() const {
  return files::write_whole_file(path_, text_);
}

}  // namespace terracut::send
