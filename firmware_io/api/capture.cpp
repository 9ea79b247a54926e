// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <utility>
#include <vector>

#include "calib/api/calibration_table.hpp"
#include "firmware_io/capture/capture_source.hpp"
#include "firmware_io/sensor/unit_calibration.hpp"
#include "firmware_io/sensor/unknown_packets.hpp"
#include "firmware_io/streams/heard_senders.hpp"
#include "terracut/decoder.hpp"

namespace terracut {

struct Capture::Engine {
  capture::CaptureSource source;
  Sensor sensor;
  Expected<Calibration> calibration;
};

Capture::Capture(std::unique_ptr<Engine> engine) noexcept : engine_(std::move(engine)) {}
Capture::Capture(Capture&&) noexcept = default;
Capture& Capture::operator=(Capture&&) noexcept = default;
Capture::~Capture() = default;

namespace {

Expected<streams::SensorStream> sender_in(capture::CaptureSource& source) {
  const streams::HeardCapture heard = streams::hear_beginning(source, std::nullopt);
  const std::vector<streams::SensorStream> found = heard.senders.sensors();
  if (found.empty() && heard.broke_off) return tl::unexpected(*heard.broke_off);
  if (found.empty()) {
    return fail(ErrorCode::kUnsupported,
                source.name() + ": no sensor that can be decoded: " + heard.senders.others() +
                    ". " + std::string(sensor::kWhatInstead));
  }
  if (found.size() > 1) {
    return fail(ErrorCode::kInvalidArgument, source.name() + ": several sensors send");
  }
  return found.front();
}

}  // namespace

Expected<Capture> Capture::open(const std::filesystem::path& file) {
  auto all = capture::CaptureSource::open(file);
  if (!all) return tl::unexpected(all.error());
  const auto sender = sender_in(*all);
  if (!sender) return tl::unexpected(sender.error());
  auto source = capture::CaptureSource::open(
      file, {.port = {},
             .source_address = sender->source_address,
             .is_of_stream = [unit = *sender](const packet::Datagram& datagram) {
               return unit.may_hold(datagram);
             }});
  if (!source) return tl::unexpected(source.error());
  auto unit = sensor::unit_calibration({}, sender->model, *source);
  if (Status status = source->rewind(); !status) return tl::unexpected(status.error());
  const Sensor model = sensor::sensor_of(sender->model);
  return Capture(std::make_unique<Engine>(
      Engine{*std::move(source), model, std::move(unit).map([](calib::SensorCalibration&& found) {
               return calibration_of(std::move(found));
             })}));
}

Sensor Capture::sensor() const noexcept {
  return engine_->sensor;
}

const Expected<Calibration>& Capture::calibration() const noexcept {
  return engine_->calibration;
}

Expected<std::optional<Packet>> Capture::next() {
  auto datagram = engine_->source.next();
  if (!datagram) return tl::unexpected(datagram.error());
  if (!*datagram) return std::nullopt;
  return Packet{.payload = (*datagram)->payload, .stamp_ns = (*datagram)->stamp_ns};
}

}  // namespace terracut
