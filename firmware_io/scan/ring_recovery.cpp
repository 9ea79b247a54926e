// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/scan/ring_recovery.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bitset>
#include <limits>
#include <numbers>
#include <utility>

#include "firmware_io/frame/azimuths.hpp"

namespace terracut::scan {
namespace {

constexpr double kHalfRevolution_rad = std::numbers::pi;
constexpr double kJitter_rad = std::numbers::pi / 18;  // see split_into_rings()
/// The azimuth must fall by more than this to begin a new ring of a cropped view, which may hold
/// nothing straight ahead. Jitter within recorded rings makes it fall by 10 degrees at most.
constexpr double kCroppedFall_rad = std::numbers::pi / 9;
constexpr int kMaxSegments = 4 * kScanRings;
// If fewer points come before the first crossing of straight ahead, they belong to the ring after
// it.
constexpr std::size_t kMinFirstRingPoints = 8;

/// Numbers the rings of a file by counting how often the azimuth falls by more than `fall_rad`.
/// If `fall_rad` is half a revolution, it counts how often the azimuth wraps from 2 pi to 0, which
/// is straight ahead.
class FallCounter {
 public:
  explicit FallCounter(double fall_rad) : fall_rad_(fall_rad) {}

  /// Takes the next point's azimuth and returns its ring.
  int ring_at(float azimuth_rad) {
    const double azimuth = 2 * kHalfRevolution_rad - double{azimuth_rad};
    const double counter_clockwise = azimuth < 2 * kHalfRevolution_rad ? azimuth : 0.0;
    if (started_) {
      const double step = counter_clockwise - last_rad_;
      if (step < -fall_rad_) ++ring_;
      const bool back_over_the_seam =
          last_rad_ < kJitter_rad && counter_clockwise > 2 * kHalfRevolution_rad - kJitter_rad;
      if (back_over_the_seam && ring_ > 0) --ring_;
    }
    started_ = true;
    last_rad_ = counter_clockwise;
    return ring_;
  }

 private:
  double fall_rad_;
  bool started_ = false;
  double last_rad_ = 0;
  int ring_ = 0;
};

/// The azimuths at which a segment has points, in coarse steps.
class Directions {
 public:
  void add(const ScanPoint& point) {
    constexpr double kPerRad = kBins / (2 * kHalfRevolution_rad);
    const auto bin = static_cast<std::size_t>(azimuth_rad(point.x_m, point.y_m) * kPerRad);
    seen_.set(std::min(bin, kBins - 1));
  }
  /// True if the azimuths of two segments overlap little, as in two parts of one ring torn by
  /// jitter: a laser sees each azimuth once in a revolution.
  [[nodiscard]] bool may_be_of_one_laser(const Directions& other) const {
    return 4 * (seen_ & other.seen_).count() < std::min(seen_.count(), other.seen_.count());
  }

 private:
  static constexpr std::size_t kBins = 360;
  std::bitset<kBins> seen_;
};

/// The cost of assigning a segment of points to a ring: the angle between the ring's line and the
/// median of the points. Motion compensation moves near points by degrees, but equally many up and
/// down, so the median stays.
class AlignmentCost {
 public:
  static constexpr double kCap_rad = 0.02;
  // The cost of taking two segments for one ring torn in two, which is rare.
  static constexpr double kTorn_rad = 0.001;
  /// Giving two lasers the same ring costs more than moving all others by a ring.
  static constexpr double kSameDirections_rad = kScanRings * kCap_rad;
  /// The most points that one laser gives in a revolution: two returns for each of 4167 firings at
  /// the slowest spin rate. A segment with more points mixes several lasers.
  static constexpr std::size_t kMostPoints = std::size_t{2} * 4167;

  AlignmentCost(std::span<const ScanPoint> points, const RingRecovery& split)
      : cost_(static_cast<std::size_t>(split.rings)),
        points_(cost_.size()),
        directions_(cost_.size()),
        samples_(cost_.size()) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (split.ring_of_point[i] == kNoRing) continue;
      const auto segment = static_cast<std::size_t>(split.ring_of_point[i]);
      ++points_[segment];
      directions_[segment].add(points[i]);
    }
    std::vector<std::size_t> seen(cost_.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (split.ring_of_point[i] == kNoRing) continue;
      const auto segment = static_cast<std::size_t>(split.ring_of_point[i]);
      if (seen[segment]++ % (points_[segment] / kSamples + 1) == 0) {
        samples_[segment].push_back(points[i]);
      }
    }
  }

