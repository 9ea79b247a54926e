// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Clouds to labels through the library's public call: a point's label is the same however its cloud
// is fed.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "calib/beams/angle.hpp"
#include "firmware_io/scan/kitti_scan.hpp"
#include "firmware_io/scan/ring_recovery.hpp"
#include "terracut/segmenter.hpp"
#include "tests/firmware_io/scan/recorded_sequences.hpp"
#include "tests/firmware_io/scan/synthetic_scan.hpp"
#include "tests/support/allocation_counter.hpp"

namespace terracut::whole_way {
namespace {

using testing::Contains;
using testing::HasSubstr;

/// A cloud in KITTI's order, and the ring of each point from the top.
struct OrderedCloud {
  std::vector<CloudPoint> points;
  std::vector<std::uint16_t> ring;
  int rings = 0;
};

OrderedCloud ordered_cloud(const std::vector<scan::ScanPoint>& points) {
  scan::RingRecovery rings;
  EXPECT_TRUE(scan::split_into_rings(points, rings));
  OrderedCloud cloud;
  for (std::size_t i = 0; i < points.size(); ++i) {
    cloud.points.push_back({points[i].x_m, points[i].y_m, points[i].z_m, points[i].remission});
    cloud.ring.push_back(static_cast<std::uint16_t>(rings.ring_of_point[i]));
  }
  cloud.rings = rings.rings;
  return cloud;
}

/// Walls and flat ground as a sensor sees them whose beams start at the origin, unevenly apart.
OrderedCloud synthetic_cloud(int rings, double ground_m = -1.73) {
  scan::RingTable table;
  double elevation_deg = 8;
  for (int ring = 0; ring < rings; ++ring) {
    table.push_back({beams::deg_to_rad(elevation_deg), 0});
    elevation_deg -= (ring % 3 == 0 ? 1.4 : 0.8) * 32 / rings;
  }
  return ordered_cloud(synthetic::scan(table, {.ground_m = ground_m, .points_per_ring = 1800}));
}

std::vector<Label> labels_of(Segmenter& segmenter, const Cloud& cloud) {
  const auto labels = segmenter.label(cloud);
  EXPECT_TRUE(labels) << labels.error().message;
  if (!labels) return {};
  return {labels->begin(), labels->end()};
}

Segmenter new_segmenter() {
  return Segmenter::make({.mount = {.height_m = 1.73}}).value();
}

std::vector<Label> labels_of(const Cloud& cloud) {
  Segmenter segmenter = new_segmenter();
  return labels_of(segmenter, cloud);
}

std::vector<std::size_t> shuffled_order(std::size_t count) {
  std::vector<std::size_t> order(count);
  for (std::size_t i = 0; i < count; ++i) order[i] = i;
  std::ranges::shuffle(order, std::mt19937(7));
  return order;
}

template <class T>
std::vector<T> in_order(const std::vector<T>& values, const std::vector<std::size_t>& order) {
  std::vector<T> ordered;
  for (const std::size_t i : order) ordered.push_back(values[i]);
  return ordered;
}

void expect_the_same_labels_by_number_organised_and_with_points_that_are_no_returns(
    const OrderedCloud& cloud, const std::vector<Label>& expected) {
  EXPECT_THAT(expected, Contains(Label::kGround));
  EXPECT_THAT(expected, Contains(Label::kObstacle));
  EXPECT_EQ(labels_of({cloud.points, cloud.ring}), expected) << "with the laser's number";
  const auto order = shuffled_order(cloud.points.size());
  EXPECT_EQ(labels_of({in_order(cloud.points, order), in_order(cloud.ring, order)}),
            in_order(expected, order))
      << "shuffled, with the laser's number";

  // Organised: as many points in each row, those that are missing NaN.
  std::vector<std::size_t> in_ring(static_cast<std::size_t>(cloud.rings));
  for (const std::uint16_t ring : cloud.ring) ++in_ring[ring];
  const std::size_t width = std::ranges::max(in_ring);
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  std::vector<CloudPoint> organised(width * in_ring.size(), {kNan, kNan, kNan, 0});
  std::vector<Label> with_none(organised.size(), Label::kNone);
  std::ranges::fill(in_ring, 0U);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const std::size_t at = cloud.ring[i] * width + in_ring[cloud.ring[i]]++;
    organised[at] = cloud.points[i];
    with_none[at] = expected[i];
  }
  EXPECT_EQ(labels_of({organised, {}, in_ring.size()}), with_none) << "organised";
}

TEST(CloudsLabelled, GiveAPointTheSameLabelHoweverTheyAreFed) {
  for (const int rings : {16, 32, 64}) {
    const OrderedCloud cloud = synthetic_cloud(rings);
    const std::vector<Label> expected = labels_of({cloud.points});
    expect_the_same_labels_by_number_organised_and_with_points_that_are_no_returns(cloud, expected);
    const auto order = shuffled_order(cloud.points.size());
    EXPECT_EQ(labels_of({in_order(cloud.points, order)}), in_order(expected, order)) << "shuffled";
  }
}

TEST(CloudsLabelled, OfRecordedScansGiveAPointTheSameLabelHoweverTheyAreFed) {
  TERRACUT_RECORDED_SEQUENCES(sequences);
  for (const auto& sequence : sequences) {
    scan::KittiScan scan;
    ASSERT_TRUE(scan::read_kitti_scan(sequence / "velodyne" / "000000.bin", scan));
    const OrderedCloud cloud = ordered_cloud(scan.points);
    ASSERT_EQ(cloud.rings, 64) << sequence;
    const std::vector<Label> expected = labels_of({cloud.points});
    expect_the_same_labels_by_number_organised_and_with_points_that_are_no_returns(cloud, expected);
    // Compensated for motion, points lie beside their rings' lines: without order and numbers some
    // come to a neighbouring row.
    const auto order = shuffled_order(cloud.points.size());
    const auto shuffled = labels_of({in_order(cloud.points, order)});
    ASSERT_EQ(shuffled.size(), expected.size());
    std::size_t same = 0;
    for (std::size_t i = 0; i < order.size(); ++i) same += shuffled[i] == expected[order[i]];
    EXPECT_GT(static_cast<double>(same) / static_cast<double>(order.size()), 0.985) << sequence;
  }
}

TEST(CloudsLabelled, OfASensorUpsideDownGetTheLabelsOfOneThatStands) {
  for (const int rings : {16, 64}) {
    const OrderedCloud cloud = synthetic_cloud(rings);
    const std::vector<Label> expected = labels_of({cloud.points, cloud.ring});
    OrderedCloud hanging = cloud;
    for (CloudPoint& p : hanging.points) p = {p.x_m, -p.y_m, -p.z_m, p.remission};
    for (auto& ring : hanging.ring) ring = static_cast<std::uint16_t>(rings - 1 - ring);
    Segmenter stated =
        Segmenter::make({.mount = {.height_m = 1.73, .roll_rad = std::numbers::pi}}).value();
    EXPECT_EQ(labels_of(stated, {hanging.points, hanging.ring}), expected);
  }
}

/// Points of a layout as a driver has them in its memory.
class DriverMemory {
 public:
  DriverMemory(std::vector<PointField> fields, std::size_t point_step)
      : fields_(std::move(fields)), point_step_(point_step) {}

