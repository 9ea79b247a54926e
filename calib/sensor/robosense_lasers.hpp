// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>

#include "calib/sensor/factory_lasers.hpp"

/// Directions of RoboSense's models with 32 lasers, by channel, for simulated units. A real unit's
/// own are in its DIFOP packets and in the file that comes with it; they differ by up to degrees
/// (docs/reference/sensors.md).
namespace terracut::sensor {

/// A unit's table that the maker's driver is shipped with.
inline constexpr std::array<FactoryLaser, 32> kRs32Lasers{{
    {-10.264, 9.121}, {0.297, -7.12},   {-6.406, 8.911},  {-0.018, -1.778},  {2.279, 9.121},
    {-0.333, 3.572},  {3.297, -6.838},  {-0.667, 8.786},  {4.614, 9.121},    {1.685, -7.156},
    {7.018, -6.767},  {1.297, -1.814},  {10.298, 9.051},  {1, 3.486},        {15.017, -6.944},
    {0.703, 8.901},   {-25, -6.697},    {-2.279, -7.332}, {-14.638, -6.661}, {-2.667, -2},
    {-7.91, -6.767},  {-3.018, 3.393},  {-5.407, -6.838}, {-3.297, 8.806},   {-3.649, -7.191},
    {-1.018, -7.297}, {-4.053, -1.864}, {-1.333, -1.814}, {-4.386, 3.493},   {-1.631, 3.572},
    {-4.649, 8.806},  {-1.982, 8.731},
}};

/// The elevations in the manual of the RS-Helios-5515; azimuth offsets are each unit's own.
inline constexpr std::array<FactoryLaser, 32> kHeliosLasers{{
    {15},    {13},  {11},    {9},     {7},   {5.5}, {4},   {2.67}, {1.33}, {0},   {-1.33},
    {-2.67}, {-4},  {-5.33}, {-6.67}, {-8},  {-10}, {-13}, {-16},  {-19},  {-22}, {-25},
    {-28},   {-31}, {-34},   {-37},   {-40}, {-43}, {-46}, {-49},  {-52},  {-55},
}};

}  // namespace terracut::sensor
