// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "open_capture.hpp"

#include <fmt/format.h>

#include <limits>
#include <utility>

#include "calib/ouster/ouster_metadata.hpp"
#include "firmware_io/bag/bag.hpp"
#include "firmware_io/bag/topic_choice.hpp"
#include "firmware_io/net/ipv4_endpoint.hpp"
#include "firmware_io/sensor/unit_calibration.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/settings/companion_files.hpp"
#include "tools/cli/settings/sensor_choice.hpp"
#include "tools/cli/settings/stream_choice.hpp"
#include "tools/cli/stop_signal.hpp"

namespace terracut::cli {
namespace {

using capture::CaptureSource;

std::int64_t nanoseconds(double seconds) {
  return static_cast<std::int64_t>(seconds * 1e9);
}

std::string describe(const SensorChoice& sensor) {
  std::string text(to_string(sensor.model));
  if (sensor.spin_hz > 0) text += fmt::format(", {:.1f} Hz", sensor.spin_hz);
  return text + fmt::format(", {} return, {} columns", sensor.dual_return ? "dual" : "single",
                            sensor.columns);
}

std::string describe(const calib::SensorCalibration& calibration) {
  std::string text = fmt::format("{}, fingerprint {:016x}", calib::origin_of(calibration),
                                 calib::fingerprint(calibration));
  const auto* ruby128 = std::get_if<ruby128::Ruby128Calibration>(&calibration);
  if (ruby128 != nullptr && ruby128->nominal)
    text += "; WARNING: not this unit's, heights may be off";
  return text;
}

/// Opens the datagrams of one unit only: those of another would get into the same frames.
Expected<CaptureSource> open_unit(const CaptureOptions& options,
                                  const streams::SensorStream& unit) {
  capture::CaptureFilter its_own = filter_of(options);
  its_own.source_address = unit.source_address;
  its_own.is_of_stream = [unit](const packet::Datagram& datagram) {
    return unit.may_hold(datagram);
  };
  return CaptureSource::open(options.file, std::move(its_own));
}

/// Returns what a bag says of the sensor's mount.
BagPose pose_of_bag(const CaptureOptions& options) {
  if (!bag::is_bag(options.file)) return {};
  auto bag = bag::Bag::open(options.file);
  if (!bag) return {};
  const auto topic = bag::choose_topic(*bag, options.topic, bag::Content::kPackets);
  return topic ? pose_in(*bag, *topic) : BagPose{};
}

/// Calls sensor::unit_calibration(). If the packets hold no calibration, uses a file beside the
/// capture.
Expected<calib::SensorCalibration> calibration_of(const CaptureOptions& options,
                                                  sensor::SensorModel model, CaptureSource& unit) {
  sensor::CalibrationChoice choice{.file = options.calibration};
  // A Hesai's packets hold no table, so its nominal one must not come before the unit's.
  const bool is_of_hesai = sensor::is_hesai(model);
  Expected<calib::SensorCalibration> told = fail(ErrorCode::kNoCalibration, "");
  if (!is_of_hesai || choice.is_given()) told = sensor::unit_calibration(choice, model, unit);
  if (told || choice.is_given() || told.error().code != ErrorCode::kNoCalibration) return told;
  const bool is_of_ouster = sensor::is_ouster(model);
  const auto beside =
      is_of_ouster ? metadata_beside(options.file) : calibration_beside(options.file);
  if (!beside) return tl::unexpected(beside.error());
  const bool is_of_robosense = sensor::is_robosense(model);
  const bool is_csv = beside->extension() == ".csv";
  if (!beside->empty() && is_csv == (is_of_robosense || is_of_hesai) &&
      ouster::is_metadata_name(*beside) == is_of_ouster) {
    choice.file = *beside;
    say(fmt::format("the packets hold no calibration; {} beside the capture is taken",
                    beside->string()));
  }
  choice.allows_nominal = options.nominal_calibration;
  if (choice.is_given() || choice.allows_nominal || is_of_hesai) {
    return sensor::unit_calibration(choice, model, unit);
  }
  told.error().message +=
      fmt::format("; or put it beside the capture as {}.calibration.{}", stem_of(options.file),
                  is_of_ouster      ? "json"
                  : is_of_robosense ? "csv"
                                    : "xml");
  return told;
}

/// Chooses the sensor; where neither it nor a table is named, by an Ouster's metadata beside the
/// capture, if there is any: some of its packets may be of several models.
Expected<SensorChoice> choose_sensor_of(const CaptureOptions& options, CaptureSource& source) {
  if (!options.sensor && options.calibration.empty()) {
    CaptureOptions named = options;
    if (const auto beside = metadata_beside(options.file)) named.calibration = *beside;
    if (named_model(named)) {
      auto chosen = choose_sensor(named, source);
      if (chosen) return chosen;
      if (Status again = source.rewind(); !again) return tl::unexpected(again.error());
    }
  }
  return choose_sensor(options, source);
}

}  // namespace

Expected<OpenCapture> open_capture(const CaptureOptions& options) {
  auto source = CaptureSource::open(options.file, filter_of(options));
  if (!source) return tl::unexpected(source.error());
  auto sensor = choose_sensor_of(options, *source);
  if (!sensor) return tl::unexpected(sensor.error());
  warn_of_unused(options, sensor->model);
  auto unit = open_unit(options, sensor->stream);
  if (!unit) return tl::unexpected(unit.error());
  auto calibration = calibration_of(options, sensor->model, *unit);
  if (!calibration) return tl::unexpected(calibration.error());
  if (const auto rotation = calib::rotation_of(*calibration)) {
    sensor->columns = options.columns.value_or(rotation->columns);
    sensor->spin_hz = rotation->spin_hz;
  }
  // Opens the capture again, so that no packet is counted twice.
  unit = open_unit(options, sensor->stream);
  if (!unit) return tl::unexpected(unit.error());
  std::string sensor_line = describe(*sensor), calibration_line = describe(*calibration);
  return OpenCapture{*std::move(unit),
                     *sensor,
                     *std::move(calibration),
                     std::move(sensor_line),
                     std::move(calibration_line),
                     pose_of_bag(options)};
}

void say_what_is_read(const OpenCapture& capture) {
  say("sensor: " + capture.sensor_line);
  say("calibration: " + capture.calibration_line);
}

Expected<CaptureSource> open_again(const OpenCapture& capture, const CaptureOptions& options) {
  return open_unit(options, capture.sensor.stream);
}

void warn_of_other_senders(const OpenCapture& capture, const capture::CaptureCounters& pass,
                           const CaptureOptions& options) {
  const std::string unit = net::ipv4_text(capture.sensor.stream.source_address);
  if (const std::uint64_t others = pass.other_source; others > 0 && options.from.empty()) {
    warn(
        fmt::format("{} datagrams came from other addresses than {}, the sensor's, and were left "
                    "out; `terracut info` lists who sends, --from chooses",
                    others, unit));
  }
  // Some options leave out datagrams on purpose.
  const bool is_asked_for = options.from.find(':') != std::string::npos || !options.to.empty() ||
                            !options.vlan.empty() || !options.mac.empty();
  if (const std::uint64_t others = pass.other_stream; others > 0 && !is_asked_for) {
    const streams::Destination& to = capture.sensor.stream.destinations.front();
    warn(
        fmt::format("{} data packets of {} are not of the sensor that sends to {}:{}, and were "
                    "left out; `terracut info` lists the streams, --port, --to, --vlan and --mac "
                    "choose",
                    others, unit, net::ipv4_text(to.address), to.port));
  }
}

CapturePart::CapturePart(CaptureSource& source, const CaptureOptions& options)
    : source_(source),
      start_ns_(nanoseconds(options.start_s)),
      end_ns_(options.duration_s ? start_ns_ + nanoseconds(*options.duration_s)
                                 : std::numeric_limits<std::int64_t>::max()) {}

const packet::Datagram* CapturePart::next() {
  while (past_end_ < kSurelyPast_packets && !(stopped_ = stop_wanted())) {
    auto read = source_.next();
    if (!read) {
      fault_ = read.error().message;
      return nullptr;
    }
    datagram_ = *read;
    if (!datagram_) return nullptr;
    if (is_inside(clock_.add(datagram_->stamp_ns))) return &*datagram_;
  }
  return nullptr;
}

bool CapturePart::is_inside(std::int64_t since_begin_ns) noexcept {
  has_begun_ = has_begun_ || start_ns_ == 0 || since_begin_ns >= start_ns_;
  const bool is_past = since_begin_ns >= end_ns_;
  past_end_ = is_past ? past_end_ + 1 : 0;
  if (is_past) {
    ++behind_end_;
  } else if (!has_begun_) {
    ++before_start_;
  }
  return has_begun_ && !is_past;
}

void CapturePart::warn_of_oddities() const {
  if (!fault_.empty()) warn(fault_);
  if (const std::uint64_t steps = clock_.steps_back(); steps > 0) {
    warn(
        fmt::format("{}: the stamps step back {} time{}, by {:.3f} s at most: the recording "
                    "machine's clock was set, or captures were joined in another order. Every "
                    "packet is used, in the order of the file",
                    source_.name(), steps, steps == 1 ? "" : "s",
                    static_cast<double>(clock_.longest_step_back_ns()) * 1e-9));
  }
}

Error nothing_came_out(const CaptureSource& source, const CapturePart& part, std::uint64_t offered,
                       const decode::Decoder& decoder) {
  const frame::LossCounters losses = decoder.losses();
  const bool had_none =
      decoder.frames() == 0 && losses.overflow_full_returns + losses.late_returns == 0;
  const std::uint64_t empty = had_none ? decoder.packets_decoded() : 0;
  std::string why = why_nothing_came(source.counters(), offered, empty, losses);
  if (!part.fault().empty()) why += "; " + part.fault();
  return {ErrorCode::kNothingCameOut, fmt::format("{}: no frame came out: {}", source.name(), why)};
}

}  // namespace terracut::cli