  void add(const CloudPoint& point, std::uint16_t ring) {
    data_.resize(data_.size() + point_step_, std::byte{0xA5});
    for (const PointField& field : fields_) {
      if (field.name == "x") put(field, double{point.x_m});
      if (field.name == "y") put(field, double{point.y_m});
      if (field.name == "z") put(field, double{point.z_m});
      if (field.name == "ring" || field.name == "channel") put(field, ring);
    }
  }
  [[nodiscard]] PointBuffer buffer() const {
    return {data_, fields_, point_step_, data_.size() / point_step_};
  }

 private:
  void put(const PointField& field, double value) {
    std::byte* at = &data_[data_.size() - point_step_ + field.offset];
    const auto write = [&](auto number) { std::memcpy(at, &number, sizeof(number)); };
    if (field.type == FieldType::kUint8) write(static_cast<std::uint8_t>(value));
    if (field.type == FieldType::kUint16) write(static_cast<std::uint16_t>(value));
    if (field.type == FieldType::kFloat32) write(static_cast<float>(value));
    if (field.type == FieldType::kFloat64) write(value);
  }

  std::vector<PointField> fields_;
  std::size_t point_step_;
  std::vector<std::byte> data_;
};

using F = FieldType;
const std::vector<PointField> kXyzirc{{"x", 0},
                                      {"y", 4},
                                      {"z", 8},
                                      {"intensity", 12, F::kUint8},
                                      {"return_type", 13, F::kUint8},
                                      {"channel", 14, F::kUint16}};
const std::vector<PointField> kXyzircaedt{{"x", 0},
                                          {"y", 4},
                                          {"z", 8},
                                          {"intensity", 12, F::kUint8},
                                          {"return_type", 13, F::kUint8},
                                          {"channel", 14, F::kUint16},
                                          {"azimuth", 16},
                                          {"elevation", 20},
                                          {"distance", 24},
                                          {"time_stamp", 28, F::kUint32}};
const std::vector<PointField> kXyzirt{
    {"x", 0}, {"y", 4}, {"z", 8}, {"intensity", 12}, {"ring", 16, F::kUint16}, {"time", 18}};
const std::vector<PointField> kOuster{{"x", 0},
                                      {"y", 4},
                                      {"z", 8},
                                      {"intensity", 16},
                                      {"t", 20, F::kUint32},
                                      {"reflectivity", 24, F::kUint16},
                                      {"ring", 26, F::kUint16},
                                      {"ambient", 28, F::kUint16},
                                      {"range", 32, F::kUint32}};
const std::vector<PointField> kDoubles{
    {"x", 0, F::kFloat64}, {"y", 8, F::kFloat64}, {"z", 16, F::kFloat64}, {"ring", 24, F::kUint8}};

TEST(CloudsLabelled, InTheLayoutsOfDriversGetTheSameLabels) {
  const OrderedCloud cloud = synthetic_cloud(32);
  const std::vector<Label> expected = labels_of({cloud.points});
  const std::pair<std::vector<PointField>, std::size_t> layouts[] = {
      {kXyzirc, 16}, {kXyzircaedt, 32}, {kXyzirt, 22}, {kOuster, 48}, {kDoubles, 25}};
  for (const auto& [fields, point_step] : layouts) {
    DriverMemory memory(fields, point_step);
    for (std::size_t i = 0; i < cloud.points.size(); ++i)
      memory.add(cloud.points[i], cloud.ring[i]);
    Segmenter segmenter = new_segmenter();
    const auto labels = segmenter.label(memory.buffer());
    ASSERT_TRUE(labels) << labels.error().message;
    EXPECT_EQ(std::vector(labels->begin(), labels->end()), expected) << fields.size() << " fields";
  }
}

TEST(CloudsLabelled, InMemoryThatIsNotWhatIsSaidOfItAreRefused) {
  DriverMemory memory(kXyzirc, 16);
  for (int i = 0; i < 4; ++i) memory.add({1, 1, 1, 0}, 300);
  Segmenter segmenter = new_segmenter();
  const auto error_of = [&](auto change) {
    PointBuffer buffer = memory.buffer();
    change(buffer);
    const auto labels = segmenter.label(buffer);
    return labels ? std::string("none") : labels.error().message;
  };
  EXPECT_THAT(error_of([](PointBuffer&) {}), HasSubstr("channel of point 0 is 300"));
  EXPECT_THAT(error_of([](PointBuffer& b) { b.width = 5; }), HasSubstr("do not hold"));
  EXPECT_THAT(error_of([](PointBuffer& b) { b.height = 2; }), HasSubstr("do not hold"));
  EXPECT_THAT(error_of([](PointBuffer& b) { b.row_step = 32; }), HasSubstr("do not hold"));
  EXPECT_THAT(error_of([](PointBuffer& b) { b.width = std::size_t{1} << 61; }),
              HasSubstr("a frame has at most"));
  EXPECT_THAT(error_of([](PointBuffer& b) { b.width = 0; }), HasSubstr("1 rows of 0 points"));
  EXPECT_THAT(error_of([](PointBuffer& b) { b.point_step = 15; }), HasSubstr("field channel"));
  EXPECT_THAT(error_of([](PointBuffer& b) { b.point_step = 0; }), HasSubstr("field x"));
  EXPECT_THAT(error_of([](PointBuffer& b) { b.fields = b.fields.subspan(1); }),
              HasSubstr("no field x, y or z"));
  const PointField unknown[] = {{"x", 0, static_cast<FieldType>(9)}, {"y", 4}, {"z", 8}};
  EXPECT_THAT(error_of([&](PointBuffer& b) { b.fields = unknown; }), HasSubstr("type 9"));
}

TEST(CloudsLabelled, AreRefusedWithoutHarmToThoseThatFollow) {
  const OrderedCloud cloud = synthetic_cloud(32);
  Segmenter segmenter = new_segmenter();
  const Cloud good{cloud.points, cloud.ring};
  EXPECT_EQ(segmenter.label(Cloud{cloud.points, cloud.ring, 7}).error().code,
            ErrorCode::kMalformed);
  const auto expected = labels_of(segmenter, good);
  EXPECT_EQ(segmenter.label(Cloud{cloud.points}).error().code, ErrorCode::kMalformed);
  std::vector<CloudPoint> many = cloud.points;
  while (many.size() <= 2 * std::max<std::size_t>(cloud.points.size(), 32 * 1808)) {
    many.insert(many.end(), cloud.points.begin(), cloud.points.end());
  }
  const std::vector<std::uint16_t> ring(many.size());
  EXPECT_EQ(segmenter.label(Cloud{many, ring}).error().code, ErrorCode::kCapacityExceeded);
  EXPECT_EQ(labels_of(segmenter, good), expected);
}

TEST(CloudsLabelled, ByAFoundMountGetTheLabelsOfThatMountStated) {
  const OrderedCloud first = synthetic_cloud(64, -1.10), other = synthetic_cloud(64, -1.14);
  Segmenter finds = Segmenter::make({.find_mount = true}).value();
  EXPECT_FALSE(finds.found_mount());
  const auto expect_as_stated = [&](const OrderedCloud& cloud, double height_m,
                                    std::size_t frames) {
    const std::vector<Label> labels = labels_of(finds, {cloud.points});
    const auto found = finds.found_mount();
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->mount.height_m, height_m, 0.005);
    EXPECT_GT(found->uncertainty.height_m, 0.0);
    EXPECT_EQ(found->frames, frames);
    Segmenter stated = Segmenter::make({.mount = found->mount}).value();
    (void)labels_of(stated, {first.points});  // the rows are those of the first cloud
    EXPECT_EQ(labels_of(stated, {cloud.points}), labels);
  };
  expect_as_stated(first, 1.10, 1);
  for (int cloud = 2; cloud <= 9; ++cloud) expect_as_stated(other, 1.10, 1);
  expect_as_stated(other, 1.14, 10);
  expect_as_stated(first, 1.14, 10);
}

