// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/decode/decoder.hpp"

#include <algorithm>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

namespace terracut::decode {

namespace {

/// Calls `use` with the type of the model's trait, the unit's table and the trait's settings.
template <class Use>
auto with_trait(const calib::SensorCalibration& calibration, const Decoder::Config& config,
                const Use& use) {
  if (const auto* unit = std::get_if<hdl64e::Hdl64eCalibration>(&calibration)) {
    return use(std::type_identity<hdl64e::Hdl64eSensor>{}, *unit, config.hdl64e);
  }
  if (const auto* unit = std::get_if<ruby128::Ruby128Calibration>(&calibration)) {
    return use(std::type_identity<ruby128::Ruby128Sensor>{}, *unit, config.ruby128);
  }
  if (const auto* unit = std::get_if<ouster::OusterCalibration>(&calibration)) {
    if (!validate(*unit)) throw std::invalid_argument("Decoder: no plausible table of an Ouster");
    return ouster::Models::with(unit->format.rows, [&](auto rows) {
      return use(std::type_identity<ouster::OusterSensor<rows()>>{}, *unit, config.ouster);
    });
  }
  const auto& table = std::get<beams::BeamTable>(calibration);
  if (table.lasers.empty() || !validate(table)) {
    throw std::invalid_argument("Decoder: the table has other lasers than the sensor");
  }
  if (hesai::Models::has(table.model)) {
    return hesai::Models::with(table.model, [&]<class Model>(std::type_identity<Model>) {
      return use(std::type_identity<hesai::HesaiSensor<Model>>{}, table, config.hesai);
    });
  }
  if (robosense::Models::has(table.model)) {
    return robosense::Models::with(table.model, [&]<class Model>(std::type_identity<Model>) {
      return use(std::type_identity<robosense::RoboSenseSensor<Model>>{}, table, config.ruby128);
    });
  }
  return velodyne::Models::with(table.model, [&]<class Model>(std::type_identity<Model>) {
    return use(std::type_identity<velodyne::VelodyneSensor<Model>>{}, table, config.velodyne);
  });
}

}  // namespace

Decoder::Model Decoder::model_of(const calib::SensorCalibration& calibration,
                                 const Config& config) {
  const auto or_default = [](int given, int usual) { return given != 0 ? given : usual; };
  const auto rotation = calib::rotation_of(calibration);
  const auto model = [&]<class Sensor>(std::type_identity<Sensor>, const auto&,
                                       const auto&) -> Model {
    return {.rows = Sensor::kRows,
            .lasers = static_cast<std::size_t>(Sensor::kChannels),
            .columns =
                or_default(config.columns, rotation ? rotation->columns : Sensor::kDefaultColumns),
            .returns_per_cell = or_default(config.returns_per_cell, Sensor::kDefaultReturnsPerCell),
            .packet_bytes = Sensor::kPacketBytes,
            .clock_wrap_us = Sensor::kClockWrap_us,
            .has_fine = kHasFineDistancesOf<Sensor>};
  };
  const Model found = with_trait(calibration, config, model);
  if (found.columns < 16 || found.columns > beams::kRevolution_cdeg) {
    throw std::invalid_argument("Decoder: columns per frame must be in [16, 36000]");
  }
  return found;
}

Decoder::SensorReturns Decoder::sensor_of(const calib::SensorCalibration& calibration,
                                          const mount::Mount& mount, const Config& config,
                                          int columns, memory::FixedMemory& memory) {
  return with_trait(calibration, config,
                    [&]<class Sensor>(std::type_identity<Sensor>, const auto& unit,
                                      const auto& settings) -> SensorReturns {
                      return PacketReturns<Sensor>(unit, mount, settings, columns, memory);
                    });
}

FrameBuilder::Config Decoder::frame_config(const Model& model) {
  // Beams point up to 10 degrees before and behind the head, so tiles around the seam (azimuth 0)
  // are kept in both frames. Tiles are also cut short where a frame ends or the return mode
  // changes.
  constexpr std::size_t kAroundSeam = 16, kCutTiles = 8;
  const auto firings = static_cast<std::size_t>(model.returns_per_cell * model.columns);
  return {.shape = {model.rows, model.columns},
          .lasers = model.lasers,
          .tiles = (firings + firings / kAroundSeam) / frame::kTileFirings + kCutTiles,
          .revolution_ticks = packet::kRevolution_ticks,
          .has_fine = model.has_fine};
}

std::unique_ptr<frame::TileReader> Decoder::make_reader(memory::FixedMemory& memory) const {
  return std::visit([&](const auto& returns) { return returns.make_reader(memory); }, sensor_);
}

Decoder::Decoder(const calib::SensorCalibration& calibration, const mount::Mount& mount,
                 const Config& config, memory::FixedMemory& memory)
    : Decoder(model_of(calibration, config), calibration, mount, config, memory) {}

Decoder::Decoder(const Model& model, const calib::SensorCalibration& calibration,
                 const mount::Mount& mount, const Config& config, memory::FixedMemory& memory)
    : reorder_packets_(config.reorder_packets),
      dual_owner_(config.dual_owner),
      sensor_(sensor_of(calibration, mount, config, model.columns, memory)),
      tracker_(model.clock_wrap_us, memory),
      frames_(frame_config(model), memory),
      clock_(model.clock_wrap_us),
      in_doubt_(model.packet_bytes, memory) {
  if (const auto rotation = calib::rotation_of(calibration)) {
    const auto ticks = [&](int column) {
      return std::int64_t{packet::kRevolution_ticks} * column / rotation->columns;
    };
    blind_.tell({ticks(rotation->blind_from), ticks(rotation->blind_to)});
    frames_.set_blind(blind_.sector());
  }
  std::vector<std::int32_t> beam_ticks(static_cast<std::size_t>(model.rows));
  with_sensor([&](auto& sensor) noexcept {
    const auto rows = sensor.trait().rows();
    for (std::size_t i = 0; i < rows.size(); ++i) {
      beam_ticks[static_cast<std::size_t>(rows[i])] =
          sensor.trait().beam_ticks(static_cast<int>(i));
    }
  });
  beam_turns_ = memory.take<float>("beams off the head", beam_ticks.size());
  std::ranges::transform(beam_ticks, beam_turns_.begin(), [](std::int32_t ticks) {
    return static_cast<float>(ticks) / static_cast<float>(packet::kRevolution_ticks);
  });
  if (config.motion == nullptr) return;
  deskewer_.emplace(Deskewer::Config{config.motion, config.deskew_at, frames_.shape(),
                                     packet::kRevolution_ticks, FrameBuilder::kBuffers},
                    beam_ticks, memory);
}

void Decoder::push(const packet::Datagram& datagram) noexcept {
  rejected_.reset();
  auto reason =
      with_sensor([&](auto& sensor) noexcept { return sensor.trait().check(datagram, azimuths_); });
  if (!reason && azimuths_.behind_sector > 0 && !blind_.is_inside(azimuths_)) {
    reason = frame::Reject::kAzimuthJump;
  }
  if (reason) {
    if (*reason == frame::Reject::kStationary) {
      tracker_.note_stationary(azimuths_.device_stamp_us, azimuths_.first_cdeg(), frames_.losses());
    } else if (*reason == frame::Reject::kAzimuthOutOfRange ||
               *reason == frame::Reject::kAzimuthMismatch ||
               *reason == frame::Reject::kAzimuthJump) {
      tracker_.note_rejected(azimuths_.device_stamp_us);
    } else if (*reason == frame::Reject::kDeviceInfo) {
      rejected_ = reason;  // a packet with this reason carries no returns that could be lost
      return;
    }
    return reject(*reason);
  }
  const std::int64_t began_ns = host_began_ns(datagram.stamp_ns);
  const Placement placed =
      tracker_.place(azimuths_, began_ns, next_packet_cdeg(), frames_.losses());
  if (placed.arrival == Arrival::kRejected) return reject(placed.reject);
  if (placed.arrival == Arrival::kDoubtful || placed.arrival == Arrival::kNewStream) {
    if (placed.is_first_in_doubt) in_doubt_.drop(frames_.losses());
    in_doubt_.keep(datagram, azimuths_, placed);
    if (placed.arrival == Arrival::kNewStream) begin_anew(Step::kNothing);
    return;
  }
  in_doubt_.drop(frames_.losses());
  after_packet_ = Step::kNothing;
  take(datagram.payload, datagram.stamp_ns, placed);
}

void Decoder::end_stream() noexcept {
  begin_anew(Step::kEnd);
}

frame::Frame* Decoder::next() noexcept {
  frame::Frame* frame = frames_.next();
  while (frame == nullptr && go_on()) frame = frames_.next();
  if (frame == nullptr) return nullptr;
  frame->info.blind = blind();
  if (!deskewer_) return frame;
  // Motions are kept as long as the returns: there is a place for those of each buffer.
  const Deskewer::Deskewed deskewed =
      deskewer_->deskew(frames_.oldest(), frames_.number_of(*frame->returns));
  frame->info.deskew = deskewed.info;
  frame->motions = deskewed.by_row;
  return frame;
}

bool Decoder::go_on() noexcept {
  switch (step_) {
    case Step::kNothing:
      return false;
    case Step::kTakeKept:
      take_kept();
      break;
    case Step::kRestart:
      restart();
      break;
    case Step::kPlace:
      place();
      break;
    case Step::kEnd:
      end();
      break;
  }
  return true;
}

void Decoder::begin_anew(Step then) noexcept {
  anew_ = {.has_begun = false, .then = then};
  step_ = after_packet_ = Step::kTakeKept;
}

void Decoder::take_kept() noexcept {
  const PacketsInDoubt::Packet* packet = in_doubt_.take();
  if (packet == nullptr) {
    step_ = after_packet_ = anew_.then;
    return;
  }
  rejected_.reset();
  if (in_doubt_.is_too_old(*packet)) return reject(packet->reason);
  azimuths_ = packet->azimuths;
  const std::int64_t began_ns = host_began_ns(packet->stamp_ns);
  const Placement placed =
      std::exchange(anew_.has_begun, true)
          ? tracker_.go_on(azimuths_, began_ns, next_packet_cdeg(), frames_.losses())
          : tracker_.begin(azimuths_, began_ns, frames_.losses());
  if (placed.arrival == Arrival::kRejected) return reject(placed.reject);
  take(packet->payload, packet->stamp_ns, placed);
}

void Decoder::take(std::span<const std::uint8_t> payload, std::int64_t stamp_ns,
                   const Placement& placed) noexcept {
  const packet::BeamSpread spread = with_sensor(
      [&](auto& sensor) noexcept { return sensor.trait().spread(azimuths_.step_ticks); });
  const std::int64_t begin_ticks = placed.rotor_cdeg * packet::kTicksPerCdeg;
  std::int64_t most_ticks = begin_ticks;
  for (int column = 1; column < azimuths_.columns; ++column) {
    most_ticks =
        std::max(most_ticks, begin_ticks + azimuths_.advance_cdeg(column) * packet::kTicksPerCdeg);
  }
  const std::int64_t last_frame = frame_of(most_ticks + spread.foremost_ticks);
  const int late_columns = columns_too_late(placed, spread, last_frame);
  const std::int64_t first_ticks =
      begin_ticks + azimuths_.advance_cdeg(late_columns) * packet::kTicksPerCdeg;
  std::int64_t least_ticks = first_ticks;
  for (int column = late_columns + 1; column < azimuths_.columns; ++column) {
    least_ticks =
        std::min(least_ticks, begin_ticks + azimuths_.advance_cdeg(column) * packet::kTicksPerCdeg);
  }
  job_ = {.payload = payload,
          .stamp_ns = stamp_ns,
          .placed = placed,
          .spread = spread,
          .swept = {first_ticks, begin_ticks + azimuths_.sweep_ticks},
          .late_columns = late_columns,
          .first_frame = frame_of(least_ticks + spread.hindmost_ticks),
          .last_frame = last_frame,
          .stride = {azimuths_.pace_ticks, azimuths_.widest_ticks},
          .step_ticks = 0};
  if (placed.arrival != Arrival::kRestart) return judge();
  blind_.end();
  count_due();
  tracker_.miss(seen_share(placed.missing), frames_.losses());
  place_rest();
  frames_.flush();
  step_ = Step::kRestart;
}

void Decoder::restart() noexcept {
  if (deskewer_) {
    deskewer_->restart();
    clock_.reset();
  }
  frames_.start(job_.first_frame, job_.swept.from_ticks);
  complete_ticks_ = placed_ticks_ = job_.first_frame * packet::kRevolution_ticks;
  frontier_ticks_ = crossed_ticks_ = job_.swept.from_ticks;
  steps_ticks_ = steps_ = 0;
  judge();
}

void Decoder::judge() noexcept {
  step_ = after_packet_;
  const Arrival arrival = job_.placed.arrival;
  const packet::RotorInterval& swept = job_.swept;
  const bool is_next = arrival == Arrival::kNext;
  if (job_.first_frame < frames_.oldest()) {
    if (is_next) {
      tracker_.miss(missing_before(job_.placed, swept), frames_.losses());
      blind_.pass(swept);
    }
    return reject(frame::Reject::kLate);
  }

  job_.step_ticks = mean_step(azimuths_.step_ticks);
  if (is_next) {
    judge_gap(job_.placed, swept, job_.stride, job_.spread, job_.step_ticks);
    if (azimuths_.behind_sector > 0 && job_.late_columns == 0) {
      cross_sector(swept, job_.stride, job_.spread, job_.step_ticks);
    } else {
      blind_.pass(swept);
    }
    frames_.set_blind(blind_.sector());
    count_due();
  }
  if (arrival == Arrival::kReordered) {
    frames_.regain(swept, job_.spread);
    blind_.fill(swept);
  }
  frontier_ticks_ = std::max(frontier_ticks_, swept.to_ticks);
  if (arrival != Arrival::kReordered) has_crossed_ = azimuths_.behind_sector > 0;
  if (deskewer_ && arrival != Arrival::kReordered && !has_crossed_) {
    const HostClock::Sent sent = clock_.sent(azimuths_.device_stamp_us, job_.stamp_ns);
    if (sent.anew) deskewer_->begin_anew(swept.from_ticks);
    deskewer_->note(swept.from_ticks, sent.instant_ns - azimuths_.nominal_period_ns);
  }
  end_frames_before(job_.last_frame - 1);
  step_ = Step::kPlace;
}

void Decoder::place() noexcept {
  // The next packet begins here or up to one firing step earlier: azimuths are rounded, and heads
  // rotate unevenly.
  const std::int64_t next_ticks = blind_.next_packet(frontier_ticks_);
  frames_.note_packet({.stamp_ns = job_.stamp_ns,
                       .rotor_ticks = job_.swept.from_ticks,
                       .first_frame = job_.first_frame,
                       .last_frame = job_.last_frame,
                       .frontier_ticks = next_ticks},
                      job_.step_ticks, job_.spread);
  const PacketPlace place{
      .rotor_cdeg = job_.placed.rotor_cdeg,
      .stamp_ns = job_.stamp_ns,
      .late_columns = job_.late_columns,
      .owner = azimuths_.dual_return ? dual_owner_ : frame::CellOwner::kFirstArrived};
  const bool is_placed = with_sensor([&](auto& returns) noexcept {
    // Packets of a Pandar40P never fill a tile, so that some of their returns always wait.
    if (returns.add(job_.payload, azimuths_, place, frames_)) placed_ticks_ = complete_ticks_;
    return returns.is_flushed();
  });
  ++packets_;
  columns_ += static_cast<std::uint64_t>(azimuths_.columns - job_.late_columns);

  const std::int64_t late_packets = reorder_packets_ > 0 ? reorder_packets_ + 1 : 0;
  const std::int64_t behind_ticks =
      late_packets * job_.stride.widest_ticks + job_.step_ticks - job_.spread.hindmost_ticks;
  complete_ticks_ = (late_packets > 0 ? frontier_ticks_ : next_ticks) - behind_ticks;
  if (is_placed) placed_ticks_ = complete_ticks_;
  // Before a blind sector, no packet follows soon whose firings would fill the tile. Packets that
  // come in spite of it cut no further tiles: there is room for few.
  if (next_ticks > std::max(frontier_ticks_, crossed_ticks_)) {
    crossed_ticks_ = next_ticks;
    place_rest();
  }
  end_frames_before(frame_of(complete_ticks_));
  step_ = after_packet_;
}

void Decoder::end_frames_before(std::int64_t frame) noexcept {
  if (frame > frames_.oldest()) place_rest();
  frames_.roll_to(frame);
}

void Decoder::place_rest() noexcept {
  with_sensor([&](auto& returns) noexcept { returns.flush(frames_); });
  placed_ticks_ = complete_ticks_;
}

void Decoder::end() noexcept {
  tracker_.end_of_stream(frames_.losses());
  blind_.end();
  count_due();
  place_rest();
  frames_.flush();
  step_ = Step::kNothing;
}

void Decoder::judge_gap(const Placement& placed, const packet::RotorInterval& swept,
                        const BlindSector::Stride& stride, const packet::BeamSpread& spread,
                        std::int64_t step_ticks) noexcept {
  const packet::RotorInterval gap{frontier_ticks_, swept.from_ticks};
  const std::int64_t missing = missing_before(placed, swept);
  if (gap.ticks() <= step_ticks * 3 / 4) {
    tracker_.miss(missing, frames_.losses());
    return;
  }
  const BlindSector::Verdict verdict = blind_.judge(gap, missing, placed.explained, stride);
  frames_.set_blind(blind_.sector());
  tracker_.miss(verdict.packets, frames_.losses());
  if (verdict.lost.ticks() > 0) {
    frames_.lose(verdict.lost, spread, step_ticks, !verdict.is_pending);
  }
}

void Decoder::cross_sector(const packet::RotorInterval& swept, const BlindSector::Stride& stride,
                           const packet::BeamSpread& spread, std::int64_t step_ticks) noexcept {
  const packet::RotorInterval inside = azimuths_.sector_inside(swept.from_ticks);
  const BlindSector::Verdict verdict = blind_.cross(swept.from_ticks, inside, stride);
  frames_.set_blind(blind_.sector());
  if (verdict.lost.ticks() > 0) {
    frames_.lose(verdict.lost, spread, step_ticks, !verdict.is_pending);
  }
}

}  // namespace terracut::decode
