// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "firmware_io/decode/sensor_trait.hpp"
#include "firmware_io/hdl64e/hdl64e_sensor.hpp"
#include "firmware_io/hesai/hesai_sensor.hpp"
#include "firmware_io/hesai/models.hpp"
#include "firmware_io/ouster/ouster_sensor.hpp"
#include "firmware_io/robosense/models.hpp"
#include "firmware_io/robosense/robosense_sensor.hpp"
#include "firmware_io/ruby128/ruby128_sensor.hpp"
#include "firmware_io/velodyne/models.hpp"
#include "firmware_io/velodyne/velodyne_sensor.hpp"

namespace terracut::decode {

template <SensorTrait... Sensor>
struct SensorList {
  /// `Template` with the sensors of the list as arguments.
  template <template <class...> class Template>
  using In = Template<Sensor...>;

  template <class... More>
  friend SensorList<Sensor..., More...> operator+(SensorList, SensorList<More...>);
};

template <class... Model>
using VelodyneSensors = SensorList<velodyne::VelodyneSensor<Model>...>;
template <class... Model>
using HesaiSensors = SensorList<hesai::HesaiSensor<Model>...>;
template <class... Model>
using RoboSenseSensors = SensorList<robosense::RoboSenseSensor<Model>...>;

template <int... kRows>
using OusterSensors = SensorList<ouster::OusterSensor<kRows>...>;

/// All sensors that are decoded.
using Sensors =
    decltype(SensorList<hdl64e::Hdl64eSensor, ruby128::Ruby128Sensor>{} +
             velodyne::Models::In<VelodyneSensors>{} + hesai::Models::In<HesaiSensors>{} +
             robosense::Models::In<RoboSenseSensors>{} + ouster::Models::In<OusterSensors>{});

}  // namespace terracut::decode