/// Walls all around, 2.5 m away: nothing of the ground is seen from 3 m on.
OrderedCloud without_ground(OrderedCloud cloud) {
  for (CloudPoint& point : cloud.points) {
    const float shrink = 2.5F / std::max(2.5F, std::hypot(point.x_m, point.y_m));
    point = {point.x_m * shrink, point.y_m * shrink, point.z_m * shrink, 0};
  }
  return cloud;
}

TEST(CloudsLabelled, WithoutGroundBeforeTheSensorAreRefusedUntilItIsSeen) {
  const OrderedCloud ground = synthetic_cloud(32), none = without_ground(ground);
  Segmenter finds = Segmenter::make({.mount = {.height_m = 1.9}, .find_mount = true}).value();
  for (int cloud = 0; cloud < 25; ++cloud) {
    const auto labels = finds.label(Cloud{none.points, none.ring});
    ASSERT_FALSE(labels);
    EXPECT_EQ(labels.error().code, ErrorCode::kMountNotFound);
    EXPECT_THAT(labels.error().message, HasSubstr("guess_mount"));
    EXPECT_FALSE(finds.found_mount());
  }
  for (int cloud = 0; cloud < 20; ++cloud) (void)finds.label(Cloud{ground.points, ground.ring});
  ASSERT_TRUE(finds.found_mount());
  EXPECT_NEAR(finds.found_mount()->mount.height_m, 1.73, 0.02);
}

