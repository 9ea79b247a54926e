// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "replayed_frames.hpp"

#include <pybind11/stl.h>

#include <utility>

#include "json_object.hpp"
#include "pipeline/points/labelled_points.hpp"
#include "raised_error.hpp"
#include "tools/cli/arguments/arguments.hpp"

namespace terracut::python {
namespace py = pybind11;

ReplayedFrames::ReplayedFrames(const std::vector<std::string>& words)
    : capture_(or_raise(without_the_lock([&]() -> Expected<std::unique_ptr<cli::LabelledCapture>> {
        const auto arguments = cli::parse_arguments(words);
        if (!arguments) return tl::unexpected(arguments.error());
        wanted_ = arguments->options.method.scene;
        return cli::LabelledCapture::open(arguments->options, cli::LabelledCapture::Makes::kPoints);
      }))) {
  if (!wanted_.any()) return;
  const decode::Decoder& decoder = capture_->decoder();
  scene_.emplace(wanted_, capture_->profile(), decoder.shape(), decoder.return_capacity(), memory_);
}

std::shared_ptr<FrameData> ReplayedFrames::next() {
  return or_raise(without_the_lock([&] {
    const std::lock_guard lock(mutex_);
    return next_unlocked();
  }));
}

Expected<std::shared_ptr<FrameData>> ReplayedFrames::next_unlocked() {
  if (const run::Frame* frame = capture_->next()) {
    std::shared_ptr<FrameData> data = buffers_.take();
    data->info = frame->record.info;
    data->record = frame->record;
    labelled_.resize(frame->image->returns());
    if (!points::pack_labelled_points(*frame->image, capture_->labels(), labelled_,
                                      capture_->timing(*frame))) {
      return fail(ErrorCode::kMalformed, "a frame has not as many labels as returns");
    }
    data->points.resize(labelled_.size());
    std::ranges::transform(labelled_, data->points.begin(), stream::wire_point);
    const std::span<const float> heights_m = capture_->heights_m();
    data->heights_m.assign(heights_m.begin(), heights_m.end());
    data->objects.reset();
    if (scene_) scene_->find(*frame->image, *frame->as_measured, capture_->labels(), heights_m);
    data->free_way.reset();
    if (wanted_.free_way)
      data->free_way.emplace(scene_->free_way().begin(), scene_->free_way().end());
    if (wanted_.objects) data->set_objects(scene_->objects(), scene_->object_of_return());
    return data;
  }
  if (std::exchange(concluded_, true)) return nullptr;
  if (const Status concluded = capture_->conclude(); !concluded) {
    return tl::unexpected(concluded.error());
  }
  return nullptr;
}

nlohmann::ordered_json ReplayedFrames::report() {
  return without_the_lock([&] {
    const std::lock_guard lock(mutex_);
    nlohmann::ordered_json report = capture_->report().json();
    report.erase("frames");
    return report;
  });
}

void bind_replay(py::module_& module) {
  py::class_<ReplayedFrames>(module, "Replay", "The labelled frames of a capture, in order.")
      .def(py::init<const std::vector<std::string>&>())
      .def("__iter__", [](const py::object& self) { return self; })
      .def("__next__",
           [](ReplayedFrames& frames) {
             std::shared_ptr<FrameData> frame = frames.next();
             if (!frame) throw py::stop_iteration();
             return frame;
           })
      .def_property_readonly("sensor", &ReplayedFrames::sensor)
      .def_property_readonly("calibration", &ReplayedFrames::calibration)
      .def("report", [](ReplayedFrames& frames) { return json_object(frames.report()); });
}

}  // namespace terracut::python
