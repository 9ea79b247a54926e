// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/lab/send/fault_script.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace terracut::test {
namespace {

using send::Fault;
using send::FaultKind;
using send::parse_fault_script;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::int64_t kSecond_ns = 1'000'000'000;

TEST(FaultScript, KnowsEveryKindOfFault) {
  const auto script = parse_fault_script(
      "loss@2.5s:20packets reorder@4s:3, duplicate@4.5s:1packet;pause@5s:0.4s burst@6000ms:50ms\n"
      "foreign@7:50 truncate@9s:5 clock@8s:+2.0s clock@10s:-150ms");
  ASSERT_TRUE(script) << script.error().message;
  EXPECT_THAT(*script, ElementsAre(Fault{FaultKind::kLoss, 2'500'000'000, 20, 0},
                                   Fault{FaultKind::kReorder, 4 * kSecond_ns, 3, 0},
                                   Fault{FaultKind::kDuplicate, 4'500'000'000, 1, 0},
                                   Fault{FaultKind::kPause, 5 * kSecond_ns, 0, 400'000'000},
                                   Fault{FaultKind::kBurst, 6 * kSecond_ns, 0, 50'000'000},
                                   Fault{FaultKind::kForeign, 7 * kSecond_ns, 50, 0},
                                   Fault{FaultKind::kTruncate, 9 * kSecond_ns, 5, 0},
                                   Fault{FaultKind::kClock, 8 * kSecond_ns, 0, 2 * kSecond_ns},
                                   Fault{FaultKind::kClock, 10 * kSecond_ns, 0, -150'000'000}));
}

TEST(FaultScript, MayBeEmpty) {
  EXPECT_TRUE(parse_fault_script("")->empty());
  EXPECT_TRUE(parse_fault_script(" ,; \n")->empty());
}

TEST(FaultScript, IsWrittenAsItIsRead) {
  const auto script = parse_fault_script(
      "loss@2.5s:20 reorder@0s:3 pause@5.000001s:0.4s burst@6s:50ms clock@8s:+2s clock@9s:-1ms "
      "foreign@7s:50 truncate@9s:5 duplicate@1e3s:1000000000");
  ASSERT_TRUE(script) << script.error().message;
  for (const Fault& fault : *script) {
    EXPECT_THAT(*parse_fault_script(to_string(fault)), ElementsAre(fault)) << to_string(fault);
  }
  EXPECT_EQ(to_string(script->front()), "loss@2.5s:20packets");
}

TEST(FaultScript, WithAMistakeNamesTheFaultAndWhatIsExpected) {
  const auto expect_refusal = [](const std::string& fault, const std::string& expected) {
    const auto script = parse_fault_script("loss@1s:1 " + fault + " pause@5s:1s");
    ASSERT_FALSE(script) << fault;
    EXPECT_EQ(script.error().code, ErrorCode::kInvalidArgument);
    EXPECT_THAT(script.error().message, AllOf(HasSubstr("'" + fault + "'"), HasSubstr(expected)));
  };
  expect_refusal("loss", "KIND@TIME:AMOUNT");
  expect_refusal("loss@2s", "KIND@TIME:AMOUNT");
  expect_refusal("loss:20", "KIND@TIME:AMOUNT");
  expect_refusal("lose@2s:20", "loss, reorder, duplicate");
  expect_refusal("@2s:20", "loss, reorder, duplicate");
  expect_refusal("loss@:20", "a time");
  expect_refusal("loss@-2s:20", "a time");
  expect_refusal("loss@2min:20", "a time");
  expect_refusal("loss@nans:20", "a time");
  expect_refusal("loss@infs:20", "a time");
  expect_refusal("loss@1e9s:20", "a time");
  expect_refusal("loss@2s:", "number of packets");
  expect_refusal("loss@2s:0", "number of packets");
  expect_refusal("loss@2s:-3", "number of packets");
  expect_refusal("loss@2s:0.4s", "number of packets");
  expect_refusal("loss@2s:99999999999999999999", "number of packets");
  expect_refusal("pause@2s:20packets", "a duration");
  expect_refusal("pause@2s:0s", "a duration");
  expect_refusal("burst@2s:-1s", "a duration");
  expect_refusal("clock@2s:2s", "sign");
  expect_refusal("clock@2s:+0s", "sign");
  expect_refusal("clock@2s:+-2s", "sign");
  expect_refusal("clock@2s:+", "sign");
}

}  // namespace
}  // namespace terracut::test
