// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "live_frames.hpp"

#include <pybind11/stl.h>

#include <utility>

#include "calib/beams/angle.hpp"
#include "firmware_io/net/ipv4_endpoint.hpp"
#include "pipeline/output/label_sink.hpp"
#include "raised_error.hpp"
#include "tools/cli/arguments/arguments.hpp"

namespace terracut::python {
namespace py = pybind11;
namespace {

/// True if a signal came whose handler raised an exception; that exception is then set.
bool is_interrupted() {
  const py::gil_scoped_acquire locked;
  return PyErr_Occurred() != nullptr || PyErr_CheckSignals() != 0;
}

Expected<LiveRun::Config> config_of(const cli::Options& options) {
  LiveRun::Config config;
  const auto endpoint = net::parse_ipv4_endpoint(options.listen.address);
  if (!endpoint) return tl::unexpected(endpoint.error());
  config.address = net::ipv4_text(endpoint->address);
  config.port = endpoint->port;
  if (!options.capture.calibration.empty()) {
    const auto calibration = Calibration::load(options.capture.calibration);
    if (!calibration) return tl::unexpected(calibration.error());
    config.calibration = *calibration;
  }
  const cli::MountOptions& mount = options.mount;
  config.mount.height_m = mount.height_m.value_or(config.mount.height_m);
  config.mount.roll_rad = beams::deg_to_rad(mount.roll_deg.value_or(0));
  config.mount.pitch_rad = beams::deg_to_rad(mount.pitch_deg.value_or(0));
  config.deadline_ms = options.deadline_ms;
  config.gather_ms = options.listen.gather_ms;
  config.priority = options.realtime.priority;
  config.lock_memory = options.realtime.lock_memory;
  config.patience_s = options.patience_s;
  config.heights = options.method.heights;
  config.objects = options.method.scene.objects;
  config.free_way = options.method.scene.free_way;
  return config;
}

/// Copies points, labels and heights of a frame or sector; times are 0.
template <class Labelled>
void copy_points(const Labelled& from, FrameData& to) {
  to.heights_m.assign(from.height_above_ground_m.begin(), from.height_above_ground_m.end());
  to.points.resize(from.points.size());
  for (std::size_t i = 0; i < from.points.size(); ++i) {
    const Point& point = from.points[i];
    to.points[i] = {point.x_m,
                    point.y_m,
                    point.z_m,
                    point.intensity,
                    static_cast<std::uint8_t>(output::semantic_kitti_class(from.labels[i])),
                    point.ring,
                    0};
  }
}

}  // namespace

LiveFrames::LiveFrames(const std::vector<std::string>& words, bool sectors)
    : gives_sectors_(sectors) {
  const Status opened = without_the_lock([&] { return open(words); });
  if (!opened) raise(opened.error());
  begun_ = std::chrono::steady_clock::now();
  thread_ = std::thread([this] {
    run_->run(
        [this] {
          keep_figures();
          return is_over();
        },
        [this](const Frame& frame) {
          if (!gives_sectors_) keep(frame);
        });
    keep_figures();
    const std::lock_guard lock(mutex_);
    ended_ = true;
    changed_.notify_all();
  });
}

LiveFrames::~LiveFrames() {
  stop();
}

Status LiveFrames::open(const std::vector<std::string>& words) {
  const auto arguments = cli::parse_arguments(words);
  if (!arguments) return tl::unexpected(arguments.error());
  duration_s_ = arguments->options.capture.duration_s;
  auto config = config_of(arguments->options);
  if (!config) return tl::unexpected(config.error());
  gives_objects_ = config->objects;
  gives_free_way_ = config->free_way;
  if (gives_sectors_) config->on_sector = [this](const Sector& sector) { keep(sector); };
  auto run = LiveRun::open(*config, is_interrupted);
  if (!run) return tl::unexpected(run.error());
  run_ = *std::move(run);
  return {};
}

bool LiveFrames::is_over() const {
  return stop_ || (duration_s_ && std::chrono::steady_clock::now() - begun_ >=
                                      std::chrono::duration<double>(*duration_s_));
}

template <class Labelled>
std::shared_ptr<FrameData> LiveFrames::copied(const Labelled& from, std::uint32_t number) {
  std::shared_ptr<FrameData> data = buffers_.take();
  data->record.reset();
  data->info = {};
  data->info.number = number;
  data->info.first_packet_ns = from.first_packet_ns;
  data->info.last_packet_ns = from.last_packet_ns;
  data->info.returns = static_cast<std::uint32_t>(from.points.size());
  data->first_return = 0;
  data->objects.reset();
  data->free_way.reset();
  copy_points(from, *data);
  return data;
}

void LiveFrames::keep(const Frame& frame) {
  std::shared_ptr<FrameData> data = copied(frame, frame.number);
  data->info.complete = frame.complete;
  if (frame.deskewed) data->info.deskew.state = frame::DeskewState::kDone;
  for (std::size_t i = 0; i < frame.points.size(); ++i) data->points[i].time_s = frame.time_s[i];
  if (gives_objects_) data->set_objects(frame.objects, frame.object_of_return);
  if (gives_free_way_) data->free_way.emplace(frame.free_way.begin(), frame.free_way.end());
  keep(std::move(data));
}

void LiveFrames::keep(const Sector& sector) {
  std::shared_ptr<FrameData> data = copied(sector, sector.frame);
  data->first_return = static_cast<std::uint32_t>(sector.first_return);
  if (gives_objects_) {
    data->complete_objects.emplace(sector.objects.begin(), sector.objects.end());
  }
  keep(std::move(data));
}

void LiveFrames::keep(std::shared_ptr<FrameData> data) {
  const std::lock_guard lock(mutex_);
  if (waiting_.size() == (gives_sectors_ ? kMostSectors : kMostFrames)) {
    waiting_.pop_front();
    ++left_out_;
  }
  waiting_.push_back(std::move(data));
  changed_.notify_all();
}

void LiveFrames::keep_figures() {
  const LiveRun::Figures figures = run_->figures();
  const std::lock_guard lock(mutex_);
  figures_ = figures;
  refusals_ = run_->refusals();
}

std::shared_ptr<FrameData> LiveFrames::next() {
  return without_the_lock([&]() -> std::shared_ptr<FrameData> {
    std::unique_lock lock(mutex_);
    while (waiting_.empty() && !ended_) {
      changed_.wait_for(lock, std::chrono::milliseconds(100));
      lock.unlock();
      if (is_interrupted()) return nullptr;
      lock.lock();
    }
    if (waiting_.empty()) return nullptr;
    std::shared_ptr<FrameData> next = std::move(waiting_.front());
    waiting_.pop_front();
    return next;
  });
}

void LiveFrames::stop() {
  const py::gil_scoped_release released;
  stop_ = true;
  if (thread_.joinable()) thread_.join();
}

py::dict LiveFrames::figures() {
  const std::lock_guard lock(mutex_);
  py::dict figures;
  figures["datagrams"] = figures_.datagrams;
  figures["decoded"] = figures_.decoded;
  figures["frames"] = figures_.frames;
  figures["frames_left_out"] = figures_.frames_left_out + (gives_sectors_ ? 0 : left_out_);
  if (gives_sectors_) {
    figures["sectors"] = figures_.sectors;
    figures["sectors_left_out"] = figures_.sectors_left_out + left_out_;
  }
  figures["deadlines_missed"] = figures_.deadlines_missed;
  return figures;
}

std::string LiveFrames::refusals() {
  const std::lock_guard lock(mutex_);
  return refusals_;
}

void bind_live(py::module_& module) {
  py::class_<LiveFrames>(module, "Live", "The labelled frames of a live sensor, as they come.")
      .def(py::init<const std::vector<std::string>&, bool>())
      .def("__iter__", [](const py::object& self) { return self; })
      .def("__next__",
           [](LiveFrames& frames) {
             std::shared_ptr<FrameData> frame = frames.next();
             if (!frame) throw py::stop_iteration();
             return frame;
           })
      .def("__enter__", [](const py::object& self) { return self; })
      .def("__exit__", [](LiveFrames& frames, const py::args&) { frames.stop(); })
      .def("stop", &LiveFrames::stop)
      .def("figures", &LiveFrames::figures)
      .def_property_readonly("refusals", &LiveFrames::refusals);
}

}  // namespace terracut::python
