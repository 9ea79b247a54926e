// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/output/frame_outputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "pipeline/output/label_sink.hpp"
#include "pipeline/output/pcd_writer.hpp"
#include "pipeline/pictures/bird_eye_picture.hpp"
#include "pipeline/pictures/caption.hpp"
#include "pipeline/pictures/range_image_picture.hpp"
#include "tools/lab/quality/quality.hpp"

namespace terracut::cli {
namespace {

using frame::Label;
using pictures::Mistake;
using quality::TruthClass;

Mistake mistake_of(Label label, std::uint32_t truth) noexcept {
  switch (quality::truth_class(truth)) {
    case TruthClass::kIgnored:
      return Mistake::kNone;
    case TruthClass::kGround:
      return label == Label::kObstacle ? Mistake::kFalseObstacle : Mistake::kNone;
    case TruthClass::kOrdinaryObstacle:
    case TruthClass::kKeyObstacle:
      break;
  }
  return is_ground(label) ? Mistake::kMissedObstacle : Mistake::kNone;
}

}  // namespace

void FrameOutputs::find_scene(scene::Wanted wanted, const mount::RingProfile& profile,
                              frame::ImageShape shape, std::size_t return_capacity) {
  finder_.emplace(wanted, profile, shape, return_capacity, memory_);
}

void FrameOutputs::look(const frame::RangeImage& image, const frame::RangeImage& as_measured,
                        std::span<const Label> labels, std::span<const float> heights_m,
                        bool is_whole) {
  if (finder_) finder_->find(image, as_measured, labels, heights_m, is_whole);
}

Status FrameOutputs::write_labels(const std::string& name, std::span<const Label> labels,
                                  std::span<const std::uint16_t> objects) {
  if (options_.labels.empty()) return {};
  return labels_.place(name + ".label").and_then([&](const std::filesystem::path& path) {
    return output::write_label_file(path, labels, objects);
  });
}

Status FrameOutputs::write_frame(const std::string& name, const frame::RangeImage& image,
                                 std::span<const Label> labels, std::span<const float> heights_m,
                                 std::span<const std::uint32_t> truth) {
  if (!options_.pcd.empty()) {
    const Status written =
        pcd_.place(name + ".pcd").and_then([&](const std::filesystem::path& path) {
          return output::write_pcd(path, image, labels, heights_m);
        });
    if (!written) return written;
  }
  if (options_.png.empty()) return {};
  const pictures::LabelledFrame plain{image, labels, {}, objects(), free_way()};
  const auto legend = legend_of(plain);
  const Status from_above =
      draw(name + ".birdseye.png",
           with_caption(
               bird_eye_picture(plain),
               fmt::format("frame {} from above, forward is up: {} returns", name, labels.size()),
               legend));
  if (!from_above) return from_above;
  const Status panorama =
      draw(name + ".range.png",
           with_caption(range_image_picture(plain),
                        fmt::format("frame {} as the sensor sees it: {} lasers, darker is farther",
                                    name, image.shape().rows),
                        legend));
  if (!panorama || truth.size() != labels.size()) return panorama;

  mistakes_.resize(labels.size());
  std::transform(labels.begin(), labels.end(), truth.begin(), mistakes_.begin(), mistake_of);
  const pictures::LabelledFrame judged{image, labels, mistakes_, {}, {}};
  const auto count = [&](Mistake mistake) { return std::ranges::count(mistakes_, mistake); };
  return draw(
      name + ".mistakes.png",
      with_caption(bird_eye_picture(judged),
                   fmt::format("frame {} against the truth: {} returns missed, {} false", name,
                               count(Mistake::kMissedObstacle), count(Mistake::kFalseObstacle)),
                   legend_of(judged)));
}

Status FrameOutputs::open(const publish::RunFacts& facts) {
  if (!wants_sinks(options_)) return {};
  auto sinks = open_sinks(options_, facts);
  if (!sinks) return tl::unexpected(sinks.error());
  publisher_.emplace(*std::move(sinks), publish::WhenFull::kWait, warn_of_failure);
  return {};
}

Status FrameOutputs::publish(const status::FrameRecord& record, const frame::RangeImage& image,
                             std::span<const Label> labels, std::span<const float> heights_m,
                             const points::FrameTiming& timing) {
  if (!publisher_) return {};
  const auto shared = publisher_->buffer();
  shared->record = record;
  shared->points.resize(labels.size());
  shared->heights_m.assign(heights_m.begin(), heights_m.end());
  (void)points::pack_labelled_points(image, labels, shared->points, timing);
  if (finder_) publish::set_scene(*finder_, *shared);
  publisher_->put(shared);
  return publisher_->outcome();
}

Status FrameOutputs::finish() {
  if (!publisher_) return {};
  (void)publisher_->finish(std::nullopt);
  return publisher_->outcome();
}

Status FrameOutputs::draw(const std::string& name, const pictures::Picture& picture) {
  return png_.place(name).and_then(
      [&](const std::filesystem::path& path) { return picture.write_png(path); });
}

}  // namespace terracut::cli
