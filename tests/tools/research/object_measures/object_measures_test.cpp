// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include "tools/research/object_measures/entropies.hpp"
#include "tools/research/object_measures/instances.hpp"
#include "tools/research/object_measures/true_objects.hpp"

namespace terracut::object_measures {
namespace {

using Numbers = std::vector<std::uint32_t>;
constexpr double kLog2 = std::numbers::ln2;

/// Returns side by side along x, and their labels.
struct Returns {
  std::vector<Place> places;
  Numbers labels;

  void add(int count, std::uint32_t label, float from_x_m, float step_m = 0.1F, float y_m = 0) {
    for (int i = 0; i < count; ++i) {
      places.push_back({from_x_m + static_cast<float>(i) * step_m, y_m, 0});
      labels.push_back(label);
    }
  }
};

std::size_t objects_of(const Returns& returns) {
  const Numbers objects = true_objects(returns.places, returns.labels);
  std::set<std::uint32_t> numbers(objects.begin(), objects.end());
  numbers.erase(0);
  return numbers.size();
}

TEST(Entropies, AreNothingWhereObjectsAreTheTrueOnes) {
  const Entropies same = entropies(Numbers{1, 1, 2, 0}, Numbers{7, 7, 3, 0});
  EXPECT_DOUBLE_EQ(same.over_segmentation, 0);
  EXPECT_DOUBLE_EQ(same.under_segmentation, 0);
}

TEST(Entropies, OfATrueObjectInHalvesIsLogTwo) {
  const Entropies halves = entropies(Numbers{1, 1, 1, 1}, Numbers{1, 1, 2, 2});
  EXPECT_NEAR(halves.over_segmentation, kLog2, 1e-12);
  EXPECT_DOUBLE_EQ(halves.under_segmentation, 0);
}

TEST(Entropies, CountWhatIsNotFoundAsAPart) {
  const Entropies half_found = entropies(Numbers{1, 1, 1, 1}, Numbers{1, 1, 0, 0});
  EXPECT_NEAR(half_found.over_segmentation, kLog2, 1e-12);
  EXPECT_DOUBLE_EQ(half_found.under_segmentation, 0);
}

TEST(Entropies, CountWhatIsNoTrueObjectAsAPartOfAFoundOne) {
  const Entropies mixed = entropies(Numbers{1, 0, 0, 0}, Numbers{1, 1, 1, 1});
  EXPECT_DOUBLE_EQ(mixed.over_segmentation, 0);
  EXPECT_NEAR(mixed.under_segmentation, 2 * kLog2 - 0.75 * std::log(3), 1e-12);
  const Entropies outside = entropies(Numbers{0, 0}, Numbers{1, 1});
  EXPECT_DOUBLE_EQ(outside.under_segmentation, 0) << "no true object is in it";
}

TEST(Entropies, AddUpOverObjects) {
  const Entropies two = entropies(Numbers{1, 1, 2, 2}, Numbers{1, 2, 3, 4});
  EXPECT_NEAR(two.over_segmentation, 2 * kLog2, 1e-12);
  const Entropies joined = entropies(Numbers{1, 2, 3, 4}, Numbers{1, 1, 2, 2});
  EXPECT_NEAR(joined.under_segmentation, 2 * kLog2, 1e-12);
}

TEST(TrueObjects, HaveTenReturnsLessThanAMetreApart) {
  Returns chain;
  chain.add(10, 70, 0, 0.95F);
  EXPECT_EQ(objects_of(chain), 1U);
  Returns short_chain;
  short_chain.add(9, 70, 0, 0.95F);
  EXPECT_EQ(objects_of(short_chain), 0U);
  Returns apart;
  apart.add(10, 70, 0);
  apart.add(10, 70, 1.95F);
  EXPECT_EQ(objects_of(apart), 2U);
}

TEST(TrueObjects, HaveOneClassAndInstanceAndAreNoGround) {
  Returns returns;
  returns.add(10, 70, 0);
  returns.add(10, 50, 0, 0.1F, 0.2F);
  EXPECT_EQ(objects_of(returns), 2U) << "a house behind a bush";
  returns.add(10, 10 | 1U << 16, 20);
  returns.add(10, 10 | 2U << 16, 20, 0.1F, 0.5F);
  EXPECT_EQ(objects_of(returns), 4U) << "two parked cars";
  for (const std::uint32_t no_object : {0U, 40U, 44U, 48U, 49U, 60U, 72U})
    returns.add(20, no_object, 40);
  EXPECT_EQ(objects_of(returns), 4U);
}

TEST(Instances, AreFoundByMoreThanHalfOfBoth) {
  constexpr std::uint32_t kCar = 10 | 1U << 16, kPerson = 254 | 2U << 16;
  Returns returns;
  returns.add(20, kCar, 10);
  returns.add(10, kPerson, 30);
  Numbers found(30, 1);
  std::fill(found.begin() + 20, found.end(), 0);
  const InstancesByKind only_car = compare_instances(returns.places, returns.labels, found);
  EXPECT_EQ(only_car.of(Kind::kCar).found, 1U);
  EXPECT_EQ(only_car.counts[0][0].found, 1U) << "nearer than 20 m";
  EXPECT_EQ(only_car.counts[1][1].missed, 1U) << "20 to 40 m";
  EXPECT_DOUBLE_EQ(only_car.of(Kind::kCar).panoptic_quality(), 1);
  EXPECT_DOUBLE_EQ(only_car.all().panoptic_quality(), 1 / 1.5);
  EXPECT_DOUBLE_EQ(only_car.all().recall(), 0.5);

  const Numbers joined(30, 1);  // 20 of 30 are the car's
  const InstancesByKind as_one = compare_instances(returns.places, returns.labels, joined);
  EXPECT_DOUBLE_EQ(as_one.of(Kind::kCar).iou_sum, 20.0 / 30);
  EXPECT_EQ(as_one.all().false_objects, 0U);
}

TEST(Instances, InPartsAreMissedAndTheirPartsFalse) {
  Returns returns;
  returns.add(20, 10 | 1U << 16, 10);
  Numbers found(20, 1);
  std::fill(found.begin() + 10, found.end(), 2);
  const InstanceCounts counts = compare_instances(returns.places, returns.labels, found).all();
  EXPECT_EQ(counts.missed, 1U);
  EXPECT_EQ(counts.false_objects, 2U);
  EXPECT_DOUBLE_EQ(counts.panoptic_quality(), 0);
}

TEST(Instances, AreNotJudgedByReturnsOfUnknownTruth) {
  Returns returns;
  returns.add(20, 10 | 1U << 16, 10);
  returns.add(30, 0, 12);             // unlabelled
  returns.add(30, 30, 15);            // a person without a number
  returns.add(9, 30 | 2U << 16, 20);  // too few returns
  const Numbers as_one(returns.labels.size(), 1);
  const InstanceCounts counts = compare_instances(returns.places, returns.labels, as_one).all();
  EXPECT_EQ(counts.found, 1U);
  EXPECT_DOUBLE_EQ(counts.iou_sum, 1);
  returns.add(60, 50, 30);  // a house, which is known to be no car
  const Numbers with_house(returns.labels.size(), 1);
  EXPECT_EQ(compare_instances(returns.places, returns.labels, with_house).all().missed, 1U);
}

}  // namespace
}  // namespace terracut::object_measures
