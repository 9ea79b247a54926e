// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/road_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace terracut::pipeline {
namespace {

using Patch = GroundPatches::Patch;

constexpr float kFar_m = std::numeric_limits<float>::max();
/// Patches of a ring whose ranges differ by more lie on different surfaces.
constexpr float kSameSurface_m = 1.0F;
/// How far to either side of an edge the ring is looked at for going on as steeply.
constexpr float kBeside_m = 1.5F;
/// How many rows without ground the way leads across.
constexpr int kRowsAcross = 3;
/// Lone barriers are told by the barriers so many rows and patches around them.
constexpr int kAround = 2;
/// A surface that comes as near to its edges as the vehicle ends this far beyond the vehicle's
/// side: growing back runs along rings and columns, and not always straight.
constexpr float kGrowBack = 1.3F;

/// Mean position of some patches.
struct Mean {
  float x_m = 0, y_m = 0, z_m = 0;
  int count = 0;

  void add(const Patch& patch) noexcept {
    x_m += patch.x_m;
    y_m += patch.y_m;
    z_m += patch.z_m;
    ++count;
  }
  void finish() noexcept {
    if (count == 1) return;
    const float share = 1.0F / static_cast<float>(count);
    x_m *= share;
    y_m *= share;
    z_m *= share;
  }
};

}  // namespace

RoadSurface::RoadSurface(const Config& config, ImageShape shape, rt::FixedMemory& memory)
    : config_(config),
      ground_(config.patches, shape, memory),
      terrain_(config.terrain, memory),
      state_(memory.take<State>("road surface", ground_.patches().size())),
      is_lone_(memory.take<std::uint8_t>("road surface", ground_.patches().size())),
      distance_m_(memory.take<float>("road surface", ground_.patches().size())),
      to_visit_(memory.take<std::uint32_t>("road surface", ground_.patches().size())) {}

void RoadSurface::mark(const RangeImage& image, const CellPlanes& planes,
                       std::span<Label> labels) noexcept {
  ground_.collect(image, planes);
  terrain_.fit(ground_);
  find_barriers();
  drop_lone_barriers();
  measure_along_rings();
  find_clear();
  reach_from_track();
  grow_back();

  const auto index = image.return_index();
  const auto stride = static_cast<std::size_t>(image.shape().stride());
  const auto columns = static_cast<std::size_t>(image.shape().columns);
  const auto width = static_cast<std::size_t>(ground_.columns_per_patch());
  for (std::size_t i = 0, row = 0; i < state_.size(); ++row) {
    for (std::size_t begin = 0; begin < columns; begin += width, ++i) {
      if (state_[i] == State::kReached || !ground_.patches()[i].has_ground) continue;
      const std::size_t first = row * stride + begin;
      const std::size_t end = row * stride + std::min(begin + width, columns);
      for (std::size_t cell = first; cell < end; ++cell) {
        if (planes.label[cell] == Label::kGround) labels[index[cell]] = Label::kOtherGround;
      }
    }
  }
  for (const OverflowReturn& extra : image.overflow()) {
    Label& label = labels[extra.return_index];
    const std::size_t patch =
        at(static_cast<int>(extra.cell / stride), static_cast<int>(extra.cell % stride / width));
    if (label == Label::kGround && state_[patch] != State::kReached) label = Label::kOtherGround;
  }
}

void RoadSurface::find_barriers() noexcept {
  const auto patches = ground_.patches();
  for (int row = 0; row < ground_.rows(); ++row) {
    for (int index = 0; index < ground_.per_row(); ++index) {
      const std::size_t i = at(row, index);
      const Patch& patch = patches[i];
      if (patch.has_obstacle || patch.roughness_m > config_.terrain.max_roughness_m) {
        state_[i] = State::kBarrier;
      } else if (!patch.has_ground) {
        state_[i] = State::kEmpty;
      } else {
        state_[i] = is_edge(row, index) ? State::kBarrier : State::kGround;
      }
    }
  }
}

bool RoadSurface::is_edge(int row, int index) const noexcept {
  const float range_m = ground_.patches()[at(row, index)].range_m;
  const int reach = ground_.patches_over(0.5F * config_.edge_width_m, range_m);
  const auto slope = [&](Run left, Run right) { return slope_between(row, index, left, right); };
  float across = slope({index - reach, index - 1}, {index + 1, index + reach});
  if (std::isnan(across)) across = slope({index - reach, index - 1}, {index, index});
  if (std::isnan(across)) across = slope({index, index}, {index + 1, index + reach});
  if (!(std::fabs(across) > config_.edge_slope)) return false;
  // Where the ring goes on like that to one side, the ground is inclined, and this no edge of it.
  const int beside = ground_.patches_over(kBeside_m, range_m);
  const int left = index - reach, right = index + reach;
  const auto goes_on_at = [&](float slope_beside) {
    return std::fabs(slope_beside - across) < config_.edge_bend;  // not where that is unknown
  };
  return !goes_on_at(slope({left - beside, left - (beside + 1) / 2}, {left - beside / 2, left})) &&
         !goes_on_at(
             slope({right, right + beside / 2}, {right + (beside + 1) / 2, right + beside}));
}

