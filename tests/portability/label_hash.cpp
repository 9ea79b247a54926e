// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Prints a fingerprint of the labels and cut energies of some made-up frames. Everything here is
// plain IEEE arithmetic (no sin, cos or atan2, whose last bit differs between libraries), so that
// the same line must come out on every machine: docs/design.md, promise 5. tools/test --all
// compares x86-64 with AArch64.
#include <cstdint>
#include <cstdio>
#include <limits>

#include "pipeline/ground/segmenter.hpp"

namespace {

using namespace terracut;

constexpr frame::ImageShape kShape{64, 2083};
constexpr double kHeight_m = 1.73;

/// Park and Miller's generator: [0, 1)
class Random {
 public:
  double unit() {
    state_ = state_ * 48271 % 2147483647;
    return static_cast<double>(state_) / 2147483647.0;
  }

 private:
  std::uint64_t state_ = 20260101;
};

/// Down-slope (1 : distance) of row `row`'s beam, from 4 m to far beyond the range limit.
double ground_distance_m(int row) {
  return row < 58 ? 4.0 + 0.03 * row * row : 1e9;
}

mount::RingProfile profile() {
  mount::RingProfile made;
  made.mount.height_m = kHeight_m;
  for (int row = 0; row < kShape.rows; ++row) {
    const double distance_m = ground_distance_m(row);
    const double slope = -kHeight_m / distance_m + (row < 58 ? 0 : 0.005 * (row - 57));
    made.rings.push_back({slope - slope * slope * slope / 3, 0,  // atan, near enough
                          row < 58 ? distance_m : std::numeric_limits<double>::infinity()});
  }
  return made;
}

/// A road between a kerb and rough ground with a hillside, and walls, boxes and bushes where the
/// generator puts them.
void make_frame(Random& random, frame::RangeImage& image) {
  image.clear();
  // The head rotates by a fixed complex factor a column: (cos, sin) of 1 / 2083 of a frame.
  constexpr double kCos = 0.99999545070193, kSin = 0.0030163606178;
  double ahead = 1, left = 0;
  double thing_m = 20, thing_top_m = 1.5;
  for (int column = 0; column < kShape.columns; ++column) {
    if (random.unit() < 0.02) {
      thing_m = 5 + 50 * random.unit();
      thing_top_m = 3 * random.unit() * random.unit();
    }
    for (int row = 0; row < kShape.rows; ++row) {
      if (random.unit() < 0.03) continue;  // nothing came back
      const double slope =
          -kHeight_m / ground_distance_m(row) + (row < 58 ? 0 : 0.005 * (row - 57));
      double range_m = slope < 0 ? kHeight_m / (-slope + (left > 0 ? 0.1 * left : 0)) : 200;
      const double aside_m = range_m * left;
      double z_m = kHeight_m + slope * range_m + (aside_m < 5 ? 0.004 : 0.02) * random.unit() +
                   (aside_m < -7 ? 0.12 : 0);
      const double at_thing_m = kHeight_m + slope * thing_m;
      if (range_m > thing_m && at_thing_m < thing_top_m) {
        range_m = thing_m + 0.05 * random.unit();
        z_m = at_thing_m;
      }
      if (range_m > 110) continue;
      image.place(row, column,
                  {static_cast<float>(range_m * ahead), static_cast<float>(range_m * left),
                   static_cast<float>(z_m), static_cast<float>(range_m), 0});
    }
    const double next_ahead = ahead * kCos - left * kSin;
    left = left * kCos + ahead * kSin;
    ahead = next_ahead;
  }
}

class Fingerprint {
 public:
  void add(std::uint64_t value) { hash_ = (hash_ ^ value) * 1099511628211ULL; }  // FNV-1a
  [[nodiscard]] unsigned long long value() const { return hash_; }

 private:
  std::uint64_t hash_ = 14695981039346656037ULL;
};

}  // namespace

int main() {
  memory::FixedMemory memory;
  frame::RangeImage image(kShape, 1000, memory);
  // With the road surface, whose labels say of all ground what they would without it.
  ground::SegmenterConfig with_road = ground::terracut_profile();
  with_road.road.enabled = true;
  ground::Segmenter terracut(with_road, profile(), kShape, image.return_capacity(), memory);
  ground::Segmenter paper(ground::paper_profile(), profile(), kShape, image.return_capacity(),
                          memory);
  Random random;
  Fingerprint fingerprint;
  std::uint64_t labels = 0, obstacles = 0, unknown = 0, road = 0, other_ground = 0;
  for (int frame = 0; frame < 5; ++frame) {
    make_frame(random, image);
    for (ground::Segmenter* segmenter : {&terracut, &paper}) {
      const auto report = segmenter->segment(image);
      for (const frame::Label label : segmenter->labels()) {
        fingerprint.add(static_cast<std::uint64_t>(label));
        if (segmenter != &terracut) continue;
        road += label == frame::Label::kGround;
        other_ground += label == frame::Label::kOtherGround;
      }
      fingerprint.add(static_cast<std::uint64_t>(report.cut.energy));
      labels += report.returns;
      obstacles += report.obstacles;
      unknown += report.cut.unknown;
    }
  }
  std::printf(
      "%016llx: %llu labels, %llu obstacles, %llu by the cut, %llu road, %llu other ground\n",
      fingerprint.value(), static_cast<unsigned long long>(labels),
      static_cast<unsigned long long>(obstacles), static_cast<unsigned long long>(unknown),
      static_cast<unsigned long long>(road), static_cast<unsigned long long>(other_ground));
  return 0;
}
