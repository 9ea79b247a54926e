// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>

#include "firmware_io/frame/range_image.hpp"
#include "pipeline/min_cut/direction.hpp"

namespace terracut::min_cut {

/// The state of a cell. Before the min-cut it is one of the first four. Each state has its own bit,
/// so that many cells can be tested at once.
enum class Seed : std::uint8_t {
  kNone = 0,      ///< No return; the hole separates its neighbours.
  kGround = 1,    ///< High-confidence ground: the "background" terminal of paper section III-C.
  kObstacle = 2,  ///< High-confidence obstacle: the "object" terminal.
  kUnknown = 4,   ///< To be labelled by the min-cut.
  // States that the min-cut gives to unknown cells; neighbours treat such cells as seeds.
  kDecided = 8,
  kDecidedGround = kDecided | kGround,  ///< Has the label of a global optimum.
  kDecidedObstacle = kDecided | kObstacle,
  kPinned = 16,
  kPinnedGround = kPinned | kGround,  ///< No node was free: keeps its coarse label.
  kPinnedObstacle = kPinned | kObstacle,
  kWaiting = 32,  ///< Unknown, but not to be cut yet (OpenComponents); separates like kNone.
};

/// Columns of an image, which is a circle: the last column may lie left of the first.
struct ColumnWindow {
  int begin = 0;    ///< In [0, columns of the image).
  int columns = 0;  ///< At most all.

  /// Calls `visit(ColumnRange)` for the columns, from left to right, once or twice.
  template <class Visit>
  [[gnu::always_inline]] void for_each_range(int image_columns, Visit visit) const {
    const int end = begin + columns;
    if (end > image_columns) visit(frame::ColumnRange{0, end - image_columns});
    visit(frame::ColumnRange{begin, end < image_columns ? end : image_columns});
  }
};

/// Calls `visit(index)` for each unknown cell, in order. `visit` may change its own cell. Unknown
/// cells are few and lie together, so 32 cells without one are skipped at once, and others tested
/// by eights.
template <class Visit>
[[gnu::always_inline]] inline void for_each_unknown(std::span<const Seed> seeds, Visit visit) {
  static_assert(std::endian::native == std::endian::little, "the first cell is in the low byte");
  constexpr std::uint64_t kAnyUnknown =
      0x0101'0101'0101'0101 * static_cast<std::uint64_t>(Seed::kUnknown);
  constexpr std::size_t kMost = 32, kEight = 8;
  for (std::size_t first = 0; first < seeds.size(); first += kMost) {
    std::array<std::uint64_t, kMost / kEight> words{};
    if (first + kMost <= seeds.size()) [[likely]] {
      std::memcpy(words.data(), &seeds[first], sizeof(words));
    } else {
      std::memcpy(words.data(), &seeds[first], seeds.size() - first);
    }
    if (((words[0] | words[1] | words[2] | words[3]) & kAnyUnknown) == 0) continue;
    for (std::size_t word = 0; word < words.size(); ++word) {
      for (std::uint64_t left = words[word] & kAnyUnknown; left != 0; left &= left - 1) {
        visit(first + kEight * word + static_cast<std::size_t>(std::countr_zero(left)) / 8);
      }
    }
  }
}

/// Integer capacity of an energy of 1.0. With 1024 the labels equal those of double precision
/// (measured on two scenes; with 256 some labels differ).
inline constexpr int kCapacityScale = 1024;
/// Upper limit of edge weights: twice the largest B of Eq. 14, and low enough that a residual
/// capacity, which can reach 2 * weight, fits 16 bits.
inline constexpr int kMaxEdgeWeight = 2 * kCapacityScale;
/// Costs are clamped to [0, kMaxTerminalCost], also in the reported energy. A cost plus the weights
/// of edges to eight seeds stays far inside 32 bits.
inline constexpr std::int32_t kMaxTerminalCost = 1 << 28;

/// The energy of paper Eq. 6-15 in integers scaled by kCapacityScale, in the caller's memory.
///
/// Planes are row-major with `shape.stride()` and at least `shape.cells()` long; seeds of padding
/// cells (column >= columns) are kNone, `ground_range_m` is read at unknown cells only.
///
///   E(labels) = sum over unknown p of costs(p).<label of p>
///             + sum over 8-neighbours p, q with different labels of weight(p, q)
///
/// Pairs of two hard seeds are not part of E.
struct GridProblem {
  frame::ImageShape shape;                ///< columns >= 3, rows >= 1.
  ColumnWindow window;                    ///< Unknown cells elsewhere are not touched.
  std::span<Seed> seeds;                  ///< Input and output: unknown cells get their result.
  std::span<const float> ground_range_m;  ///< Near cells are solved first.
};

/// Costs of giving a cell either label, scaled by kCapacityScale.
struct LabelCosts {
  std::int32_t ground, obstacle;
};

/// Label costs: costs(cell) is called once for every unknown cell. Must not throw.
template <class C>
concept RegionCosts = std::is_nothrow_invocable_r_v<LabelCosts, const C&, std::uint32_t>;

/// Edge weights, called once for every unknown cell:
///   weights(cell, neighbours, out): out[d] = weight of the edge to neighbours[d], in
///   [0, kMaxEdgeWeight], scaled by kCapacityScale.
/// `out[d]` is ignored if neighbours[d] is a hole or outside the rows (then neighbours[d] == cell).
/// Must be symmetric, bit for bit: the weight from p to q is the weight from q to p; else the cut
/// is not the minimum. Must not throw.
template <class W>
concept EdgeWeights = std::is_nothrow_invocable_v<const W&, std::uint32_t, const NeighbourCells&,
                                                  std::span<std::uint16_t, kDirections>>;

}  // namespace terracut::min_cut
