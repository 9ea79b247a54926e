// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rotating_head.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace terracut::reference {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr double kRadPerDeg = std::numbers::pi / 180.0;
/// 2026-01-01 00:59:59.9 UTC, so that the HDL-64E's hour ends in the stream.
constexpr std::int64_t kStart_ns = 1'767'229'199'900'000'000;

void put_little(Bytes& bytes, std::size_t at, std::uint64_t value, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) bytes[at + i] = (value >> (8 * i)) & 0xFF;
}
void put_big(Bytes& bytes, std::size_t at, std::uint64_t value, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) bytes[at + i] = (value >> (8 * (count - 1 - i))) & 0xFF;
}

/// The azimuth of a firing as a head's encoder gives it, hundredths of a degree.
unsigned azimuth_cdeg(const RotatingHead& head, std::int64_t firing, double firing_s) {
  const double rotated_deg = 360.0 * head.spin_hz * firing_s * static_cast<double>(firing);
  return static_cast<unsigned>(std::llround((head.first_deg + rotated_deg) * 100.0) % 36'000);
}

std::size_t hdl64e_return_at(int column, int laser) {
  return static_cast<std::size_t>(100 * (2 * column + laser / 32) + 4 + 3 * (laser % 32));
}
std::size_t ruby128_return_at(int column, int laser) {
  return static_cast<std::size_t>(80 + 388 * column + 4 + 3 * laser);
}

}  // namespace

