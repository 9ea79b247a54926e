// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/sensor/sensor_model.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

namespace terracut::sensor {
namespace {

TEST(SensorTable, HasOneRowForEveryModelWithANameOfItsOwn) {
  std::set<SensorModel> models;
  std::set<std::string_view> names;
  for (const SensorRow& row : kSensorTable) {
    EXPECT_EQ(&row_of(row.model), &row);
    models.insert(row.model);
    names.insert(row.name);
  }
  EXPECT_EQ(models.size(), static_cast<std::size_t>(SensorModel::kOuster128) + 1);
  EXPECT_EQ(names.size(), models.size());
}

TEST(SensorTable, KeepsTheWordsAndTheNumbersOnTheWire) {
  std::map<std::string, int> numbers;
  for (const SensorRow& row : kSensorTable) {
    if (!row.word.empty()) numbers[std::string(row.word)] = row.stream_number;
    EXPECT_EQ(is_decoded(row.model), row.stream_number != 0) << row.name;
  }
  EXPECT_EQ(numbers,
            (std::map<std::string, int>{
                {"hdl64e", 1},       {"ruby128", 2},      {"vlp16", 3},       {"hdl32e", 4},
                {"vlp32c", 5},       {"vls128", 6},       {"pandar40p", 7},   {"pandar64", 8},
                {"pandarqt64", 9},   {"pandarqt128", 10}, {"pandarxt16", 11}, {"pandarxt32", 12},
                {"pandarxt32m", 13}, {"ouster32", 14},    {"ouster64", 15},   {"ouster128", 16},
                {"ot128", 17},       {"pandar128", 18},   {"rs32", 19},       {"helios", 20}}));
}

TEST(SensorTable, TellsModelsApartByWordAndProductNumber) {
  std::multiset<std::string_view> words;
  std::multiset<int> products;
  for (const SensorRow& row : kSensorTable) {
    if (!row.word.empty()) words.insert(row.word);
    if (row.product_number != 0) products.insert(row.product_number);
  }
  for (const std::string_view word : words) EXPECT_EQ(words.count(word), 1U) << word;
  for (const int product : products) EXPECT_EQ(products.count(product), 1U) << product;
}

TEST(SensorTable, ListsTheDecodedModelsOnce) {
  EXPECT_EQ(std::set(kDecodedModels.begin(), kDecodedModels.end()).size(), kDecodedModels.size());
  for (const SensorModel model : kDecodedModels) EXPECT_TRUE(is_decoded(model)) << to_string(model);
  EXPECT_FALSE(is_decoded(SensorModel::kVlp16HiRes));
}

TEST(SensorTable, KnowsTheMakersOfDecodedModels) {
  for (const SensorRow& row : kSensorTable) {
    const auto is_of = [&](std::string_view maker) {
      return is_decoded(row.model) && row.name.find(maker) != std::string_view::npos;
    };
    EXPECT_EQ(is_robosense(row.model), is_of("RoboSense")) << row.name;
    EXPECT_EQ(is_hesai(row.model), is_of("Hesai")) << row.name;
    EXPECT_EQ(is_ouster(row.model), is_of("Ouster")) << row.name;
  }
}

TEST(SensorTable, TakesAnHdl64eOfAnyGenerationForTheOneThatWasAskedFor) {
  EXPECT_TRUE(is_wanted(SensorModel::kHdl64e, SensorModel::kHdl64eS1));
  EXPECT_TRUE(is_wanted({}, SensorModel::kVlp16));
  EXPECT_FALSE(is_wanted(SensorModel::kVlp16, SensorModel::kHdl32e));
  EXPECT_FALSE(is_wanted(SensorModel::kHdl64e, SensorModel::kVlp16HiRes));
  EXPECT_EQ(model_of(sensor_of(SensorModel::kHdl64eS1)), SensorModel::kHdl64e);
}

}  // namespace
}  // namespace terracut::sensor