  void measure(const RingTable& table) {
    std::vector<double> angles;
    for (std::size_t segment = 0; segment < cost_.size(); ++segment) {
      for (std::size_t ring = 0; ring < table.size(); ++ring) {
        angles.clear();
        for (const ScanPoint& p : samples_[segment]) {
          const double distance_m = std::hypot(double{p.x_m}, double{p.y_m}) + 1e-3;
          angles.push_back(table[ring].height_above_m(p) / distance_m);
        }
        cost_[segment][ring] = kCap_rad;
        if (angles.empty() || points_[segment] > kMostPoints) continue;
        const auto middle = angles.begin() + static_cast<std::ptrdiff_t>(angles.size() / 2);
        std::nth_element(angles.begin(), middle, angles.end());
        cost_[segment][ring] = std::min(std::abs(*middle), kCap_rad);
      }
    }
  }

  [[nodiscard]] double off_rad(std::size_t segment, std::size_t ring) const {
    return cost_[segment][ring];
  }
  [[nodiscard]] double points(std::size_t segment) const {
    return static_cast<double>(points_[segment]);
  }
  /// Returns the extra cost of giving a segment the same ring as the previous segment.
  [[nodiscard]] double sharing(std::size_t segment) const {
    const bool torn = directions_[segment].may_be_of_one_laser(directions_[segment - 1]);
    return (torn ? kTorn_rad : kSameDirections_rad) * points(segment);
  }
  [[nodiscard]] std::size_t segments() const { return cost_.size(); }

 private:
  static constexpr std::size_t kSamples = 200;

  std::vector<std::array<double, kScanRings>> cost_;
  std::vector<std::size_t> points_;
  std::vector<Directions> directions_;
  std::vector<std::vector<ScanPoint>> samples_;
};

/// Returns the assignment of segments to rings, in ascending order, with the least sum of angles
/// over all points.
std::vector<int> cheapest_order(const AlignmentCost& cost) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  using Row = std::array<double, kScanRings>;
  using Choice = std::array<std::int16_t, kScanRings>;
  std::vector<Choice> came_from(cost.segments());
  Row best{};
  for (std::size_t segment = 0; segment < cost.segments(); ++segment) {
    Row next{};
    const double sharing = segment == 0 ? kNever : cost.sharing(segment);
    double lowest = segment == 0 ? 0.0 : kNever;  // the best cost that ends on an earlier ring
    std::int16_t lowest_ring = 0;
    for (std::size_t ring = 0; ring < next.size(); ++ring) {
      const double shared = best[ring] + sharing;
      const bool shares = shared < lowest;
      came_from[segment][ring] = shares ? static_cast<std::int16_t>(ring) : lowest_ring;
      next[ring] = std::min(shared, lowest) + cost.off_rad(segment, ring) * cost.points(segment);
      if (segment != 0 && best[ring] < lowest) {
        lowest = best[ring];
        lowest_ring = static_cast<std::int16_t>(ring);
      }
    }
    best = next;
  }
  std::vector<int> ring_of_segment(cost.segments());
  auto ring = static_cast<std::size_t>(std::min_element(best.begin(), best.end()) - best.begin());
  for (std::size_t segment = cost.segments(); segment-- > 0;) {
    ring_of_segment[segment] = static_cast<int>(ring);
    ring = static_cast<std::size_t>(came_from[segment][ring]);
  }
  return ring_of_segment;
}

