// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// A good DIFOP with any bytes over it: first where to write (two bytes) and how much (one), then
// what, over and over. What is read from it is the same after writing, judgement and error agree,
// and the reader believes no angles that do not validate.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "calib/ruby128/nominal_ruby128.hpp"
#include "firmware_io/sensor/device_reader.hpp"

namespace {

using namespace terracut;

void check(bool holds) {
  if (!holds) std::abort();
}

void check_packet(const ruby128::ruby128_wire::Difop& difop) {
  const ruby128::Ruby128DeviceInfo info = ruby128::device_info_of(difop);
  check(std::all_of(info.gprmc.begin(), info.gprmc.end(),
                    [](char c) { return c >= ' ' && c <= '~'; }));
  const auto calibration = ruby128::calibration_of(difop);
  const ruby128::DifopAngles judgement = ruby128::judge_angles(difop);
  check(calibration.has_value() == (judgement == ruby128::DifopAngles::kPlausible));

  ruby128::ruby128_wire::Difop written = ruby128::blank_difop();
  ruby128::set_device_info(written, info);
  if (calibration) {
    check(validate(*calibration).has_value());
    ruby128::set_calibration(written, *calibration);
  } else {
    check((calibration.error().code == ErrorCode::kNoCalibration) ==
          (judgement == ruby128::DifopAngles::kUnset));
  }
  const auto again = ruby128::read_difop(ruby128::payload_of(written));
  check(again.has_value() && ruby128::device_info_of(*again) == info);
  if (calibration) {
    const auto angles = ruby128::calibration_of(*again);
    check(angles.has_value() && angles->channels == calibration->channels);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ruby128::ruby128_wire::Difop good = ruby128::blank_difop();
  ruby128::set_calibration(good, ruby128::nominal_ruby128());
  std::array<std::uint8_t, ruby128::kRubyPacketBytes> bytes;
  std::copy_n(ruby128::payload_of(good).begin(), bytes.size(), bytes.begin());

  sensor::Ruby128DeviceReader reader;
  reader.add({data, size});
  for (std::size_t i = 0; i + 3 <= size;) {
    const std::size_t at = (data[i] * std::size_t{256} + data[i + 1]) % bytes.size();
    const std::size_t count = std::min({std::size_t{data[i + 2]}, size - i - 3, bytes.size() - at});
    std::copy_n(data + i + 3, count, bytes.begin() + static_cast<std::ptrdiff_t>(at));
    i += 3 + count;
    check(reader.add(bytes) == ruby128::is_difop(bytes));
    if (const auto difop = ruby128::read_difop(bytes)) check_packet(*difop);
  }
  const sensor::Ruby128DeviceCounters& counters = reader.counters();
  check(reader.has_calibration() == reader.calibration().has_value());
  check(reader.has_calibration() ==
        (counters.packets > counters.unset_angles + counters.implausible_angles));
  return 0;
}
