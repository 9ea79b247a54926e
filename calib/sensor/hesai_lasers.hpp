// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>

#include "calib/sensor/factory_lasers.hpp"

/// The directions that the manuals give for Hesai's models, by channel. A unit's own, in the CSV
/// file that comes with it, differ by up to a tenth of a degree (docs/reference/sensors.md).
namespace terracut::sensor {

/// Lasers evenly apart, from the highest down.
template <std::size_t kLasers>
[[nodiscard]] constexpr std::array<FactoryLaser, kLasers> even_lasers(double highest_deg,
                                                                      double apart_deg) noexcept {
  std::array<FactoryLaser, kLasers> lasers{};
  for (std::size_t i = 0; i < kLasers; ++i) {
    lasers[i].elevation_deg = highest_deg - apart_deg * static_cast<double>(i);
  }
  return lasers;
}

inline constexpr auto kPandarXt16Lasers = even_lasers<16>(15, 2);
inline constexpr auto kPandarXt32Lasers = even_lasers<32>(15, 1);
inline constexpr auto kPandarXt32mLasers = even_lasers<32>(19.5, 1.3);

inline constexpr std::array<FactoryLaser, 64> kPandar64Lasers = [] {
  constexpr double kElevation_deg[] = {
      14.882, 11.032, 8.059,   5.057,   3.04,    2.028,   1.86,   1.688,   1.522,  1.351,  1.184,
      1.013,  0.846,  0.675,   0.508,   0.337,   0.169,   0,      -0.169,  -0.337, -0.508, -0.675,
      -0.845, -1.013, -1.184,  -1.351,  -1.522,  -1.688,  -1.86,  -2.028,  -2.198, -2.365, -2.536,
      -2.7,   -2.873, -3.04,   -3.21,   -3.375,  -3.548,  -3.712, -3.884,  -4.05,  -4.221, -4.385,
      -4.558, -4.72,  -4.892,  -5.057,  -5.229,  -5.391,  -5.565, -5.726,  -5.898, -6.061, -7.063,
      -8.059, -9.06,  -10.045, -11.032, -12.006, -12.974, -13.93, -18.889, -24.897};
  // The lasers of the dense middle stand in six columns side by side.
  constexpr double kColumn_deg[] = {1.042, 3.125, 5.208, -5.208, -3.125, -1.042};
  constexpr std::size_t kFirstDense = 6, kFirstBelow = 54;
  std::array<FactoryLaser, 64> lasers{};
  for (std::size_t i = 0; i < lasers.size(); ++i) {
    const bool is_dense = i >= kFirstDense && i < kFirstBelow;
    lasers[i] = {kElevation_deg[i], is_dense ? kColumn_deg[(i - kFirstDense) % 6] : -1.042};
  }
  return lasers;
}();

/// Lasers of the Pandar64: in the dense middle every other one.
inline constexpr std::array<FactoryLaser, 40> kPandar40pLasers = [] {
  std::array<FactoryLaser, 40> lasers{};
  for (std::size_t i = 0; i < lasers.size(); ++i) {
    lasers[i] = kPandar64Lasers[i < 6 ? i : i < 30 ? 2 * i - 5 : i + 24];
  }
  return lasers;
}();

inline constexpr std::array<FactoryLaser, 64> kPandarQt64Lasers{{
    {-52.121, 8.736},  {-49.785, 8.314},  {-47.577, 7.964}, {-45.477, 7.669},  {-43.465, 7.417},
    {-41.528, 7.198},  {-39.653, 7.007},  {-37.831, 6.838}, {-36.055, 6.688},  {-34.32, 6.554},
    {-32.619, 6.434},  {-30.95, 6.326},   {-29.308, 6.228}, {-27.69, 6.14},    {-26.094, 6.059},
    {-24.517, 5.987},  {-22.964, -5.27},  {-21.42, -5.216}, {-19.889, -5.167}, {-18.372, -5.123},
    {-16.865, -5.083}, {-15.368, -5.047}, {-13.88, -5.016}, {-12.399, -4.988}, {-10.925, -4.963},
    {-9.457, -4.942},  {-7.994, -4.924},  {-6.535, -4.91},  {-5.079, -4.898},  {-3.626, -4.889},
    {-2.175, -4.884},  {-0.725, -4.881},  {0.725, 5.493},   {2.175, 5.496},    {3.626, 5.502},
    {5.079, 5.512},    {6.534, 5.525},    {7.993, 5.541},   {9.456, 5.561},    {10.923, 5.584},
    {12.397, 5.611},   {13.877, 5.642},   {15.365, 5.676},  {16.861, 5.716},   {18.368, 5.759},
    {19.885, 5.808},   {21.415, 5.862},   {22.959, 5.921},  {24.524, -5.33},   {26.101, -5.396},
    {27.697, -5.469},  {29.315, -5.55},   {30.957, -5.64},  {32.627, -5.74},   {34.328, -5.85},
    {36.064, -5.974},  {37.84, -6.113},   {39.662, -6.269}, {41.537, -6.447},  {43.475, -6.651},
    {45.487, -6.887},  {47.587, -7.163},  {49.795, -7.493}, {52.133, -7.892},
}};

inline constexpr std::array<FactoryLaser, 128> kPandarQt128Lasers = [] {
  constexpr std::array<FactoryLaser, 96> kFirst{{
      {-52.627, 10.108}, {-51.028, 9.72},  {-49.515, 9.384},  {-48.074, 9.091},  {-46.695, 8.833},
      {-45.369, 8.603},  {-44.09, 8.396},  {-42.852, 8.209},  {-41.651, 8.04},   {-40.482, 7.885},
      {-39.343, 7.743},  {-38.231, 7.612}, {-37.143, 7.492},  {-36.076, 7.38},   {-35.03, 7.277},
      {-34.002, 7.18},   {-32.992, 7.09},  {-31.996, 7.006},  {-31.015, 6.928},  {-30.048, 6.854},
      {-29.093, 6.785},  {-28.149, 6.721}, {-27.216, 6.66},   {-26.292, 6.602},  {-25.378, 6.549},
      {-24.473, 6.498},  {-23.575, 6.45},  {-22.685, 6.405},  {-21.802, 6.363},  {-20.926, 6.323},
      {-20.056, 6.285},  {-19.191, 6.25},  {-18.331, -6.217}, {-17.477, -6.186}, {-16.627, -6.157},
      {-15.781, -6.129}, {-14.94, -6.104}, {-14.102, -6.08},  {-13.268, -6.057}, {-12.436, -6.037},
      {-11.608, -6.018}, {-10.783, -6},    {-9.96, -5.984},   {-9.139, -5.969},  {-8.32, -5.955},
      {-7.503, -5.943},  {-6.688, -5.927}, {-5.874, -5.923},  {-5.061, -5.915},  {-4.25, -5.908},
      {-3.439, -5.902},  {-2.63, -5.897},  {-1.82, -5.894},   {-1.012, -5.892},  {-0.203, -5.891},
      {0.606, -5.891},   {1.414, -5.893},  {2.223, -5.896},   {3.033, -5.899},   {3.843, -5.905},
      {4.654, -5.911},   {5.466, -5.919},  {6.279, -5.927},   {7.094, -5.938},   {7.91, 5.949},
      {8.728, 5.962},    {9.547, 5.976},   {10.369, 5.992},   {11.194, 6.008},   {12.02, 6.027},
      {12.85, 6.047},    {13.683, 6.068},  {14.519, 6.091},   {15.359, 6.116},   {16.202, 6.143},
      {17.05, 6.171},    {17.902, 6.201},  {18.759, 6.233},   {19.621, 6.267},   {20.488, 6.304},
      {21.362, 6.343},   {22.241, 6.384},  {23.128, 6.427},   {24.022, 6.474},   {24.923, 6.523},
      {25.833, 6.575},   {26.751, 6.631},  {27.679, 6.69},    {28.618, 6.752},   {29.567, 6.819},
      {30.528, 6.89},    {31.502, 6.966},  {32.49, 7.047},    {33.493, 7.134},   {34.512, 7.227},
      {35.549, 7.327},
  }};
  std::array<FactoryLaser, 128> lasers{};
  for (std::size_t i = 0; i < kFirst.size(); ++i) lasers[i] = kFirst[i];
  // The last 32 mirror the first.
  for (std::size_t i = 0; i < 32; ++i) {
    lasers[127 - i] = {-kFirst[i].elevation_deg, -kFirst[i].azimuth_offset_deg};
  }
  return lasers;
}();

}  // namespace terracut::sensor
