// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace terracut::stage {

/// Four numbers processed together. Every supported machine has registers of this width (SSE2 and
/// NEON), and each lane gets the same bits as if it were computed alone.
using FourFloats = float __attribute__((vector_size(16)));
using TwoFloats = float __attribute__((vector_size(8)));
/// The result of comparing four lanes: all bits of a lane are set if true, none if false.
using FourInts = std::int32_t __attribute__((vector_size(16)));
/// The same for eight numbers: one register with AVX2, otherwise two. Neither is passed to a
/// function or returned, which machines do differently.
using EightFloats = float __attribute__((vector_size(32)));
using EightInts = std::int32_t __attribute__((vector_size(32)));
inline constexpr std::size_t kEight = 8;

/// Loads from[0] and from[1]; `from` may have any alignment.
[[nodiscard]] inline TwoFloats load_two(const float* from) noexcept {
  TwoFloats two;
  std::memcpy(&two, from, sizeof(two));
  return two;
}
/// Loads from[0] to from[3]; `from` may have any alignment.
[[nodiscard]] inline FourFloats load_four(const float* from) noexcept {
  FourFloats four;
  std::memcpy(&four, from, sizeof(four));
  return four;
}
[[nodiscard]] inline FourFloats square_root(FourFloats four) noexcept {
  return FourFloats{std::sqrt(four[0]), std::sqrt(four[1]), std::sqrt(four[2]), std::sqrt(four[3])};
}
/// True if the mask is set in any lane.
[[nodiscard]] inline bool is_any(FourInts mask) noexcept {
  std::uint64_t halves[2];
  std::memcpy(halves, &mask, sizeof(mask));
  return (halves[0] | halves[1]) != 0;
}
/// Returns `four` where the mask is set, else 0.
[[nodiscard]] inline FourFloats where(FourInts mask, FourFloats four) noexcept {
  FourInts bits;
  std::memcpy(&bits, &four, sizeof(bits));
  bits &= mask;
  std::memcpy(&four, &bits, sizeof(four));
  return four;
}

}  // namespace terracut::stage
