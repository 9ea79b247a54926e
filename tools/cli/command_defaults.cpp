// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "command_defaults.hpp"

#include <memory>
#include <string>

namespace terracut::cli {
namespace {

/// The model for commands that cannot find one out.
void take_model(const Configuration& configuration, std::string& sensor) {
  const std::string& model = configuration.live.capture.sensor;
  if (model != "auto") sensor = model;
}

MethodOptions method_of(const Configuration& configuration) {
  MethodOptions method = configuration.live.method;
  method.settings.clear();
  return method;
}

}  // namespace

void start_from(const Configuration& configuration, ReplayOptions& options) {
  options.capture = configuration.live.capture;
  options.mount = configuration.live.mount;
  options.method = method_of(configuration);
  options.motion = configuration.live.motion;
  options.output = configuration.output;
  options.rate = configuration.replay.rate;
  options.loops = configuration.replay.loops;
}

void start_from(const Configuration& configuration, SegmentOptions& options) {
  options.mount = configuration.live.mount;
  options.method = method_of(configuration);
  options.output = configuration.output;
  options.output.truth.clear();
}

void start_from(const Configuration& configuration, SimulateOptions& options) {
  options = configuration.simulate;
  take_model(configuration, options.sensor);
  options.calibration = configuration.live.capture.calibration;
  options.mount = configuration.live.mount;
}

void start_from(const Configuration& configuration, EncodeOptions& options) {
  take_model(configuration, options.sensor);
  options.calibration = configuration.live.capture.calibration;
}

void start_from(const Configuration& configuration, CalibrateOptions& options) {
  options.capture = configuration.live.capture;
  options.mount = configuration.live.mount;
  options.method = method_of(configuration);
}

void start_from(const Configuration& configuration, PlanOptions& options) {
  take_model(configuration, options.sensor);
  options.method = method_of(configuration);
}

void start_from(const Configuration& configuration, BenchOptions& options) {
  options.capture = configuration.live.capture;
  options.mount = configuration.live.mount;
  options.method = method_of(configuration);
  options.repeat = configuration.bench.repeat;
  options.core = configuration.bench.core;
}

void start_from(const Configuration& configuration, EvalOptions& options) {
  options.mount = configuration.live.mount;
  options.methods = {configuration.live.method.profile};
}

void start_from(const Configuration& configuration, LiveOptions& options) {
  options = configuration.live;
  options.labels = configuration.output.labels;
  options.json = configuration.output.json;
  options.method = method_of(configuration);
}

void start_from(const Configuration& configuration, ConfigOptions& options) {
  options.configuration = std::make_shared<const Configuration>(configuration);
}

void start_from(const Configuration& configuration, DoctorOptions& options) {
  const std::string& listen = configuration.live.listen.address;
  options.interface = configuration.live.listen.interface;
  options.port = static_cast<std::uint16_t>(std::stoi(listen.substr(listen.rfind(':') + 1)));
  options.receive_core = configuration.live.realtime.receive_core;
  options.segment_core = configuration.live.realtime.segment_core;
}

}  // namespace terracut::cli
