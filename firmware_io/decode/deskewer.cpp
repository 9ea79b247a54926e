// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/decode/deskewer.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

namespace terracut::decode {
namespace {

Deskewer::Config checked(const Deskewer::Config& config, std::span<const std::int32_t> beam_ticks) {
  if (config.motion == nullptr || config.revolution_ticks < 1 || config.shape.columns < 1 ||
      beam_ticks.size() != static_cast<std::size_t>(config.shape.rows) || beam_ticks.empty()) {
    throw std::invalid_argument("Deskewer needs a motion, an image shape and a beam for each row");
  }
  const auto wide = [&](std::int32_t ticks) {
    return std::abs(ticks) >= config.revolution_ticks / 2;
  };
  if (std::any_of(beam_ticks.begin(), beam_ticks.end(), wide)) {
    throw std::invalid_argument(
        "Deskewer: beams must point less than half a revolution off the head");
  }
  return config;
}

/// Returns by how many whole columns a beam lags behind the head. Rounding costs at most half a
/// column's time.
std::int64_t shift_of(std::int32_t beam_ticks, const Deskewer::Config& config) {
  return std::llround(-static_cast<double>(beam_ticks) * config.shape.columns /
                      static_cast<double>(config.revolution_ticks));
}

frame::PlanarMotion motion_of(const vehicle::PlanarPose& pose) noexcept {
  return {static_cast<float>(pose.cosine), static_cast<float>(pose.sine),
          static_cast<float>(pose.x_m), static_cast<float>(pose.y_m)};
}

}  // namespace

Deskewer::Deskewer(const Config& config, std::span<const std::int32_t> beam_ticks,
                   memory::FixedMemory& memory)
    : config_(checked(config, beam_ticks)), columns_(config.shape.columns) {
  const auto [least, most] = std::minmax_element(beam_ticks.begin(), beam_ticks.end());
  first_shift_ = shift_of(*most, config_);
  last_shift_ = shift_of(*least, config_);
  head_columns_ = static_cast<std::size_t>(columns_ + last_shift_ - first_shift_);
  const std::size_t nodes = head_columns_ / kNodeColumns + 3;

  // The memory holds two open frames, and the azimuths by which beams reach into the next frame.
  instants_ns_ = memory.take<std::int64_t>("deskew", std::bit_ceil(3 * nodes));
  node_ns_ = memory.take<std::int64_t>("deskew", nodes);
  node_poses_ = memory.take<vehicle::PlanarPose>("deskew", nodes);
  for (std::span<float>* plane : {&cosine_, &sine_, &x_m_, &y_m_}) {
    *plane = memory.take<float>("deskew", config.frames * head_columns_);
  }
  by_row_ = memory.take<frame::PlanarMotions>("deskew", config.frames * beam_ticks.size());
  for (std::size_t i = 0; i < by_row_.size(); ++i) {
    const std::size_t place = i / beam_ticks.size(), row = i % beam_ticks.size();
    const auto shift = static_cast<std::size_t>(shift_of(beam_ticks[row], config_) - first_shift_);
    const std::size_t from = place * head_columns_ + shift;
    const auto count = static_cast<std::size_t>(columns_);
    by_row_[i] = {cosine_.subspan(from, count), sine_.subspan(from, count),
                  x_m_.subspan(from, count), y_m_.subspan(from, count)};
  }
}

double Deskewer::nodes(std::int64_t rotor_ticks) const noexcept {
  return static_cast<double>(rotor_ticks) * static_cast<double>(columns_) /
         static_cast<double>(kNodeColumns * config_.revolution_ticks);
}

void Deskewer::restart() noexcept {
  if (noted_) begin_anew(0);
  anew_node_ = kFromTheStart;
}

void Deskewer::begin_anew(std::int64_t rotor_ticks) noexcept {
  noted_ = false;
  anew_node_ = static_cast<std::int64_t>(std::ceil(nodes(rotor_ticks)));
  config_.motion->reset();
}

void Deskewer::note(std::int64_t rotor_ticks, std::int64_t instant_ns) noexcept {
  const Note note{nodes(rotor_ticks), instant_ns};
  if (!noted_) {
    noted_ = true;
    first_node_ = next_node_ = static_cast<std::int64_t>(std::ceil(note.position));
    before_ = newest_ = note;
    return;
  }
  if (note.position <= newest_.position || note.instant_ns < newest_.instant_ns) return;
  // Skips nodes that the newest note would overwrite in the ring buffer.
  const auto last_node = static_cast<std::int64_t>(std::floor(newest_.position));
  next_node_ = std::max(next_node_, last_node + 1 - static_cast<std::int64_t>(instants_ns_.size()));
  fill(last_node);
  before_ = newest_;
  newest_ = note;
}

void Deskewer::fill(std::int64_t last_node) noexcept {
  const double way = newest_.position - before_.position;
  const auto time_ns = static_cast<double>(newest_.instant_ns - before_.instant_ns);
  const double ns_per_node = way > 0 ? time_ns / way : 0;
  for (; next_node_ <= last_node && static_cast<double>(next_node_) <= newest_.position;
       ++next_node_) {
    const double since = static_cast<double>(next_node_) - before_.position;
    instants_ns_[static_cast<std::size_t>(next_node_) & (instants_ns_.size() - 1)] =
        before_.instant_ns + static_cast<std::int64_t>(since * ns_per_node);
  }
  first_node_ = std::max(first_node_, next_node_ - static_cast<std::int64_t>(instants_ns_.size()));
}

std::int64_t Deskewer::instant_of(std::int64_t node) const noexcept {
  if (node >= next_node_ || first_node_ == next_node_) return newest_.instant_ns;
  return instants_ns_[static_cast<std::size_t>(std::max(node, first_node_)) &
                      (instants_ns_.size() - 1)];
}

std::int64_t Deskewer::instant_at(std::int64_t rotor_ticks) const noexcept {
  const double position = nodes(rotor_ticks);
  const auto node = static_cast<std::int64_t>(std::floor(position));
  const std::int64_t before_ns = instant_of(node), after_ns = instant_of(node + 1);
  return before_ns + static_cast<std::int64_t>((position - static_cast<double>(node)) *
                                               static_cast<double>(after_ns - before_ns));
}

std::int64_t Deskewer::reference_ns(std::int64_t frame) const noexcept {
  const std::int64_t begin = frame * config_.revolution_ticks;
  switch (config_.at) {
    case frame::FrameInstant::kStart:
      return instant_at(begin);
    case frame::FrameInstant::kMiddle:
      return instant_at(begin + config_.revolution_ticks / 2);
    case frame::FrameInstant::kEnd:
      break;
  }
  return instant_at(begin + config_.revolution_ticks);
}

void Deskewer::spread_poses(std::int64_t first_column, std::int64_t first_node,
                            std::size_t place) noexcept {
  for (std::size_t head_column = 0; head_column < head_columns_; ++head_column) {
    // On average a column's beams leave in its middle.
    const std::int64_t column = first_column + static_cast<std::int64_t>(head_column);
    const std::int64_t from = first_node * kNodeColumns;
    const auto node = static_cast<std::size_t>((column - from) / kNodeColumns);
    const double share =
        (static_cast<double>((column - from) % kNodeColumns) + 0.5) / double{kNodeColumns};
    const vehicle::PlanarPose& a = node_poses_[node];
    const vehicle::PlanarPose& b = node_poses_[node + 1];
    const std::size_t i = place * head_columns_ + head_column;
    cosine_[i] = static_cast<float>(a.cosine + share * (b.cosine - a.cosine));
    sine_[i] = static_cast<float>(a.sine + share * (b.sine - a.sine));
    x_m_[i] = static_cast<float>(a.x_m + share * (b.x_m - a.x_m));
    y_m_[i] = static_cast<float>(a.y_m + share * (b.y_m - a.y_m));
  }
}

Deskewer::Deskewed Deskewer::deskew(std::int64_t frame, std::size_t place) noexcept {
  vehicle::EgoMotion& motion = *config_.motion;
  motion.take_new();
  const std::int64_t first_column = frame * columns_ + first_shift_;
  const std::int64_t first_node =
      (first_column - ((first_column % kNodeColumns) + kNodeColumns) % kNodeColumns) / kNodeColumns;
  const double end = nodes((frame + 1) * config_.revolution_ticks);
  fill(std::max(first_node + static_cast<std::int64_t>(node_ns_.size()),
                static_cast<std::int64_t>(std::floor(end)) + 1));
  for (std::size_t i = 0; i < node_ns_.size(); ++i) {
    node_ns_[i] = instant_of(first_node + static_cast<std::int64_t>(i));
  }
  frame::DeskewInfo info{.state = frame::DeskewState::kNoEgoMotion,
                         .at = config_.at,
                         .reference_ns = reference_ns(frame),
                         .newest_motion_ns = 0};
  if (const auto newest_ns = motion.newest_ns()) {
    info.newest_motion_ns = *newest_ns - instant_at((frame + 1) * config_.revolution_ticks);
  }
  if (first_node < anew_node_) return {info, {}};
  if (!motion.poses(node_ns_, info.reference_ns, node_poses_)) return {info, {}};
  spread_poses(first_column, first_node, place);
  info.state = frame::DeskewState::kDone;
  for (std::size_t i = 0; i < info.moved.size(); ++i) {
    const std::size_t node = i * (node_ns_.size() - 1) / (info.moved.size() - 1);
    info.moved[i] = {node_ns_[node], motion_of(node_poses_[node])};
  }
  const auto rows = static_cast<std::size_t>(config_.shape.rows);
  return {info, by_row_.subspan(place * rows, rows)};
}

}  // namespace terracut::decode
