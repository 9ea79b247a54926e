// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "capture_labels.hpp"

#include <utility>

#include "tools/cli/console.hpp"

namespace terracut::cli {

Expected<std::unique_ptr<CaptureLabels>> CaptureLabels::open(const LabelledCapture& capture,
                                                             const Options& options,
                                                             const MethodOptions& method) {
  Options again = options;
  again.mount = capture.mount().options;
  again.method = method;
  again.can_recording.clear();  // labels come from returns as they were measured
  const HeardLines said_already;
  auto opened = LabelledCapture::open(again, LabelledCapture::Makes::kLabels);
  if (!opened) return tl::unexpected(opened.error());
  return std::unique_ptr<CaptureLabels>(new CaptureLabels(*std::move(opened)));
}

std::span<const frame::Label> CaptureLabels::of(const frame::FrameInfo& info, std::int64_t end_ns) {
  const HeardLines said_already;
  const auto is_before = [&] {
    return capture_->since_begin_ns(frame_->record.info.last_packet_ns) < end_ns;
  };
  while (frame_ == nullptr || is_before()) {
    frame_ = capture_->next();
    if (frame_ == nullptr) return {};
  }
  const frame::FrameInfo& found = frame_->record.info;
  const bool is_same =
      found.first_packet_ns == info.first_packet_ns && found.last_packet_ns == info.last_packet_ns;
  return is_same ? capture_->labels() : std::span<const frame::Label>();
}

Status CaptureLabels::go_to(double start_s) {
  frame_ = nullptr;
  return capture_->rewind(start_s);
}

}  // namespace terracut::cli
