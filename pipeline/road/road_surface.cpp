// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/road/road_surface.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "rt/vector_clones.hpp"

namespace terracut::road {
namespace {

constexpr float kFar_m = std::numeric_limits<float>::max();
/// The most rows without ground that a path may cross.
constexpr int kRowsAcross = 3;
/// A barrier is lone if few others lie within this many rows and patches around it.
constexpr int kAround = 2;
/// Growing back goes as far as this many times half the vehicle's width: its path follows rings and
/// columns, which is longer than a straight line.
constexpr float kGrowBack = 1.3F;

/// Counts for each value the ones among it and the 2 kAround values after it.
TERRACUT_VECTOR_CLONES void count_around(const std::uint8_t* values, std::size_t count,
                                         std::uint8_t* around) noexcept {
  for (std::size_t i = 0; i < count; ++i) {
    unsigned sum = 0;
    for (std::size_t k = 0; k <= 2 * static_cast<std::size_t>(kAround); ++k) sum += values[i + k];
    around[i] = static_cast<std::uint8_t>(sum);
  }
}

/// The number of bytes that for_each() tests together; its input must be a multiple of them.
constexpr std::size_t kTogether = sizeof(std::uint64_t);

/// Calls `act` with the index of each byte that is not 0, in order.
template <class Act>
void for_each(std::span<const std::uint8_t> bytes, Act act) noexcept {
  for (std::size_t first = 0; first < bytes.size(); first += kTogether) {
    std::uint64_t together = 0;
    std::memcpy(&together, &bytes[first], kTogether);
    if (together == 0) continue;
    for (std::size_t i = first; i < first + kTogether; ++i) {
      if (bytes[i] != 0) act(static_cast<int>(i));
    }
  }
}

TERRACUT_VECTOR_CLONES void add(const std::uint8_t* values, std::size_t count,
                                std::uint8_t* __restrict sums) noexcept {
  for (std::size_t i = 0; i < count; ++i) sums[i] = static_cast<std::uint8_t>(sums[i] + values[i]);
}

TERRACUT_VECTOR_CLONES void find_rough(const float* roughness_m, float most_m, std::size_t count,
                                       std::uint8_t* __restrict is_rough) noexcept {
  for (std::size_t i = 0; i < count; ++i) is_rough[i] = roughness_m[i] > most_m ? 1 : 0;
}

/// Converts the distance to a barrier along a ring into the range over which the barrier also
/// blocks other rings; negative if it blocks none.
TERRACUT_VECTOR_CLONES void find_reaches(float half_width_m, std::size_t count,
                                         float* distance_m) noexcept {
  for (std::size_t i = 0; i < count; ++i) {
    const float reach_m2 = half_width_m * half_width_m - distance_m[i] * distance_m[i];
    const float reach_m = std::sqrt(std::fabs(reach_m2));
    distance_m[i] = reach_m2 > 0.0F ? reach_m : -kFar_m;
  }
}

/// Finds the patches of a row within the ranges that barriers of earlier rows block, and adds the
/// row's own barriers. A patch outside a blocked range ends that range, because patches beyond it
/// lie behind something else. Patches without a range (NaN) change nothing.
TERRACUT_VECTOR_CLONES void block_ranges(const float* range_m, const float* reach_m,
                                         std::size_t count, float* __restrict from_m,
                                         float* __restrict to_m,
                                         float* __restrict blocked) noexcept {
  for (std::size_t i = 0; i < count; ++i) {
    const float from = from_m[i], to = to_m[i];
    const bool is_outside = (range_m[i] <= from) | (range_m[i] >= to);
    const float still_from = is_outside ? kFar_m : from, still_to = is_outside ? -kFar_m : to;
    blocked[i] += is_outside ? 0.0F : 1.0F;
    from_m[i] = std::min(still_from, range_m[i] - reach_m[i]);
    to_m[i] = std::max(still_to, range_m[i] + reach_m[i]);
  }
}

}  // namespace

RoadSurface::RoadSurface(const Config& config, frame::ImageShape shape, memory::FixedMemory& memory)
    : config_(config),
      ground_(config.patches, shape, memory),
      terrain_(config.terrain, ground_.x_m().size(), memory),
      edges_(config.edges, ground_, memory) {
  const auto per_row = static_cast<std::size_t>(ground_.per_row());
  const std::size_t patches = ground_.x_m().size();
  state_ = memory.take<State>("road surface", patches);
  is_barrier_ = memory.take<std::uint8_t>("road surface", per_row + 2 * kAround);
  around_ = memory.take<std::uint8_t>("road surface", patches);
  is_active_ =
      memory.take<std::uint8_t>("road surface", (per_row + kTogether - 1) / kTogether * kTogether);
  neighbours_ = memory.take<std::uint8_t>("road surface", per_row);
  distance_m_ = memory.take<float>("road surface", patches);
  blocked_ = memory.take<float>("road surface", patches);
  from_m_ = memory.take<float>("road surface", per_row);
  to_m_ = memory.take<float>("road surface", per_row);
  to_visit_ = memory.take<Place>("road surface", patches);
}

void RoadSurface::mark(const frame::RangeImage& image, const stage::CellPlanes& planes,
                       std::span<frame::Label> labels) noexcept {
  ground_.collect(image, planes);
  terrain_.fit(ground_);
  find_barriers();
  drop_lone_barriers();
  measure_along_rings();
  find_clear();
  reach_from_track();
  grow_back();

  mark_returns(image, planes, labels);
}

void RoadSurface::mark_returns(const frame::RangeImage& image, const stage::CellPlanes& planes,
                               std::span<frame::Label> labels) const noexcept {
  const auto index = image.return_index();
  const auto stride = static_cast<std::uint32_t>(image.shape().stride());
  const auto columns = static_cast<std::uint32_t>(image.shape().columns);
  const auto width = static_cast<std::uint32_t>(ground_.columns_per_patch());
  const auto per_row = static_cast<std::uint32_t>(ground_.per_row());
  for (std::uint32_t i = 0, row = 0; i < state_.size(); ++row) {
    for (std::uint32_t begin = 0; begin < columns; begin += width, ++i) {
      if (state_[i] >= State::kGrown || ground_.has_ground()[i] == 0) continue;
      const std::uint32_t first = row * stride + begin;
      const std::uint32_t end = row * stride + std::min(begin + width, columns);
      for (std::uint32_t cell = first; cell < end; ++cell) {
        if (planes.label[cell] == frame::Label::kGround)
          labels[index[cell]] = frame::Label::kOtherGround;
      }
    }
  }
  for (const frame::OverflowReturn& extra : image.overflow()) {
    frame::Label& label = labels[extra.return_index];
    if (label != frame::Label::kGround) continue;
    const std::uint32_t patch = extra.cell / stride * per_row + extra.cell % stride / width;
    if (state_[patch] < State::kGrown) label = frame::Label::kOtherGround;
  }
}

void RoadSurface::find_barriers() noexcept {
  edges_.begin_frame();
  const auto per_row = static_cast<std::size_t>(ground_.per_row());
  for (int row = 0; row < ground_.rows(); ++row) {
    const std::size_t first = at(row, 0);
    find_rough(&ground_.roughness_m()[first], config_.terrain.max_roughness_m, per_row,
               is_barrier_.data());
    State* const state = &state_[first];
    const std::uint8_t* const is_rough = is_barrier_.data();
    const std::uint8_t* const is_edge = edges_.find(ground_, terrain_, row).data();
    const std::uint8_t* const has_ground = &ground_.has_ground()[first];
    const std::uint8_t* const has_obstacle = &ground_.has_obstacle()[first];
    for (std::size_t i = 0; i < per_row; ++i) {
      const State without = has_ground[i] != 0 ? State::kGround : State::kEmpty;
      const bool bars = (is_rough[i] | is_edge[i] | has_obstacle[i]) != 0;
      state[i] = bars ? State::kBarrier : without;
    }
  }
  open_seams();
}

void RoadSurface::open_seams() noexcept {
  // At a seam a step makes the ground look rough, and its upper side may be labelled obstacle. Both
  // effects are narrower than the vehicle, so an obstacle that blocks the vehicle also has patches
  // beside them.
  for (int index = 0; index < ground_.per_row(); ++index) {
    if (!edges_.runs_through_sensor(index)) continue;
    for (int row = 0; row < ground_.rows(); ++row) {
      if (ground_.has_ground()[at(row, index)] == 0) continue;
      const float range_m = ground_.range_m()[at(row, index)];
      const int reach = ground_.patches_over(config_.patches.roughness_window_m, range_m);
      for (int i = index - reach; i <= index + reach; ++i) {
        const std::size_t patch = at(row, ground_.wrapped(i));
        if (ground_.has_ground()[patch] != 0) state_[patch] = State::kGround;
      }
    }
  }
}

void RoadSurface::drop_lone_barriers() noexcept {
  // Kerbs and grass show in several rings; a barrier in a single ring is noise of that laser.
  // Obstacles are never dropped.
  const auto per_row = static_cast<std::size_t>(ground_.per_row());
  for (int row = 0; row < ground_.rows(); ++row) {
    const std::size_t first = at(row, 0);
    for (std::size_t i = 0; i < per_row; ++i) {
      is_barrier_[kAround + i] = state_[first + i] == State::kBarrier;
    }
    for (int i = 0; i < kAround; ++i) {
      const auto before = static_cast<std::size_t>(ground_.wrapped(i - kAround));
      const auto after = static_cast<std::size_t>(ground_.wrapped(i));
      is_barrier_[static_cast<std::size_t>(i)] = is_barrier_[kAround + before];
      is_barrier_[kAround + per_row + static_cast<std::size_t>(i)] = is_barrier_[kAround + after];
    }
    count_around(is_barrier_.data(), per_row, &around_[first]);
  }
  for (int row = 0; row < ground_.rows(); ++row) {
    const std::size_t first = at(row, 0);
    for (std::size_t i = 0; i < per_row; ++i) neighbours_[i] = 0;
    for (int near = std::max(row - kAround, 0); near <= std::min(row + kAround, ground_.rows() - 1);
         ++near) {
      if (near != row) add(&around_[at(near, 0)], per_row, neighbours_.data());
    }
    State* const state = &state_[first];
    const std::uint8_t* const has_obstacle = &ground_.has_obstacle()[first];
    const std::uint8_t* const neighbours = neighbours_.data();
    const auto enough = static_cast<std::uint8_t>(config_.edge_neighbours);
    for (std::size_t i = 0; i < per_row; ++i) {
      const State was = state[i];
      const bool is_lone =
          (was == State::kBarrier) & (has_obstacle[i] == 0) & (neighbours[i] < enough);
      state[i] = is_lone ? State::kGround : was;
    }
  }
}

void RoadSurface::measure_along_rings() noexcept {
  std::fill(distance_m_.begin(), distance_m_.end(), kFar_m);
  const auto per_row = static_cast<std::size_t>(ground_.per_row());
  for (int row = 0; row < ground_.rows(); ++row) {
    const State* const state = &state_[at(row, 0)];
    float* const distance_m = &distance_m_[at(row, 0)];
    for (std::size_t i = 0; i < per_row; ++i) is_active_[i] = state[i] == State::kBarrier;
    for_each(is_active_, [&](int index) {
      distance_m[index] = 0;
      if (state[ground_.after(index)] != State::kBarrier) measure_from(row, index, 1);
      if (state[ground_.before(index)] != State::kBarrier) measure_from(row, index, -1);
    });
  }
}

void RoadSurface::measure_from(int row, int index, int step) noexcept {
  const float half_width_m = 0.5F * config_.vehicle_width_m;
  const float barrier_m = ground_.range_m()[at(row, index)];
  // No patch that matters is nearer to the sensor than this; so no spacing is smaller.
  const float least_spacing_m = ground_.spacing_m(barrier_m - half_width_m);
  float since = 1;
  for (; since * least_spacing_m < half_width_m; ++since) {
    index = step > 0 ? ground_.after(index) : ground_.before(index);
    const std::size_t i = at(row, index);
    if (state_[i] == State::kBarrier) return;
    const float range_m = ground_.range_m()[i];
    if (state_[i] == State::kGround && std::fabs(barrier_m - range_m) < half_width_m) {
      distance_m_[i] = std::min(distance_m_[i], since * ground_.spacing_m(range_m));
    }
  }
}

void RoadSurface::find_clear() noexcept {
  find_reaches(0.5F * config_.vehicle_width_m, distance_m_.size(), distance_m_.data());
  std::fill(blocked_.begin(), blocked_.end(), 0.0F);
  begin_blocking();
  for (int row = 0; row < ground_.rows(); ++row) block_row(row);
  begin_blocking();
  for (int row = ground_.rows() - 1; row >= 0; --row) block_row(row);
  for (std::size_t i = 0; i < state_.size(); ++i) {
    if (state_[i] != State::kGround) continue;
    if (distance_m_[i] < 0 && blocked_[i] == 0) state_[i] = State::kClear;
  }
}

void RoadSurface::begin_blocking() noexcept {
  std::fill(from_m_.begin(), from_m_.end(), kFar_m);
  std::fill(to_m_.begin(), to_m_.end(), -kFar_m);
}

void RoadSurface::block_row(int row) noexcept {
  const std::size_t first = at(row, 0);
  block_ranges(&ground_.range_m()[first], &distance_m_[first], from_m_.size(), from_m_.data(),
               to_m_.data(), &blocked_[first]);
}

bool RoadSurface::level(std::size_t from, std::size_t to) const noexcept {
  const float dx_m = ground_.x_m()[to] - ground_.x_m()[from];
  const float dy_m = ground_.y_m()[to] - ground_.y_m()[from];
  const float run_squared_m2 = dx_m * dx_m + dy_m * dy_m;
  if (run_squared_m2 > config_.max_gap_m * config_.max_gap_m) return false;
  const float rise_m = std::fabs(ground_.z_m()[to] - ground_.z_m()[from] -
                                 terrain_.at_patch(from).rise_m(dx_m, dy_m));
  return rise_m <= config_.max_step_m ||
         rise_m * rise_m <= config_.max_step_slope * config_.max_step_slope * run_squared_m2;
}

void RoadSurface::reach_from_track() noexcept {
  visits_ = 0;
  for (int row = 0; row < ground_.rows(); ++row) {
    for (int index = 0; index < ground_.per_row(); ++index) {
      const std::size_t i = at(row, index);
      if (state_[i] != State::kClear || std::fabs(ground_.x_m()[i]) > config_.track_m ||
          std::fabs(ground_.y_m()[i]) > 0.5F * config_.vehicle_width_m) {
        continue;
      }
      state_[i] = State::kReached;
      distance_m_[i] = 0;
      to_visit_[visits_++] = {row, index};
    }
  }
  while (visits_ > 0) {
    const auto [row, index] = to_visit_[--visits_];
    const std::size_t from = at(row, index);
    visit(from, row, ground_.before(index));
    visit(from, row, ground_.after(index));
    for (const int step : {-1, 1}) {
      int near_row = row + step;
      const auto is_inside = [&] { return near_row >= 0 && near_row < ground_.rows(); };
      for (int across = 1; across < kRowsAcross && is_inside(); ++across, near_row += step) {
        if (ground_.has_ground()[at(near_row, index)] != 0) break;
      }
      if (is_inside()) visit(from, near_row, index);
    }
  }
}

void RoadSurface::visit(std::size_t from, int row, int index) noexcept {
  const std::size_t to = at(row, index);
  if (state_[to] != State::kClear || !level(from, to)) return;
  state_[to] = State::kReached;
  distance_m_[to] = 0;
  to_visit_[visits_++] = {row, index};
}

void RoadSurface::grow_back() noexcept {
  const float limit_m = kGrowBack * 0.5F * config_.vehicle_width_m;
  const auto per_row = static_cast<std::size_t>(ground_.per_row());
  const auto find_growing = [&](const State* from, const State* one, const State* other,
                                std::size_t count, std::uint8_t* growing) {
    for (std::size_t i = 0; i < count; ++i) {
      const bool is_one_open = (one[i] >= State::kGround) & (one[i] <= State::kGrown);
      const bool is_other_open = (other[i] >= State::kGround) & (other[i] <= State::kGrown);
      growing[i] = (from[i] >= State::kGrown) & (is_one_open | is_other_open);
    }
  };
  // Grows along the rings first, then from row to row.
  for (int row = 0; row < ground_.rows(); ++row) {
    const State* const state = &state_[at(row, 0)];
    is_active_[0] = is_active_[per_row - 1] = 1;
    if (per_row > 2) find_growing(state + 1, state, state + 2, per_row - 2, &is_active_[1]);
    for_each(is_active_, [&](int index) {
      if (state[index] != State::kReached) return;
      for (int from = index, to = ground_.after(from); grow(at(row, from), at(row, to), limit_m);
           to = ground_.after(to)) {
        from = to;
      }
      for (int from = index, to = ground_.before(from); grow(at(row, from), at(row, to), limit_m);
           to = ground_.before(to)) {
        from = to;
      }
    });
  }
  for (int row = 0; row < ground_.rows(); ++row) {
    const int below = std::max(row - 1, 0), above = std::min(row + 1, ground_.rows() - 1);
    find_growing(&state_[at(row, 0)], &state_[at(below, 0)], &state_[at(above, 0)], per_row,
                 is_active_.data());
    for_each(is_active_, [&](int index) {
      for (int to = row + 1; to < ground_.rows() && grow(at(to - 1, index), at(to, index), limit_m);
           ++to) {
      }
      for (int to = row - 1; to >= 0 && grow(at(to + 1, index), at(to, index), limit_m); --to) {
      }
    });
  }
}

bool RoadSurface::grow_far(std::size_t from, std::size_t to, float limit_m) noexcept {
  const float dx_m = ground_.x_m()[to] - ground_.x_m()[from];
  const float dy_m = ground_.y_m()[to] - ground_.y_m()[from];
  const float distance_m = distance_m_[from] + std::sqrt(dx_m * dx_m + dy_m * dy_m);
  const bool is_grown = state_[to] == State::kGrown;
  if (distance_m > limit_m || (is_grown && distance_m >= distance_m_[to])) return false;
  if (!level(from, to)) return false;
  state_[to] = State::kGrown;
  distance_m_[to] = distance_m;
  return true;
}

}  // namespace terracut::road
