// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// A good DIFOP with any bytes over it: first where to write (two bytes) and how much (one), then
// what, over and over. Angles read from it are the same after writing, and the reader believes none
// that do not validate.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "calib/ruby128/nominal_ruby128.hpp"
#include "firmware_io/ruby128/difop_angles.hpp"
#include "firmware_io/sensor/device_reader.hpp"

namespace {

using namespace terracut;

void check(bool holds) {
  if (!holds) std::abort();
}

void check_packet(const ruby128::ruby128_wire::Difop& difop) {
  const auto calibration = ruby128::calibration_of(difop);
  if (!calibration) return;
  check(validate(*calibration).has_value());
  ruby128::ruby128_wire::Difop written = ruby128::blank_difop();
  ruby128::set_calibration(written, *calibration);
  const auto again = ruby128::read_difop(ruby128::payload_of(written));
  const auto angles = ruby128::calibration_of(*again);
  check(angles.has_value() && angles->channels == calibration->channels);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ruby128::ruby128_wire::Difop good = ruby128::blank_difop();
  ruby128::set_calibration(good, ruby128::nominal_ruby128());
  std::array<std::uint8_t, ruby128::kRubyPacketBytes> bytes;
  std::copy_n(ruby128::payload_of(good).begin(), bytes.size(), bytes.begin());

  sensor::DeviceReader reader;
  reader.add({data, size});
  for (std::size_t i = 0; i + 3 <= size;) {
    const std::size_t at = (data[i] * std::size_t{256} + data[i + 1]) % bytes.size();
    const std::size_t count = std::min({std::size_t{data[i + 2]}, size - i - 3, bytes.size() - at});
    std::copy_n(data + i + 3, count, bytes.begin() + static_cast<std::ptrdiff_t>(at));
    i += 3 + count;
    check(reader.add(bytes) == ruby128::is_difop(bytes));
    if (const auto difop = ruby128::read_difop(bytes)) check_packet(*difop);
  }
  for (const auto model : {sensor::SensorModel::kRs32, sensor::SensorModel::kHelios}) {
    if (const auto& told = reader.calibration(model)) {
      check(validate(std::get<beams::BeamTable>(*told)).has_value());
    }
  }
  return 0;
}
