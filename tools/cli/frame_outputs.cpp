// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "frame_outputs.hpp"

#include <algorithm>

#include "firmware_io/sinks/bird_eye_picture.hpp"
#include "firmware_io/sinks/label_sink.hpp"
#include "firmware_io/sinks/pcd_writer.hpp"
#include "firmware_io/sinks/range_image_picture.hpp"
#include "pipeline/quality.hpp"

namespace terracut::cli {
namespace {

using firmware_io::Mistake;
using pipeline::Label;
using pipeline::TruthClass;

Mistake mistake_of(Label label, std::uint32_t truth) noexcept {
  switch (pipeline::truth_class(truth)) {
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

Status FrameOutputs::write_labels(const std::string& name, std::span<const Label> labels) const {
  if (options_.labels.empty()) return {};
  return firmware_io::write_label_file(options_.labels / (name + ".label"), labels);
}

Status FrameOutputs::write_frame(const std::string& name, const pipeline::RangeImage& image,
                                 std::span<const Label> labels,
                                 std::span<const std::uint32_t> truth) {
  if (!options_.pcd.empty()) {
    const Status written = firmware_io::write_pcd(options_.pcd / (name + ".pcd"), image, labels);
    if (!written) return written;
  }
  if (options_.png.empty()) return {};
  const firmware_io::LabelledFrame plain{image, labels, {}};
  const Status from_above =
      bird_eye_picture(plain).write_png(options_.png / (name + ".birdseye.png"));
  if (!from_above) return from_above;
  const Status panorama =
      range_image_picture(plain).write_png(options_.png / (name + ".range.png"));
  if (!panorama || truth.size() != labels.size()) return panorama;

  mistakes_.resize(labels.size());
  std::transform(labels.begin(), labels.end(), truth.begin(), mistakes_.begin(), mistake_of);
  return firmware_io::bird_eye_picture({image, labels, mistakes_})
      .write_png(options_.png / (name + ".mistakes.png"));
}

}  // namespace terracut::cli
