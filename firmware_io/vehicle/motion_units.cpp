// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/vehicle/motion_units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <span>
#include <string>

namespace terracut::vehicle {
namespace {

struct Unit {
  std::string_view name;  ///< Lower case.
  double factor;
};

constexpr double kPerHour = 1000.0 / 3600;
constexpr double kMile = 1609.344 / 3600;
constexpr double kDegree = std::numbers::pi / 180;

constexpr std::array kSpeeds{Unit{"m/s", 1},          Unit{"mps", 1},        Unit{"meters/s", 1},
                             Unit{"km/h", kPerHour},  Unit{"kmh", kPerHour}, Unit{"kph", kPerHour},
                             Unit{"km/hr", kPerHour}, Unit{"mph", kMile},    Unit{"mi/h", kMile}};
// The degree sign is given in UTF-8 and in the Windows code pages in which DBC files are written.
constexpr std::array kYawRates{Unit{"rad/s", 1},
                               Unit{"rad/sec", 1},
                               Unit{"deg/s", kDegree},
                               Unit{"deg/sec", kDegree},
                               Unit{"degree/s", kDegree},
                               Unit{"degrees/s", kDegree},
                               Unit{"\xC2\xB0/s", kDegree},
                               Unit{"\xB0/s", kDegree}};

Expected<double> factor_of(std::span<const Unit> units, std::string_view unit,
                           std::string_view expected) {
  std::string lower;
  for (const char c : unit) {
    if (c == ' ') continue;
    lower += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  const auto found = std::ranges::find(units, lower, &Unit::name);
  if (found != units.end()) return found->factor;
  return fail(ErrorCode::kInvalidArgument,
              unit.empty() ? fmt::format("has no unit; expected {}", expected)
                           : fmt::format("has the unit '{}'; expected {}", unit, expected));
}

}  // namespace

Expected<double> metres_per_second_in(std::string_view unit) {
  return factor_of(kSpeeds, unit, "m/s, km/h or mph");
}

Expected<double> radians_per_second_in(std::string_view unit) {
  return factor_of(kYawRates, unit, "rad/s or deg/s");
}

}  // namespace terracut::vehicle
