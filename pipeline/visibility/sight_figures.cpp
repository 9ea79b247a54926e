// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "sight_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace terracut::visibility {
namespace {

bool is_troubled(const SightFigures::Sector& sector) noexcept {
  return sector.condition.state != State::kClear;
}

/// Returns "ahead left" for kAheadLeft.
std::string words_of(Direction direction) {
  std::string words(to_string(direction));
  std::ranges::replace(words, '_', ' ');
  return words;
}

/// Returns the directions of the sectors that are in a condition: "ahead left and left".
std::string directions_text(const SightFigures& figures, const Condition& condition) {
  std::array<bool, kDirections> has{};
  for (std::size_t i = 0; i < kSectors; ++i) {
    const bool is_there = figures.sectors[i].condition == condition;
    has[static_cast<std::size_t>(direction_of(i))] |= is_there;
  }
  // Directions stand side by side, clockwise: the first is one whose left neighbour is clear.
  std::size_t first = 0;
  while (first + 1 < kDirections && (!has[first] || has[(first + kDirections - 1) % kDirections])) {
    ++first;
  }
  std::vector<std::string> words;
  for (std::size_t i = 0; i < kDirections; ++i) {
    const std::size_t direction = (first + i) % kDirections;
    if (has[direction]) words.push_back(words_of(static_cast<Direction>(direction)));
  }
  if (words.size() < 2) return words.empty() ? std::string() : words.front();
  const std::string last = words.back();
  words.pop_back();
  return fmt::format("{} and {}", fmt::join(words, ", "), last);
}

std::string text_of(const SightFigures& figures, const Condition& condition) {
  const auto sectors =
      std::ranges::count(figures.sectors, condition, &SightFigures::Sector::condition);
  const auto views = std::ranges::count_if(
      figures.sectors, [](const SightFigures::Sector& sector) { return sector.has_view != 0; });
  const std::string what =
      fmt::format("{}, {}", to_string(condition.state), to_string(condition.cause));
  if (sectors >= views) return what + ": all around";
  return fmt::format("{}: {} sector{}, {}", what, sectors, sectors == 1 ? "" : "s",
                     directions_text(figures, condition));
}

}  // namespace

SightFigures::Of SightFigures::in(Direction direction) const noexcept {
  Of of;
  std::array<float, kSectors> visible_m{};
  for (std::size_t i = 0; i < kSectors; ++i) {
    const Sector& sector = sectors[i];
    if (direction_of(i) != direction) continue;
    of.troubled += is_troubled(sector) ? 1 : 0;
    if (sector.has_view == 0) continue;
    visible_m[static_cast<std::size_t>(of.with_view++)] = sector.visible_m;
  }
  if (of.with_view == 0) return of;
  const auto end = visible_m.begin() + of.with_view,
             middle = visible_m.begin() + (of.with_view - 1) / 2;
  std::nth_element(visible_m.begin(), middle, end);
  of.visible_m = *middle;
  return of;
}

std::string sight_text(const SightFigures& figures) {
  if (figures.has_learnt == 0) return "learning";
  std::vector<Condition> conditions;
  for (const SightFigures::Sector& sector : figures.sectors) {
    const bool is_known = std::ranges::find(conditions, sector.condition) != conditions.end();
    if (is_troubled(sector) && !is_known) conditions.push_back(sector.condition);
  }
  if (conditions.empty()) return "clear";
  std::ranges::sort(conditions, is_worse);
  std::string text;
  for (const Condition& condition : conditions) {
    text += (text.empty() ? "" : "; ") + text_of(figures, condition);
  }
  return text;
}

}  // namespace terracut::visibility