TEST(CloudsLabelled, WithoutGroundBeforeTheSensorAreLabelledByTheGivenMountWhereThatMayBeGuessed) {
  const OrderedCloud cloud = without_ground(synthetic_cloud(32));
  Segmenter finds =
      Segmenter::make({.mount = {.height_m = 1.9}, .find_mount = true, .guess_mount = true})
          .value();
  Segmenter stated = Segmenter::make({.mount = {.height_m = 1.9}}).value();
  const Cloud view{cloud.points, cloud.ring};
  EXPECT_EQ(labels_of(finds, view), labels_of(stated, view));
  EXPECT_FALSE(finds.found_mount());
}

TEST(CloudsLabelled, AfterTheFirstAllocateNothing) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "a sanitizer has its own allocator";
  for (const int rings : {16, 64}) {
    const OrderedCloud cloud = synthetic_cloud(rings);
    // As many as the first, and more.
    std::vector<CloudPoint> more = cloud.points;
    std::vector<std::uint16_t> ring = cloud.ring;
    more.insert(more.end(), cloud.points.begin(), cloud.points.begin() + 5000);
    ring.insert(ring.end(), cloud.ring.begin(), cloud.ring.begin() + 5000);
    DriverMemory memory(kXyzirc, 16);
    for (std::size_t i = 0; i < more.size(); ++i) memory.add(more[i], ring[i]);
    const PointBuffer buffer = memory.buffer();
    for (const bool in_order : {true, false}) {
      Segmenter segmenter = new_segmenter();
      ASSERT_TRUE(
          segmenter.label(in_order ? Cloud{cloud.points} : Cloud{cloud.points, cloud.ring}));
      const std::uint64_t before = test::allocations_of_this_thread();
      const bool labelled = in_order ? segmenter.label(cloud.points).has_value()
                                     : segmenter.label(Cloud{more, ring}).has_value() &&
                                           segmenter.label(buffer).has_value();
      EXPECT_EQ(test::allocations_of_this_thread(), before) << rings << " rings";
      EXPECT_TRUE(labelled);
    }
  }
}

}  // namespace
}  // namespace terracut::whole_way
