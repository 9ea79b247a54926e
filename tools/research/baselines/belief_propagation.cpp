// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "belief_propagation.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace terracut::baselines {

BeliefPropagation::BeliefPropagation(const Shape& shape, memory::FixedMemory& memory)
    : shape_(shape),
      data_cost_(memory.take<float>("belief propagation", shape.nodes() * labels())),
      message_(memory.take<float>("belief propagation", shape.nodes() * labels() * kSides)),
      between_rows_(
          memory.take<StepCost>("belief propagation", static_cast<std::size_t>(shape.rows))),
      within_row_(
          memory.take<StepCost>("belief propagation", static_cast<std::size_t>(shape.rows))),
      label_(memory.take<std::uint8_t>("belief propagation", shape.nodes())) {
  assert(shape.labels >= 2 && shape.labels <= kMaxLabels);
  assert(!shape.cyclic || shape.columns >= 3);
}

void BeliefPropagation::run(int iterations) noexcept {
  std::fill(message_.begin(), message_.end(), 0.0F);
  for (int half = 0; half < 2 * iterations; ++half) {
    for (int row = 0; row < shape_.rows; ++row) {
      for (int column = (row + half) % 2; column < shape_.columns; column += 2) {
        send_all(row, column);
      }
    }
  }
  std::array<float, kMaxLabels> belief{};
  for (std::size_t i = 0; i < label_.size(); ++i) {
    add_up(i, std::span(belief).first(labels()));
    label_[i] = static_cast<std::uint8_t>(least_label(std::span(belief).first(labels())));
  }
}

void BeliefPropagation::add_up(std::size_t node, std::span<float> belief) const noexcept {
  const float* data = data_cost_.data() + node * labels();
  const float* heard = message_.data() + node * labels() * kSides;
  for (std::size_t l = 0; l < belief.size(); ++l) {
    const float* from = heard + l * kSides;
    belief[l] = data[l] + ((from[kBelow] + from[kAbove]) + (from[kLeft] + from[kRight]));
  }
}

/// Sends the messages of a node. To each side: message(x) = min over x' of [belief(x') - the
/// message from that side(x') + cost(x - x')], minus its least value.
void BeliefPropagation::send_all(int row, int column) noexcept {
  const std::size_t here = node(row, column);
  const std::size_t count = labels();
  std::array<float, kMaxLabels> belief{};
  add_up(here, std::span(belief).first(count));
  FourCosts costs{}, wider{};
  const float* heard = message_.data() + here * count * kSides;
  for (std::size_t l = 0; l < count; ++l) {
    for (std::size_t side = 0; side < kSides; ++side) {
      costs[l * kSides + side] = belief[l] - heard[l * kSides + side];
    }
  }

  const auto at = static_cast<std::size_t>(row);
  const StepCost nothing{};
  const StepCost& across = within_row_[at];
  const std::array<const StepCost*, kSides> step{
      row > 0 ? &between_rows_[at - 1] : &nothing,
      row + 1 < shape_.rows ? &between_rows_[at] : &nothing, &across, &across};
  std::array<float, kSides> per_label{};
  int most_free = 0;
  for (std::size_t side = 0; side < kSides; ++side) {
    per_label[side] = step[side]->per_label;
    most_free = std::max(most_free, step[side]->free_labels);
  }
  // Accounts for the free labels: takes the minimum over a window that widens by one label on both
  // sides.
  for (int width = 0; width < most_free; ++width) {
    for (std::size_t l = 0; l < count; ++l) {
      const std::size_t lower = (l == 0 ? l : l - 1) * kSides;
      const std::size_t upper = (l + 1 == count ? l : l + 1) * kSides;
      for (std::size_t side = 0; side < kSides; ++side) {
        const float mine = costs[l * kSides + side];
        const float least = std::min(std::min(costs[lower + side], mine), costs[upper + side]);
        wider[l * kSides + side] = width < step[side]->free_labels ? least : mine;
      }
    }
    std::swap(costs, wider);
  }
  // Lowers each value to at most its neighbour's plus per_label, in one pass up and one pass down.
  for (std::size_t i = kSides; i < count * kSides; i += kSides) {
    for (std::size_t side = 0; side < kSides; ++side) {
      costs[i + side] = std::min(costs[i + side], costs[i - kSides + side] + per_label[side]);
    }
  }
  for (std::size_t i = (count - 1) * kSides; i >= kSides; i -= kSides) {
    for (std::size_t side = 0; side < kSides; ++side) {
      costs[i - kSides + side] =
          std::min(costs[i - kSides + side], costs[i + side] + per_label[side]);
    }
  }

  if (row > 0) deliver(costs, kBelow, step[kBelow]->limit, node(row - 1, column));
  if (row + 1 < shape_.rows) deliver(costs, kAbove, step[kAbove]->limit, node(row + 1, column));
  if (column > 0 || shape_.cyclic) {
    const int left = column > 0 ? column - 1 : shape_.columns - 1;
    deliver(costs, kLeft, across.limit, node(row, left));
  }
  if (column + 1 < shape_.columns || shape_.cyclic) {
    const int right = column + 1 < shape_.columns ? column + 1 : 0;
    deliver(costs, kRight, across.limit, node(row, right));
  }
}

/// Delivers messages to the neighbour on side `to`, which receives them from its opposite side.
void BeliefPropagation::deliver(const FourCosts& costs, Side to, float limit,
                                std::size_t neighbour) noexcept {
  constexpr std::array<Side, kSides> kOpposite{kAbove, kBelow, kRight, kLeft};
  float least = costs[to];  // the passes above keep the least value
  for (std::size_t l = 1; l < labels(); ++l) least = std::min(least, costs[l * kSides + to]);
  float* message = message_.data() + neighbour * labels() * kSides + kOpposite[to];
  for (std::size_t l = 0; l < labels(); ++l) {
    message[l * kSides] = std::min(costs[l * kSides + to] - least, limit);
  }
}

/// Returns the label of the least belief. Within a free slope several labels may be equally good
/// but for rounding; then returns their middle.
int BeliefPropagation::least_label(std::span<const float> belief) const noexcept {
  constexpr float kEqual = 1e-4F;
  const auto least = std::min_element(belief.begin(), belief.end());
  auto last = least;
  while (last + 1 != belief.end() && *(last + 1) <= *least + kEqual) ++last;
  auto first = least;
  while (first != belief.begin() && *(first - 1) <= *least + kEqual) --first;
  return static_cast<int>(((first - belief.begin()) + (last - belief.begin())) / 2);
}

}  // namespace terracut::baselines