float RoadSurface::slope_between(int row, int index, Run left, Run right) const noexcept {
  const auto patches = ground_.patches();
  const Patch& middle = patches[at(row, index)];
  const auto mean_of = [&](Run run) {
    Mean mean;
    for (int i = run.first; i <= run.last; ++i) {
      const Patch& patch = patches[at(row, ground_.wrapped(i))];
      const bool near = std::fabs(patch.range_m - middle.range_m) < kSameSurface_m;
      if (patch.has_ground && near) mean.add(patch);
    }
    return mean;
  };
  Mean from = mean_of(left), to = mean_of(right);
  if (from.count == 0 || to.count == 0) return std::numeric_limits<float>::quiet_NaN();
  from.finish();
  to.finish();
  const float dx_m = to.x_m - from.x_m, dy_m = to.y_m - from.y_m;
  const float rise_m = to.z_m - from.z_m - terrain_.at(middle.x_m, middle.y_m).rise_m(dx_m, dy_m);
  return rise_m / std::max(std::sqrt(dx_m * dx_m + dy_m * dy_m), 0.5F * config_.edge_width_m);
}

void RoadSurface::drop_lone_barriers() noexcept {
  // Kerbs and grass show in several rings; what shows in one is a laser's noise. Obstacles stay.
  const auto patches = ground_.patches();
  for (int row = 0; row < ground_.rows(); ++row) {
    for (int index = 0; index < ground_.per_row(); ++index) {
      const std::size_t i = at(row, index);
      is_lone_[i] = 0;
      if (state_[i] != State::kBarrier || patches[i].has_obstacle) continue;
      int neighbours = 0;
      for (int near_row = std::max(row - kAround, 0);
           near_row <= std::min(row + kAround, ground_.rows() - 1); ++near_row) {
        if (near_row == row) continue;
        for (int near = index - kAround; near <= index + kAround; ++near) {
          neighbours += state_[at(near_row, ground_.wrapped(near))] == State::kBarrier;
        }
      }
      is_lone_[i] = neighbours < config_.edge_neighbours;
    }
  }
  for (std::size_t i = 0; i < state_.size(); ++i) {
    if (is_lone_[i] != 0) state_[i] = State::kGround;
  }
}

void RoadSurface::measure_along_rings() noexcept {
  const auto patches = ground_.patches();
  const float half_width_m = 0.5F * config_.vehicle_width_m;
  const int per_row = ground_.per_row();
  for (int row = 0; row < ground_.rows(); ++row) {
    // Around, and on across the seam to the first barrier.
    const auto sweep = [&](int begin, int step) {
      int since = 0;
      const Patch* barrier = nullptr;
      for (int n = 0, index = begin; n < 2 * per_row; ++n, index = ground_.wrapped(index + step)) {
        const std::size_t i = at(row, index);
        ++since;
        if (state_[i] == State::kBarrier) {
          if (n >= per_row) break;
          barrier = &patches[i];
          since = 0;
          distance_m_[i] = 0;
        } else if (barrier != nullptr && state_[i] == State::kGround &&
                   std::fabs(barrier->range_m - patches[i].range_m) < half_width_m) {
          const float along_m = static_cast<float>(since) * ground_.spacing_m(patches[i].range_m);
          distance_m_[i] = std::min(distance_m_[i], along_m);
        }
      }
    };
    std::fill_n(&distance_m_[at(row, 0)], per_row, kFar_m);
    sweep(0, 1);
    sweep(per_row - 1, -1);
  }
}

void RoadSurface::find_clear() noexcept {
  for (int row = 0; row < ground_.rows(); ++row) {
    for (int index = 0; index < ground_.per_row(); ++index) {
      const std::size_t i = at(row, index);
      if (state_[i] == State::kGround) state_[i] = State::kClear;
    }
  }
  const float half_width_m = 0.5F * config_.vehicle_width_m;
  for (int row = 0; row < ground_.rows(); ++row) {
    for (int index = 0; index < ground_.per_row(); ++index) {
      const std::size_t i = at(row, index);
      if (distance_m_[i] >= half_width_m) continue;
      if (state_[i] == State::kClear) state_[i] = State::kGround;
      block_around(row, index, 1);
      block_around(row, index, -1);
    }
  }
}