std::vector<Payload> hdl64e_payloads(const RotatingHead& head) {
  std::mt19937 random(head.seed);
  std::bernoulli_distribution measured(head.share_of_returns);
  std::uniform_int_distribution<unsigned> distance(1, 65'535), intensity(0, 255);
  const int firings_per_packet = head.dual_return ? 3 : 6;
  const std::int64_t firing_ns = head.dual_return ? 57'600 : 48'000;
  std::vector<Payload> payloads(static_cast<std::size_t>(head.packets));
  for (std::size_t n = 0; n < payloads.size(); ++n) {
    Bytes& bytes = payloads[n].bytes;
    bytes.resize(1206);
    const std::int64_t first_firing = static_cast<std::int64_t>(n) * firings_per_packet;
    for (int column = 0; column < 6; ++column) {
      const int firing_in_packet = column * firings_per_packet / 6;
      const unsigned azimuth = azimuth_cdeg(head, first_firing + firing_in_packet,
                                            static_cast<double>(firing_ns) * 1e-9);
      put_little(bytes, static_cast<std::size_t>(200 * column), 0xEEFF, 2);
      put_little(bytes, static_cast<std::size_t>(200 * column + 100), 0xDDFF, 2);
      set_hdl64e_azimuth(bytes, column, azimuth);
      for (int laser = 0; laser < 64; ++laser) {
        if (!measured(random)) continue;
        const unsigned raw = distance(random);
        set_hdl64e_return(bytes, column, laser, raw, intensity(random));
      }
    }
    payloads[n].stamp_ns = kStart_ns + (first_firing + firings_per_packet) * firing_ns;
    set_hdl64e_clock(bytes, payloads[n].stamp_ns);
  }
  return payloads;
}

std::vector<Payload> ruby128_payloads(const RotatingHead& head, RubyClock clock) {
  std::mt19937 random(head.seed);
  std::bernoulli_distribution measured(head.share_of_returns);
  std::uniform_int_distribution<unsigned> distance(1, 65'535), intensity(0, 255);
  const int returns_per_firing = head.dual_return ? 2 : 1;
  std::vector<Payload> payloads(static_cast<std::size_t>(head.packets));
  for (std::size_t n = 0; n < payloads.size(); ++n) {
    Bytes& bytes = payloads[n].bytes;
    bytes.resize(1248);
    put_big(bytes, 0, 0x55AA055A, 4);
    put_big(bytes, 4, 1, 2);
    bytes[7] = head.dual_return ? 3 : 1;
    for (int block = 0; block < 3; ++block) {
      const std::int64_t reading = static_cast<std::int64_t>(n) * 3 + block;
      const std::int64_t firing = reading / returns_per_firing;
      if (block == 0) {
        payloads[n].stamp_ns = kStart_ns + firing * 55'550;
        set_ruby128_clock(bytes, payloads[n].stamp_ns, clock);
      }
      const auto block_at = static_cast<std::size_t>(80 + 388 * block);
      bytes[block_at] = 0xFE;
      bytes[block_at + 1] = static_cast<std::uint8_t>(1 + reading % returns_per_firing);
      set_ruby128_azimuth(bytes, block, azimuth_cdeg(head, firing, 55.55e-6));
      for (int channel = 0; channel < 128; ++channel) {
        if (!measured(random)) continue;
        const unsigned raw = distance(random);
        set_ruby128_return(bytes, block, channel, raw, intensity(random));
      }
    }
  }
  return payloads;
}

void set_hdl64e_azimuth(Bytes& payload, int column, unsigned cdeg) {
  for (int half = 0; half < 2; ++half) {
    put_little(payload, static_cast<std::size_t>(100 * (2 * column + half) + 2), cdeg, 2);
  }
}

void set_ruby128_azimuth(Bytes& payload, int column, unsigned cdeg) {
  put_big(payload, static_cast<std::size_t>(80 + 388 * column + 2), cdeg, 2);
}

void set_hdl64e_return(Bytes& payload, int column, int laser, unsigned raw, unsigned intensity) {
  put_little(payload, hdl64e_return_at(column, laser), raw, 2);
  put_little(payload, hdl64e_return_at(column, laser) + 2, intensity, 1);
}

void set_ruby128_return(Bytes& payload, int column, int laser, unsigned raw, unsigned intensity) {
  put_big(payload, ruby128_return_at(column, laser), raw, 2);
  put_big(payload, ruby128_return_at(column, laser) + 2, intensity, 1);
}

void set_hdl64e_clock(Bytes& payload, std::int64_t time_ns) {
  put_little(payload, 1200, static_cast<std::uint64_t>(time_ns / 1'000 % 3'600'000'000), 4);
}

void set_ruby128_clock(Bytes& payload, std::int64_t time_ns, RubyClock clock) {
  constexpr std::int64_t kSecond_ns = 1'000'000'000, kNewYear_s = 1'767'225'600;
  const std::int64_t seconds = time_ns / kSecond_ns, rest_ns = time_ns % kSecond_ns;
  const auto put = [&](std::size_t at, std::int64_t value, std::size_t count) {
    put_big(payload, at, static_cast<std::uint64_t>(value), count);
  };
  if (clock == RubyClock::kCalendar) {
    const std::int64_t of_year_s = seconds - kNewYear_s;
    put(10, 26, 1);
    put(11, 1, 1);
    put(12, 1, 1);
    put(13, of_year_s / 3'600, 1);
    put(14, of_year_s / 60 % 60, 1);
    put(15, of_year_s % 60, 1);
    put(16, rest_ns / 1'000'000, 2);
    put(18, rest_ns / 1'000 % 1'000, 2);
    return;
  }
  put(10, seconds, 6);
  put(16, clock == RubyClock::kMicroseconds ? rest_ns / 1'000 : rest_ns, 4);
}

hdl64e::Hdl64eCalibration random_hdl64e(std::mt19937& random) {
  const auto between = [&](double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random);
  };
  hdl64e::Hdl64eCalibration calibration;
  calibration.origin = "any HDL-64E";
  double elevation_deg = -24.9;
  for (hdl64e::Hdl64eLaser& laser : calibration.lasers) {
    laser.vert_correction_rad = elevation_deg * kRadPerDeg;
    elevation_deg += between(0.2, 0.65);
    laser.rot_correction_rad = between(-10, 10) * kRadPerDeg;
    laser.dist_correction_m = between(0, 1.6);
    laser.two_point = between(0, 1) < 0.7;
    laser.dist_correction_x_m = laser.dist_correction_m + between(-0.5, 0.5);
    laser.dist_correction_y_m = laser.dist_correction_m + between(-0.5, 0.5);
    laser.vert_offset_m = between(0, 0.22);
    laser.horiz_offset_m = between(-0.026, 0.026);
  }
  std::shuffle(calibration.lasers.begin(), calibration.lasers.end(), random);
  return calibration;
}

ruby128::Ruby128Calibration random_ruby128(std::mt19937& random) {
  const auto between = [&](double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random);
  };
  ruby128::Ruby128Calibration calibration;
  calibration.origin = "any RS-Ruby128";
  for (std::size_t i = 0; i < calibration.channels.size(); ++i) {
    const double even_deg = -25.0 + 40.0 * static_cast<double>(i) / 127.0;
    calibration.channels[i] = {(even_deg + between(-0.1, 0.1)) * kRadPerDeg,
                               between(-10, 10) * kRadPerDeg};
  }
  std::shuffle(calibration.channels.begin(), calibration.channels.end(), random);
  return calibration;
}

mount::Mount random_mount(std::mt19937& random) {
  const auto between = [&](double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random);
  };
  return {.height_m = between(0.3, 5.0),
          .roll_rad = between(-0.4, 0.4),
          .pitch_rad = between(-0.4, 0.4)};
}

}  // namespace terracut::reference
