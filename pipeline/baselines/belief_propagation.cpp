// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/baselines/belief_propagation.hpp"

#include <algorithm>
#include <cassert>
#include <cstdlib>

namespace terracut::pipeline {

BeliefPropagation::BeliefPropagation(const Shape& shape, rt::FixedMemory& memory)
    : shape_(shape),
      data_cost_(memory.take<float>("belief propagation", shape.nodes() * labels())),
      message_(memory.take<float>("belief propagation", shape.nodes() * labels() * kDirections)),
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
  Costs belief{};
  for (std::size_t i = 0; i < label_.size(); ++i) {
    add_up(i, belief);
    const auto end = belief.begin() + shape_.labels;
    label_[i] = static_cast<std::uint8_t>(std::min_element(belief.begin(), end) - belief.begin());
  }
}

void BeliefPropagation::add_up(std::size_t node, Costs& belief) noexcept {
  const float* data = data_cost_.data() + node * labels();
  const float* below = message(kBelow, node);
  const float* above = message(kAbove, node);
  const float* left = message(kLeft, node);
  const float* right = message(kRight, node);
  for (std::size_t l = 0; l < labels(); ++l) {
    belief[l] = data[l] + ((below[l] + above[l]) + (left[l] + right[l]));
  }
}

void BeliefPropagation::send_all(int row, int column) noexcept {
  Costs belief{};
  const std::size_t here = node(row, column);
  add_up(here, belief);
  if (row > 0) {
    send(belief, message(kBelow, here), between_rows_[static_cast<std::size_t>(row - 1)],
         message(kAbove, node(row - 1, column)));
  }
  if (row + 1 < shape_.rows) {
    send(belief, message(kAbove, here), between_rows_[static_cast<std::size_t>(row)],
         message(kBelow, node(row + 1, column)));
  }
  const StepCost& across = within_row_[static_cast<std::size_t>(row)];
  if (column > 0 || shape_.cyclic) {
    const int left = column > 0 ? column - 1 : shape_.columns - 1;
    send(belief, message(kLeft, here), across, message(kRight, node(row, left)));
  }
  if (column + 1 < shape_.columns || shape_.cyclic) {
    const int right = column + 1 < shape_.columns ? column + 1 : 0;
    send(belief, message(kRight, here), across, message(kLeft, node(row, right)));
  }
}

/// message(x) = min over x' of [belief(x') - heard_from_it(x') + cost(x - x')], less its minimum.
void BeliefPropagation::send(const Costs& belief, const float* heard_from_it, const StepCost& cost,
                             float* message) const noexcept {
  const std::size_t count = labels();
  Costs here{};
  for (std::size_t l = 0; l < count; ++l) here[l] = belief[l] - heard_from_it[l];
  const float least = *std::min_element(here.begin(), here.begin() + shape_.labels);

  // What is free to reach: the least of a window, one label wider on both sides each time.
  Costs wider{};
  for (int step = 0; step < cost.free_labels; ++step) {
    wider[0] = std::min(here[0], here[1]);
    wider[count - 1] = std::min(here[count - 2], here[count - 1]);
    for (std::size_t l = 1; l + 1 < count; ++l) {
      wider[l] = std::min(std::min(here[l - 1], here[l]), here[l + 1]);
    }
    here = wider;
  }
  // Cones of slope per_label on top of every value: one pass up, one down.
  for (std::size_t l = 1; l < count; ++l) {
    here[l] = std::min(here[l], here[l - 1] + cost.per_label);
  }
  for (std::size_t l = count - 1; l-- > 0;) {
    here[l] = std::min(here[l], here[l + 1] + cost.per_label);
  }
  for (std::size_t l = 0; l < count; ++l) {
    message[l] = std::min(here[l] - least, cost.limit);
  }
}

double BeliefPropagation::energy() const noexcept {
  const auto step = [](const StepCost& cost, int from, int to) noexcept {
    const int paid = std::max(0, std::abs(to - from) - cost.free_labels);
    return std::min(cost.limit, cost.per_label * static_cast<float>(paid));
  };
  double sum = 0;
  for (int row = 0; row < shape_.rows; ++row) {
    for (int column = 0; column < shape_.columns; ++column) {
      const int here = label(row, column);
      sum += data_cost_[node(row, column) * labels() + static_cast<std::size_t>(here)];
      if (row + 1 < shape_.rows) {
        sum += step(between_rows_[static_cast<std::size_t>(row)], here, label(row + 1, column));
      }
      const bool last = column + 1 == shape_.columns;
      if (!last || shape_.cyclic) {
        sum += step(within_row_[static_cast<std::size_t>(row)], here,
                    label(row, last ? 0 : column + 1));
      }
    }
  }
  return sum;
}

}  // namespace terracut::pipeline