void RoadSurface::block_around(int row, int index, int step) noexcept {
  // The barrier of this ring, and how far the other ring is from it: together the distance.
  const auto patches = ground_.patches();
  const float half_width_m = 0.5F * config_.vehicle_width_m;
  const std::size_t i = at(row, index);
  const float along_m = distance_m_[i];
  const float apart_limit_m2 = half_width_m * half_width_m - along_m * along_m;
  for (int near_row = row + step; near_row >= 0 && near_row < ground_.rows(); near_row += step) {
    const std::size_t near = at(near_row, index);
    if (state_[near] == State::kEmpty) continue;
    const float apart_m = patches[near].range_m - patches[i].range_m;
    // Another barrier as near blocks what is behind it.
    if (apart_m * apart_m >= apart_limit_m2 || distance_m_[near] <= along_m) break;
    if (state_[near] == State::kClear) state_[near] = State::kGround;
  }
}

bool RoadSurface::level(const Patch& from, const Patch& to) const noexcept {
  const float dx_m = to.x_m - from.x_m;
  const float dy_m = to.y_m - from.y_m;
  const float run_squared_m2 = dx_m * dx_m + dy_m * dy_m;
  if (run_squared_m2 > config_.max_gap_m * config_.max_gap_m) return false;
  const float rise_m =
      std::fabs(to.z_m - from.z_m - terrain_.at(from.x_m, from.y_m).rise_m(dx_m, dy_m));
  return rise_m <= config_.max_step_m ||
         rise_m * rise_m <= config_.max_step_slope * config_.max_step_slope * run_squared_m2;
}

void RoadSurface::reach_from_track() noexcept {
  const auto patches = ground_.patches();
  visits_ = 0;
  for (std::size_t i = 0; i < state_.size(); ++i) {
    const Patch& patch = patches[i];
    if (state_[i] != State::kClear || std::fabs(patch.x_m) > config_.track_m ||
        std::fabs(patch.y_m) > 0.5F * config_.vehicle_width_m) {
      continue;
    }
    state_[i] = State::kReached;
    to_visit_[visits_++] = static_cast<std::uint32_t>(i);
  }
  while (visits_ > 0) {
    const std::size_t from = to_visit_[--visits_];
    const int row = static_cast<int>(from) / ground_.per_row();
    const int index = static_cast<int>(from) % ground_.per_row();
    visit(from, at(row, ground_.wrapped(index - 1)));
    visit(from, at(row, ground_.wrapped(index + 1)));
    for (const int step : {-1, 1}) {
      int near_row = row + step;
      const auto is_inside = [&] { return near_row >= 0 && near_row < ground_.rows(); };
      for (int across = 1; across < kRowsAcross && is_inside(); ++across, near_row += step) {
        if (patches[at(near_row, index)].has_ground) break;
      }
      if (is_inside()) visit(from, at(near_row, index));
    }
  }
}

void RoadSurface::visit(std::size_t from, std::size_t to) noexcept {
  const auto patches = ground_.patches();
  if (state_[to] != State::kClear || !level(patches[from], patches[to])) return;
  state_[to] = State::kReached;
  to_visit_[visits_++] = static_cast<std::uint32_t>(to);
}

void RoadSurface::grow_back() noexcept {
  for (std::size_t i = 0; i < state_.size(); ++i) {
    distance_m_[i] = state_[i] == State::kReached ? 0 : kFar_m;
  }
  // Along the rings first, then from row to row.
  const float limit_m = kGrowBack * 0.5F * config_.vehicle_width_m;
  for (int row = 0; row < ground_.rows(); ++row) {
    for (int index = 0; index < ground_.per_row(); ++index) {
      if (distance_m_[at(row, index)] != 0) continue;
      for (const int step : {-1, 1}) {
        int from = index;
        for (int to = ground_.wrapped(from + step); grow(at(row, from), at(row, to), limit_m);
             to = ground_.wrapped(to + step)) {
          from = to;
        }
      }
    }
  }
  for (int row = 0; row < ground_.rows(); ++row) {
    for (int index = 0; index < ground_.per_row(); ++index) {
      if (distance_m_[at(row, index)] > limit_m) continue;
      for (const int step : {-1, 1}) {
        for (int to = row + step;
             to >= 0 && to < ground_.rows() && grow(at(to - step, index), at(to, index), limit_m);
             to += step) {
        }
      }
    }
  }
  for (std::size_t i = 0; i < state_.size(); ++i) {
    if (distance_m_[i] <= limit_m) state_[i] = State::kReached;
  }
}

bool RoadSurface::grow(std::size_t from, std::size_t to, float limit_m) noexcept {
  if (state_[to] != State::kGround && state_[to] != State::kClear) return false;
  const Patch& here = ground_.patches()[from];
  const Patch& there = ground_.patches()[to];
  const float dx_m = there.x_m - here.x_m, dy_m = there.y_m - here.y_m;
  const float distance_m = distance_m_[from] + std::sqrt(dx_m * dx_m + dy_m * dy_m);
  if (distance_m > limit_m || distance_m >= distance_m_[to] || !level(here, there)) return false;
  distance_m_[to] = distance_m;
  return true;
}

}  // namespace terracut::pipeline