/// Splits the points where the azimuth falls by more than `fall_rad`.
Status split_at_falls(std::span<const ScanPoint> points, double fall_rad, RingRecovery& recovery) {
  recovery.ring_of_point.resize(points.size());
  recovery.no_ring = 0;
  recovery.rings = 0;
  recovery.aligned = false;
  FallCounter counter(fall_rad);
  std::size_t in_first = 0;
  int last = -1;
  std::array<float, 512> azimuths_rad;  // computed in blocks of so many points
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t in_block = i % azimuths_rad.size();
    if (in_block == 0) {
      frame::find_azimuths(points.subspan(i, std::min(azimuths_rad.size(), points.size() - i)),
                           azimuths_rad);
    }
    if (!is_place(points[i])) {
      recovery.ring_of_point[i] = kNoRing;
      ++recovery.no_ring;
      continue;
    }
    const int ring = counter.ring_at(azimuths_rad[in_block]);
    if (ring >= kMaxSegments) {
      return fail(ErrorCode::kMalformed,
                  fmt::format("more than {} rings by the order of the points, at point {} of {}; "
                              "expected {} rings, one after the other from the top, each counter-"
                              "clockwise from straight ahead, as the original KITTI files are",
                              kMaxSegments, i, points.size(), kScanRings));
    }
    in_first += ring == 0 ? 1U : 0U;
    last = std::max(last, ring);
    recovery.ring_of_point[i] = static_cast<std::int16_t>(ring);
  }
  if (last < 0) {
    return fail(ErrorCode::kMalformed,
                "no point that is finite and not null, so no ring; expected a KITTI scan");
  }
  if (last > 0 && in_first < kMinFirstRingPoints) {  // the file starts just before straight ahead
    for (std::int16_t& ring : recovery.ring_of_point) {
      if (ring > 0) --ring;
    }
    --last;
  }
  recovery.rings = last + 1;
  return {};
}

}  // namespace

Status split_into_rings(std::span<const ScanPoint> points, RingRecovery& recovery) {
  if (const Status split = split_at_falls(points, kHalfRevolution_rad, recovery); !split)
    return split;
  if (recovery.rings == kScanRings) return {};
  RingRecovery cropped;
  const Status split = split_at_falls(points, kCroppedFall_rad, cropped);
  if (split && cropped.rings > recovery.rings) recovery = std::move(cropped);
  return {};
}

Status align_rings(std::span<const ScanPoint> points, const RingTable& table,
                   RingRecovery& recovery) {
  AlignmentCost cost(points, recovery);
  cost.measure(table);
  const std::vector<int> ring_of_segment = cheapest_order(cost);
  recovery.no_ring = 0;
  for (std::int16_t& ring : recovery.ring_of_point) {
    if (ring != kNoRing) {
      const auto segment = static_cast<std::size_t>(ring);
      const int aligned = ring_of_segment[segment];
      const bool fits =
          cost.off_rad(segment, static_cast<std::size_t>(aligned)) < 0.9 * AlignmentCost::kCap_rad;
      ring = fits ? static_cast<std::int16_t>(aligned) : kNoRing;
    }
    if (ring == kNoRing) ++recovery.no_ring;
  }
  const auto places = static_cast<std::size_t>(
      std::count_if(points.begin(), points.end(), [](const ScanPoint& p) { return is_place(p); }));
  const std::size_t with_ring = points.size() - recovery.no_ring;
  if (2 * with_ring < places) {
    return fail(
        ErrorCode::kMalformed,
        fmt::format("{} rings by the order of the points, expected {}; by their elevations the "
                    "laser of only {} of {} points could be told. Expected ring after ring from "
                    "the top, as the original KITTI files are: sort the points so, or, where they "
                    "are, give the unit's own table with --calibration",
                    recovery.rings, kScanRings, with_ring, places));
  }
  recovery.rings = kScanRings;
  recovery.aligned = true;
  return {};
}

Status recover_rings(std::span<const ScanPoint> points, const RingTable* table,
                     RingRecovery& recovery) {
  if (const Status status = split_into_rings(points, recovery); !status) return status;
  if (recovery.rings == kScanRings) return {};
  if (table != nullptr) return align_rings(points, *table, recovery);
  return fail(
      ErrorCode::kUnsupported,
      fmt::format("{} rings by the order of the points, expected {}; a scan with missing or "
                  "torn rings needs a table to align them by: give a calibration",
                  recovery.rings, kScanRings));
}

}  // namespace terracut::scan
