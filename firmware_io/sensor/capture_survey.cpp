// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/sensor/capture_survey.hpp"

#include <algorithm>
#include <memory>
#include <tuple>

#include "firmware_io/packet/sensor_recognition.hpp"
#include "firmware_io/sensor/head_reader.hpp"
#include "firmware_io/sensor/unknown_packets.hpp"

namespace terracut::sensor {
namespace {

/// In each stream, this many different payload sizes are counted one by one; further sizes count as
/// size 0.
constexpr std::size_t kMostSizes = 64;

using StreamKey =
    std::tuple<std::uint32_t, std::uint32_t, std::uint16_t, std::uint16_t, std::uint32_t>;

/// Gathers the facts of a model whose data packets tell nothing but the head's azimuths and the
/// clock.
class HeadSurvey {
 public:
  void add(SensorModel model, const packet::Datagram& datagram) {
    packet::PacketAzimuths azimuths;
    auto reject = reader_.read(model, datagram, azimuths);
    if (!reject && azimuths.behind_sector > 0 && !stream_.blind().is_inside(azimuths)) {
      reject = frame::Reject::kAzimuthJump;
    }
    if (reject && azimuths.columns == 0) return;  // the block ids contradict the model
    if (reject == frame::Reject::kAzimuthOutOfRange) {
      stream_.add_out_of_range();
    } else {
      stream_.add(azimuths, !reject);
    }
  }
  [[nodiscard]] StreamFacts facts() const { return stream_.facts(); }

 private:
  HeadReader reader_;
  StreamSurvey stream_{hdl64e::kDeviceHour_us};
};

struct StreamUnderSurvey {
  UdpStream stream;
  std::map<SensorModel, std::uint64_t> votes;
  std::map<SensorModel, std::string> hints;
  // Surveys are some kilobytes each, so they are made on demand.
  std::unique_ptr<Hdl64eSurvey> hdl64e;
  std::unique_ptr<Ruby128Survey> ruby128;
  std::unique_ptr<DeviceReader> device;
  std::map<SensorModel, HeadSurvey> heads;

  void add(const packet::Datagram& datagram) {
    const bool first = stream.packets == 0;
    stream.first_stamp_ns =
        first ? datagram.stamp_ns : std::min(stream.first_stamp_ns, datagram.stamp_ns);
    stream.last_stamp_ns =
        first ? datagram.stamp_ns : std::max(stream.last_stamp_ns, datagram.stamp_ns);
    ++stream.packets;
    stream.payload_bytes += datagram.payload.size();
    const bool tell_size = stream.payload_sizes.size() < kMostSizes ||
                           stream.payload_sizes.contains(datagram.payload.size());
    ++stream.payload_sizes[tell_size ? datagram.payload.size() : 0];

    const SensorModel model = recognise_sensor(datagram.payload);
    if (++votes[model] == 1) {
      hints[model] = model == SensorModel::kUnknown ? sensor::guess_of_unknown(datagram)
                                                    : describe_sensor_hints(datagram.payload);
    }
    if (model == SensorModel::kHdl64e) {
      if (!hdl64e) hdl64e = std::make_unique<Hdl64eSurvey>();
      hdl64e->add(datagram.payload);
    } else if (model == SensorModel::kRuby128) {
      if (!ruby128) ruby128 = std::make_unique<Ruby128Survey>();
      ruby128->add(datagram.payload, datagram.stamp_ns);
    } else if (model == SensorModel::kRoboSenseDeviceInfo) {
      if (!device) device = std::make_unique<DeviceReader>();
      device->add(datagram.payload);
    } else if (is_decoded(model)) {
      heads[model].add(model, datagram);
    }
  }

  [[nodiscard]] UdpStream finished() {
    // A recognised model wins over any number of unknown packets.
    std::uint64_t most = 0;
    for (const auto& [model, count] : votes) {
      if (model == SensorModel::kUnknown || count <= most) continue;
      most = count;
      stream.sensor = model;
    }
    stream.sensor_hints = hints[stream.sensor];
    if (hdl64e) stream.hdl64e = hdl64e->facts();
    if (ruby128) stream.ruby128 = ruby128->facts();
    if (device) stream.device = *device;
    if (heads.contains(stream.sensor)) stream.head = heads.at(stream.sensor).facts();
    return std::move(stream);
  }
};

}  // namespace

double UdpStream::rate_hz() const noexcept {
  const std::int64_t span_ns = last_stamp_ns - first_stamp_ns;
  if (packets < 2 || span_ns <= 0) return 0;
  return static_cast<double>(packets - 1) * 1e9 / static_cast<double>(span_ns);
}

CaptureSurvey survey_capture(capture::CaptureSource& source,
                             const std::function<bool()>& stop_wanted) {
  CaptureSurvey survey;
  survey.name = source.name();
  survey.link_type = source.link_type();
  survey.link_type_name = source.link_name();

  std::map<StreamKey, StreamUnderSurvey> streams;
  while (!stop_wanted || !stop_wanted()) {
    const auto next = source.next();
    if (!next) {
      survey.broke_off = next.error();
      break;
    }
    if (!*next) break;
    const packet::Datagram& datagram = **next;
    const StreamKey key{datagram.source_address, datagram.destination_address, datagram.source_port,
                        datagram.destination_port, datagram.vlan};
    if (streams.size() >= CaptureSurvey::kMostStreams && !streams.contains(key)) {
      ++survey.packets_of_further_streams;
      continue;
    }
    StreamUnderSurvey& entry = streams[key];
    std::tie(entry.stream.source_address, entry.stream.destination_address,
             entry.stream.source_port, entry.stream.destination_port, entry.stream.vlan) = key;
    entry.add(datagram);
  }
  survey.counters = source.counters();
  for (auto& [key, entry] : streams) survey.streams.push_back(entry.finished());
  const auto by_size_then_key = [](const UdpStream& a, const UdpStream& b) {
    const auto key = [](const UdpStream& stream) {
      return std::tuple(~stream.packets, stream.source_address, stream.destination_address,
                        stream.source_port, stream.destination_port, stream.vlan);
    };
    return key(a) < key(b);
  };
  std::sort(survey.streams.begin(), survey.streams.end(), by_size_then_key);
  return survey;
}

}  // namespace terracut::sensor
