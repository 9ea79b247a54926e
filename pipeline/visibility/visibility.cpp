// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "visibility.hpp"

#include <algorithm>

namespace terracut::visibility {
namespace {

/// What each clear turn after the first ones weighs in the learnt view: some 20 s at 10 Hz.
constexpr float kSlow = 0.005F;

/// Goes a part of the way from what was expected to what is there.
void approach(SectorSight& expected, const SectorSight& now, float weight) noexcept {
  for (float SectorSight::* const figure :
       {&SectorSight::visible_m, &SectorSight::lost, &SectorSight::stuck, &SectorSight::returned,
        &SectorSight::far, &SectorSight::alone}) {
    expected.*figure += weight * (now.*figure - expected.*figure);
  }
}

}  // namespace

Visibility::Visibility(const Config& config, const mount::RingProfile& profile,
                       frame::ImageShape shape, memory::FixedMemory& memory)
    : config_(config),
      sights_(profile, shape, memory),
      sectors_(memory.take<Sector>("visibility", kSectors)),
      signs_(memory.take<Signs>("visibility", kSectors)) {}

void Visibility::forget() noexcept {
  sights_.forget();
  std::ranges::fill(sectors_, Sector{});
  std::ranges::fill(signs_, Signs{});
  fog_ = dirt_ = {};
  turns_ = 0;
}

void Visibility::look(const frame::RangeImage& image, const stage::CellPlanes& planes) noexcept {
  const std::span<const SectorSight> sights = sights_.look(image, planes);
  for (std::size_t i = 0; i < kSectors; ++i) sectors_[i].now = sights[i];
  if (has_learnt()) {
    judge();
  } else {
    ++turns_;
    // Sights are whole once it is known which beams return.
    const int taught = turns_ - SectorSights::kUsualTurns;
    if (taught > 0) {
      for (Sector& sector : sectors_) {
        approach(sector.expected, sector.now, 1 / static_cast<float>(taught));
        sector.has_view = sector.expected.returned >= config_.seen_share;
      }
    }
  }
}

void Visibility::judge() noexcept {
  fog_.count(is_fog(), config_.turns_to_name);
  dirt_.count(fog_.turns == 0 && is_dirt(), config_.turns_to_name);
  for (std::size_t i = 0; i < kSectors; ++i) {
    Sector& sector = sectors_[i];
    Signs& signs = signs_[i];
    signs.covered.count(is_covered(sector), config_.turns_to_name);
    signs.airborne.count(sector.has_view && has_more_alone(sector, config_.airborne_share),
                         config_.turns_to_name);
    if (signs.covered.is_named) {
      sector.condition = {State::kBlocked, Cause::kCovered};
    } else if (!sector.has_view) {
      sector.condition = {};
    } else if (fog_.is_named) {
      sector.condition = {State::kReduced, Cause::kFog};
    } else if (dirt_.is_named) {
      sector.condition = {State::kReduced, Cause::kDirt};
    } else if (signs.airborne.is_named) {
      sector.condition = {State::kReduced, Cause::kAirborne};
    } else {
      sector.condition = {};
    }
    const bool has_sign = fog_.turns + dirt_.turns + signs.covered.turns + signs.airborne.turns > 0;
    if (!has_sign) {
      approach(sector.expected, sector.now, kSlow);
      sector.has_view = sector.expected.returned >= config_.seen_share;
    }
  }
}

void Visibility::Sign::count(bool is_there, int turns_to_name) noexcept {
  turns = is_there ? std::min(turns + 1, turns_to_name) : std::max(turns - 1, 0);
  if (turns == turns_to_name) is_named = true;
  if (turns == 0) is_named = false;
}

bool Visibility::is_covered(const Sector& sector) const noexcept {
  return sector.has_view && sector.now.lost >= config_.covered_lost &&
         sector.now.returned <= config_.covered_returned * sector.expected.returned;
}

bool Visibility::has_more_alone(const Sector& sector, float share) noexcept {
  return sector.now.alone >= sector.expected.alone + share;
}

bool Visibility::is_fog() const noexcept {
  int far_views = 0, foggy = 0;
  for (const Sector& sector : sectors_) {
    if (!sector.has_view || is_covered(sector) || sector.expected.far < config_.fog_view) continue;
    const float lost_far = sector.expected.far - sector.now.far;
    const bool is_far_lost = sector.now.far <= config_.fog_far * sector.expected.far;
    const bool is_something_near =
        sector.expected.returned - sector.now.returned < config_.fog_lost * lost_far;
    if (is_far_lost && is_something_near) continue;
    ++far_views;
    const bool is_short = sector.now.visible_m < config_.fog_range * sector.expected.visible_m;
    const bool has_droplets = has_more_alone(sector, config_.fog_alone * lost_far);
    foggy += is_far_lost && (is_short || has_droplets) ? 1 : 0;
  }
  return far_views >= config_.fog_fewest &&
         static_cast<float>(foggy) >= config_.fog_sectors * static_cast<float>(far_views);
}

bool Visibility::is_dirt() const noexcept {
  int views = 0, dirty = 0;
  float stuck = 0;
  for (const Sector& sector : sectors_) {
    if (!sector.has_view || is_covered(sector)) continue;
    ++views;
    dirty += sector.now.stuck >= config_.dirt_sector ? 1 : 0;
    stuck += sector.now.stuck;
  }
  return views > 0 && stuck >= config_.dirt_share * static_cast<float>(views) &&
         static_cast<float>(dirty) >= config_.dirt_sectors * static_cast<float>(views);
}

}  // namespace terracut::visibility
