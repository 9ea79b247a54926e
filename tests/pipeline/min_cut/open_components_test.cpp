// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/min_cut/open_components.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

namespace terracut::min_cut {
namespace {

/// Columns [begin, begin + count) of the circle, as a mark for each column.
std::vector<bool> columns_in(const ColumnWindow& window, int columns) {
  std::vector<bool> is_in(static_cast<std::size_t>(columns));
  for (int i = 0; i < window.columns; ++i) {
    is_in[static_cast<std::size_t>((window.begin + i) % columns)] = true;
  }
  return is_in;
}

/// An image of seeds, drawn with the highest row first: '?' unknown, '.' a seed.
struct Drawn {
  explicit Drawn(const std::vector<std::string>& rows)
      : shape{static_cast<int>(rows.size()), static_cast<int>(rows[0].size())},
        seeds(shape.cells(), Seed::kNone),
        open(shape, 100, memory) {
    for (int row = 0; row < shape.rows; ++row) {
      for (int column = 0; column < shape.columns; ++column) {
        const char drawn =
            rows[rows.size() - 1 - static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
        seeds[shape.cell(row, column)] = drawn == '?' ? Seed::kUnknown : Seed::kGround;
      }
    }
  }
  [[nodiscard]] std::string states() const {
    std::string drawn;
    for (int row = shape.rows - 1; row >= 0; --row) {
      for (int column = 0; column < shape.columns; ++column) {
        const Seed seed = seeds[shape.cell(row, column)];
        drawn += seed == Seed::kUnknown ? '?' : seed == Seed::kWaiting ? 'w' : '.';
      }
      drawn += ' ';
    }
    return drawn;
  }
  frame::ImageShape shape;
  std::vector<Seed> seeds;
  memory::FixedMemory memory;
  OpenComponents open;
};

TEST(OpenComponents, AComponentIsClosedByAColumnItDoesNotReach) {
  Drawn image({"..?....................",  //
               ".?..?.................."});
  image.open.begin(0);
  EXPECT_EQ(image.open.take(3, image.seeds).cells, 0U);
  EXPECT_EQ(image.states().substr(0, 6), "..w...");
  EXPECT_EQ(image.open.waiting_columns(), 2);
  const OpenComponents::Released released = image.open.take(1, image.seeds);
  EXPECT_EQ(released.cells, 2U);
  EXPECT_EQ(released.cells_open, 0U);
  EXPECT_EQ(released.window.begin, 1);
  EXPECT_EQ(released.window.columns, 2);
  EXPECT_EQ(image.open.waiting_columns(), 0);
  EXPECT_EQ(image.states().substr(0, 6), "..?...");
}

TEST(OpenComponents, TwoOpenOnesThatMeetAreClosedTogether) {
  Drawn image({"???.....................................",  //
               "..?.....................................",  //
               "???....................................?"});
  image.open.begin(39);
  EXPECT_EQ(image.open.take(3, image.seeds).cells, 0U) << "columns 39, 0 and 1: two components";
  EXPECT_EQ(image.open.waiting_columns(), 3);
  EXPECT_EQ(image.open.take(2, image.seeds).cells, 8U);
}

TEST(OpenComponents, OneThatStaysOpenForAnEighthOfTheCircleIsReleasedAsItIs) {
  Drawn image({"................????????????????????????",  //
               "........................................"});
  image.open.begin(0);
  EXPECT_EQ(image.open.take(21, image.seeds).cells, 0U);
  const OpenComponents::Released released = image.open.take(1, image.seeds);
  EXPECT_EQ(released.cells, 6U);
  EXPECT_EQ(released.cells_open, 6U);
  EXPECT_EQ(released.window.begin, 16);
  EXPECT_EQ(released.window.columns, 6);
  EXPECT_EQ(image.open.take(5, image.seeds).cells, 0U) << "what comes then begins anew";
}

TEST(OpenComponents, AreAllReleasedWhereNoMoreColumnsCome) {
  Drawn image({"..?....?", "........"});
  image.open.begin(0);
  (void)image.open.take(8, image.seeds);
  const OpenComponents::Released released = image.open.release_all(image.seeds);
  EXPECT_EQ(released.cells, 1U);
  EXPECT_EQ(released.cells_open, 1U);
  EXPECT_EQ(released.window.begin, 7);
}

TEST(OpenComponents, KnowNothingAfterBeginOfWhatWaitedBefore) {
  Drawn image({".......????????.", "................"});
  image.open.begin(0);
  (void)image.open.take(8, image.seeds);
  image.open.begin(8);
  EXPECT_EQ(image.open.take(1, image.seeds).cells, 0U);
  EXPECT_EQ(image.open.waiting_columns(), 1);
}

TEST(OpenComponents, HaveRoomForSoManyCellsAndNoMore) {
  Drawn image({"................????............", "................................"});
  OpenComponents small(image.shape, 10, image.memory);
  small.begin(0);
  EXPECT_TRUE(small.has_room(5));
  EXPECT_FALSE(small.has_room(6));
  EXPECT_EQ(small.most_at_once(), 2);
  for (int column = 0; column < 18; column += 2) (void)small.take(2, image.seeds);
  EXPECT_FALSE(small.has_room(5)) << "two wait";
  EXPECT_TRUE(small.has_room(4));
}

/// The component of each unknown cell, by flood; -1 for others.
std::vector<int> flooded(const frame::ImageShape& shape, const std::vector<Seed>& seeds) {
  std::vector<int> component(seeds.size(), -1);
  int count = 0;
  for (std::size_t cell = 0; cell < seeds.size(); ++cell) {
    if (seeds[cell] != Seed::kUnknown || component[cell] >= 0) continue;
    std::vector<std::size_t> left{cell};
    component[cell] = count;
    while (!left.empty()) {
      const auto at = left.back();
      left.pop_back();
      const auto stride = static_cast<std::size_t>(shape.stride());
      for (const std::uint32_t other :
           neighbour_cells(shape, static_cast<int>(at / stride), static_cast<int>(at % stride))) {
        if (seeds[other] != Seed::kUnknown || component[other] >= 0) continue;
        component[other] = count;
        left.push_back(other);
      }
    }
    ++count;
  }
  return component;
}

TEST(OpenComponents, OfRandomTurnsEachIsReleasedWholeAndNoLaterThanItCanBe) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 200; ++trial) {
    // A long image is unrolled from several turns of the circle.
    const frame::ImageShape circle{1 + static_cast<int>(random() % 9U),
                                   16 + static_cast<int>(random() % 60U)};
    const frame::ImageShape unrolled{circle.rows, 4 * circle.columns};
    const auto density = 1 + random() % 45U;
    std::vector<Seed> all(unrolled.cells(), Seed::kNone), seeds(circle.cells(), Seed::kNone);
    for (int row = 0; row < unrolled.rows; ++row) {
      for (int column = 0; column < unrolled.columns; ++column) {
        all[unrolled.cell(row, column)] =
            random() % 100U < density ? Seed::kUnknown : Seed::kObstacle;
      }
      // No component lies across the ends.
      all[unrolled.cell(row, unrolled.columns - 1)] = Seed::kObstacle;
    }
    const std::vector<int> component = flooded(unrolled, all);
    std::vector<int> last(component.size(), -1), first(component.size(), unrolled.columns);
    const auto for_each_cell = [&](auto visit) {
      for (int column = 0; column < unrolled.columns; ++column) {
        for (int row = 0; row < unrolled.rows; ++row) {
          const int of = component[unrolled.cell(row, column)];
          if (of >= 0) visit(row, column, static_cast<std::size_t>(of));
        }
      }
    };
    for_each_cell([&](int, int column, std::size_t of) {
      last[of] = std::max(last[of], column);
      first[of] = std::min(first[of], column);
    });
    memory::FixedMemory memory;
    OpenComponents open(circle, 2 * circle.cells(), memory);
    open.begin(0);
    std::vector<bool> is_released(unrolled.cells());
    std::vector<bool> was_cut_open(component.size());
    for (int taken = 0; taken < unrolled.columns;) {
      const int count = std::min(1 + static_cast<int>(random() % 9U), unrolled.columns - taken);
      for (int column = taken; column < taken + count; ++column) {
        for (int row = 0; row < circle.rows; ++row) {
          seeds[circle.cell(row, column % circle.columns)] = all[unrolled.cell(row, column)];
        }
      }
      ASSERT_TRUE(open.has_room(count));
      const OpenComponents::Released released = open.take(count, seeds);
      taken += count;
      const std::vector<bool> is_in = columns_in(released.window, circle.columns);
      std::uint32_t cells = 0;
      for_each_cell([&](int row, int column, std::size_t of) {
        if (column >= taken || is_released[unrolled.cell(row, column)] ||
            column < taken - circle.columns) {
          return;
        }
        const bool is_closed = last[of] < taken - 1;
        Seed& seed = seeds[circle.cell(row, column % circle.columns)];
        if (seed == Seed::kWaiting) {
          // A component of which a part was cut open may be in two or more pieces.
          ASSERT_TRUE(!is_closed || was_cut_open[of]) << "released too late";
          ASSERT_GE(column, taken - open.waiting_columns());
          return;
        }
        ASSERT_EQ(seed, Seed::kUnknown);
        ASSERT_TRUE(is_in[static_cast<std::size_t>(column % circle.columns)]);
        is_released[unrolled.cell(row, column)] = true;
        seed = Seed::kDecidedGround;
        ++cells;
        if (is_closed) return;
        EXPECT_GT(taken - first[of], circle.columns / 8) << "released too soon";
        was_cut_open[of] = true;
      });
      ASSERT_EQ(cells, released.cells);
    }
    for_each_cell([&](int row, int column, std::size_t) {
      EXPECT_TRUE(is_released[unrolled.cell(row, column)]) << column;
    });
  }
}

}  // namespace
}  // namespace terracut::min_cut
