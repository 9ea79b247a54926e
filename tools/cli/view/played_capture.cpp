// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "played_capture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "firmware_io/capture/capture_clock.hpp"
#include "pipeline/points/labelled_points.hpp"
#include "tools/cli/settings/decoder_choice.hpp"

namespace terracut::cli {

/// Finds the ends of a capture's frames in order, from its first frame on. Frames are numbered by
/// their ends, because after a seek the first frame does not begin where it did before.
class PlayedCapture::Counter {
 public:
  Counter(const OpenCapture& capture, const Options& options)
      : source_(open_again(capture, options.capture)),
        decoder_(capture.calibration, mount::kAtTheSensor,
                 decoder_config_of(options, capture.sensor.columns), memory_) {
    if (source_) part_.emplace(*source_, CaptureOptions{});
  }

  /// Returns the end of the next frame; nothing at the end of the capture, or when stop_wanted().
  std::optional<std::int64_t> next() {
    while (true) {
      if (const frame::Frame* frame = decoder_.next()) {
        return part_->clock().since_begin_ns(frame->info.last_packet_ns);
      }
      const packet::Datagram* datagram = part_ && !ended_ ? part_->next() : nullptr;
      if (datagram != nullptr) {
        decoder_.push(*datagram);
      } else if (std::exchange(ended_, true)) {
        return std::nullopt;
      } else {
        decoder_.end_stream();
      }
    }
  }

 private:
  Expected<capture::CaptureSource> source_;
  std::optional<CapturePart> part_;
  memory::FixedMemory memory_;
  decode::Decoder decoder_;
  bool ended_ = false;
};

PlayedCapture::PlayedCapture(LabelledCapture& capture, const Options& options, FrameTruth truth,
                             std::unique_ptr<CaptureLabels> beside)
    : capture_(capture),
      options_(options),
      truth_(std::move(truth)),
      beside_(std::move(beside)),
      begins_(options.capture.start_s == 0) {
  const scene::Wanted wanted = options.method.scene;
  if (!wanted.any()) return;
  const decode::Decoder& decoder = capture.decoder();
  scene_.emplace(wanted, capture.profile(), decoder.shape(), decoder.return_capacity(), memory_);
}
PlayedCapture::~PlayedCapture() = default;

double PlayedCapture::frame_s() const {
  constexpr double kUsual_s = 0.1;
  const double spin_hz = capture_.capture().sensor.spin_hz;
  return spin_hz > 0 ? 1 / spin_hz : kUsual_s;
}

std::optional<PlayedRecording::Span> PlayedCapture::next() {
  frame_ = capture_.next();
  if (frame_ == nullptr) return std::nullopt;
  const frame::FrameInfo& info = frame_->record.info;
  span_ = {capture_.since_begin_ns(info.first_packet_ns),
           capture_.since_begin_ns(info.last_packet_ns)};
  if (std::exchange(begins_, false)) ahead_ = info.number;
  const bool is_next = ahead_ && info.number - *ahead_ == ends_ns_.size();
  if (is_next && !counter_) ends_ns_.push_back(span_.end_ns);
  return span_;
}

Status PlayedCapture::take(PlayedFrame& frame) {
  frame.record = frame_->record;
  frame.points.resize(frame_->image->returns());
  (void)points::pack_labelled_points(*frame_->image, capture_.labels(), frame.points,
                                     capture_.timing(*frame_));
  const std::span<const float> heights_m = capture_.heights_m();
  frame.heights_m.assign(heights_m.begin(), heights_m.end());
  if (scene_) {
    scene_->find(*frame_->image, *frame_->as_measured, capture_.labels(), heights_m);
    publish::set_scene(*scene_, frame);
  }
  if (!ahead_) ahead_ = frame.record.info.number - number_of(span_.end_ns);
  frame.record.info.number -= *ahead_;
  const frame::FrameInfo& info = frame.record.info;
  const Status read = truth_.read(fmt::format("{:06}", info.number), info.returns);
  const std::span<const frame::Label> beside =
      beside_ ? beside_->of(info, span_.end_ns) : std::span<const frame::Label>();
  compare(capture_.labels(), beside, truth_.labels(), frame.comparison);
  return info.complete ? doubt_.judge(read) : Status();
}

Status PlayedCapture::go_to(double seek_s) {
  // Goes back one frame too many, because the first frame after a seek is cut off at its beginning.
  const double from_s = std::max(0.0, seek_s - 1.25 * frame_s());
  ahead_.reset();
  begins_ = from_s == 0;
  if (beside_) {
    if (Status gone = beside_->go_to(from_s); !gone) return gone;
  }
  return capture_.rewind(from_s);
}

std::uint32_t PlayedCapture::number_of(std::int64_t end_ns) {
  // The end may differ by some packets from the one noted before, if the frame was cut elsewhere.
  const std::int64_t least_ns = end_ns - static_cast<std::int64_t>(frame_s() / 2 * 1e9);
  const auto is_known = [&] { return !ends_ns_.empty() && ends_ns_.back() >= least_ns; };
  if (!is_known() && !counter_) {
    counter_ = std::make_unique<Counter>(capture_.capture(), options_);
    ends_ns_.clear();
  }
  while (!is_known()) {
    const auto ends = counter_->next();
    if (!ends) break;
    ends_ns_.push_back(*ends);
  }
  const auto found = std::ranges::lower_bound(ends_ns_, least_ns);
  return static_cast<std::uint32_t>(found - ends_ns_.begin());
}

/// Reads the whole capture, because its file does not state how long it is.
void PlayedCapture::measure(const OnLength& on_length) const {
  auto source = open_again(capture_.capture(), options_.capture);
  constexpr std::uint64_t kPacketsAtOnce = 4096;
  capture::CaptureClock clock;
  std::int64_t begin_ns = 0, longest_ns = 0;
  for (std::uint64_t read = 0; source; ++read) {
    const auto next = source->next();
    if (!next || !*next) break;
    if (read == 0) begin_ns = (*next)->stamp_ns;
    longest_ns = std::max(longest_ns, clock.add((*next)->stamp_ns));
    if (read % kPacketsAtOnce == 0 && !on_length(begin_ns, longest_ns)) return;
  }
  (void)on_length(begin_ns, longest_ns);
}

}  // namespace terracut::cli
