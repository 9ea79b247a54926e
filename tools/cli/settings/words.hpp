// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "tools/cli/options.hpp"

/// The words for the values of settings that allow only a few values.
namespace terracut::cli {

template <class Value>
struct Word {
  std::string_view name;
  Value value;
};

/// "auto", then the word of each sensor that has one.
inline constexpr auto kSensorWords = [] {
  constexpr auto kHasWord = [](const sensor::SensorRow& row) { return !row.word.empty(); };
  std::array<Word<std::optional<sensor::SensorModel>>,
             1 + std::ranges::count_if(sensor::kSensorTable, kHasWord)>
      words{};
  words[0] = {"auto", std::nullopt};
  std::size_t count = 1;
  for (const sensor::SensorRow& row : sensor::kSensorTable) {
    if (kHasWord(row)) words[count++] = {row.word, row.model};
  }
  return words;
}();
inline constexpr std::array kCellOwnerWords{
    Word{"strongest", frame::CellOwner::kStrongest}, Word{"last", frame::CellOwner::kFarthest},
    Word{"first", frame::CellOwner::kNearest}, Word{"both", frame::CellOwner::kFirstArrived}};
inline constexpr std::array kTimestampWords{Word{"calendar", ruby128::RubyTimestamp::kCalendar},
                                            Word{"us", ruby128::RubyTimestamp::kUtcMicroseconds},
                                            Word{"ns", ruby128::RubyTimestamp::kUtcNanoseconds}};
inline constexpr std::array kAnyTimestampWords{
    Word<std::optional<ruby128::RubyTimestamp>>{"auto", std::nullopt},
    Word<std::optional<ruby128::RubyTimestamp>>{"calendar", ruby128::RubyTimestamp::kCalendar},
    Word<std::optional<ruby128::RubyTimestamp>>{"us", ruby128::RubyTimestamp::kUtcMicroseconds},
    Word<std::optional<ruby128::RubyTimestamp>>{"ns", ruby128::RubyTimestamp::kUtcNanoseconds}};
inline constexpr std::array kGeometryWords{Word{"manual", hdl64e::GeometryModel::kManual},
                                           Word{"ros", hdl64e::GeometryModel::kRosLike}};
inline constexpr std::array kProfileWords{Word{"paper", Profile::kPaper},
                                          Word{"terracut", Profile::kTerracut}};
inline constexpr std::array kStageWords{Word{"elevation", stage::Stage::kElevationMap},
                                        Word{"adjacent", stage::Stage::kAdjacentPoints},
                                        Word{"mrf", stage::Stage::kMinCut}};
inline constexpr std::array kViaWords{Word{"socket", ListenVia::kSocket},
                                      Word{"libpcap", ListenVia::kLibpcap}};
inline constexpr std::array kInstantWords{Word{"start", frame::FrameInstant::kStart},
                                          Word{"middle", frame::FrameInstant::kMiddle},
                                          Word{"end", frame::FrameInstant::kEnd}};
inline constexpr std::array kReturnsWords{Word{"single", packets::ReturnMode::kSingle},
                                          Word{"dual", packets::ReturnMode::kDual}};
inline constexpr std::array kProductWords{Word{"os0", ouster::Product::kOs0},
                                          Word{"os1", ouster::Product::kOs1},
                                          Word{"os2", ouster::Product::kOs2}};
inline constexpr std::array kStreamModeWords{
    Word{"600", ::mode_t{0600}}, Word{"660", ::mode_t{0660}}, Word{"666", ::mode_t{0666}}};
inline constexpr std::array kFormatWords{Word{"labels", FleetFormat::kLabels},
                                         Word{"mcap", FleetFormat::kMcap}};
inline constexpr std::array kMcapCloudsWords{Word{"all", McapClouds::kAll},
                                             Word{"points", McapClouds::kPoints}};
inline constexpr std::array kDdsPresetWords{Word{"ros", DdsPreset::kRos},
                                            Word{"autoware", DdsPreset::kAutoware},
                                            Word{"nav2", DdsPreset::kNav2}};
inline constexpr std::array kThroughWords{Word<std::optional<bool>>{"image", false},
                                          Word<std::optional<bool>>{"packets", true}};

// Words of settings whose values are stored as texts in Options.
using TextWord = Word<std::string_view>;
inline constexpr std::array kSpeedUnitWords{TextWord{"file", ""}, TextWord{"m/s", "m/s"},
                                            TextWord{"km/h", "km/h"}, TextWord{"mph", "mph"}};
inline constexpr std::array kYawRateUnitWords{TextWord{"file", ""}, TextWord{"rad/s", "rad/s"},
                                              TextWord{"deg/s", "deg/s"}};

/// Returns the word for a value; empty if there is none.
template <class Words, class Value>
[[nodiscard]] constexpr std::string_view word_of(const Words& words, const Value& value) {
  const auto found = std::ranges::find_if(words, [&](const auto& w) { return w.value == value; });
  return found == words.end() ? std::string_view() : found->name;
}

}  // namespace terracut::cli
