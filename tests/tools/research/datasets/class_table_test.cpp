// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/research/datasets/built_in_tables.hpp"

#include <gmock/gmock.h>

#include "tools/lab/quality/quality.hpp"

namespace terracut::datasets {
namespace {

using testing::HasSubstr;

std::string refusal(const std::string& text) {
  const auto table = ClassTable::parse(text, "t.yaml");
  return table ? "" : table.error().message;
}

TEST(ClassTableTest, OfSemanticKittiSaysWhatThePipelinesOwnMeasuresSay) {
  const auto table = built_in_table("semantickitti");
  ASSERT_TRUE(table) << table.error().message;
  EXPECT_EQ(table->entries().size(), 34U);
  for (const ClassEntry& entry : table->entries()) {
    EXPECT_EQ(entry.role(GroundDefinition::kAll), quality::truth_class(entry.id)) << entry.name;
    EXPECT_EQ(entry.role(GroundDefinition::kRoad) == Role::kGround, entry.id == 40) << entry.name;
    EXPECT_EQ(entry.vegetation, entry.id == 70) << entry.name;
  }
}

TEST(ClassTableTest, OfKoblenzMergesAsThePaperDoes) {
  const auto table = built_in_table("koblenz");
  ASSERT_TRUE(table) << table.error().message;
  const auto role = [&](std::uint16_t id) {
    return table->find(id)->role(GroundDefinition::kRoad);
  };
  EXPECT_EQ(role(1), Role::kGround);            // Street
  EXPECT_EQ(role(2), Role::kOrdinaryObstacle);  // Rough
  EXPECT_EQ(role(3), Role::kKeyObstacle);       // Obstacle
}

TEST(ClassTableTest, FindsNothingUnderAnUnknownId) {
  const auto table = ClassTable::parse("classes: [{id: 5, name: a, all: key, road: key}]", "t");
  ASSERT_TRUE(table);
  EXPECT_EQ(table->find(5)->name, "a");
  EXPECT_EQ(table->find(4), nullptr);
  EXPECT_EQ(table->find(6), nullptr);
}

TEST(ClassTableTest, RefusesByLineWhatItCannotRead) {
  EXPECT_THAT(refusal("nonsense"), HasSubstr("classes"));
  EXPECT_THAT(refusal("classes: []"), HasSubstr("classes"));
  EXPECT_THAT(refusal("classes:\n  - {id: 70000, name: a, all: key, road: key}"),
              HasSubstr("t.yaml: line 2: expected an id from 0 to 65535, found '70000'"));
  EXPECT_THAT(refusal("classes:\n  - {id: 1, name: a, all: grass, road: key}"),
              HasSubstr("line 2: expected ground, ordinary, key or ignored, found 'grass'"));
  EXPECT_THAT(refusal("classes:\n  - {id: 1, name: a, all: key, road: key, colour: red}"),
              HasSubstr("there is no key 'colour'"));
  EXPECT_THAT(refusal("classes:\n  - {id: 1, name: a, all: key}"), HasSubstr("needs id, name"));
  EXPECT_THAT(refusal("classes:\n  - {id: 1, name: a, all: key, road: key}\n"
                      "  - {id: 1, name: b, all: key, road: key}"),
              HasSubstr("line 3: class 1 stands here a second time"));
}

TEST(ClassTableTest, NamesTheFileThatIsMissing) {
  const auto table = ClassTable::read("no/such/table.yaml");
  ASSERT_FALSE(table);
  EXPECT_THAT(table.error().message, HasSubstr("no/such/table.yaml"));
}

}  // namespace
}  // namespace terracut::datasets
