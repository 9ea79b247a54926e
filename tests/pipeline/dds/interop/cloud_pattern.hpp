// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>

/// What the writer and the readers of the interoperability tests agree on, which share nothing
/// else: what is in the clouds, and in which bytes.
namespace terracut::interop {

inline constexpr std::uint32_t kPoints = 128'000, kPointStep = 24;
inline constexpr std::uint32_t kFrames = 50;

/// The i-th point of a frame.
struct PatternPoint {
  float x_m, y_m, z_m;
  std::uint8_t intensity, label;
  std::uint16_t ring;
  float time_s;
};
[[nodiscard]] constexpr PatternPoint pattern_point(std::uint32_t frame, std::uint32_t i) noexcept {
  return {static_cast<float>(i) * 0.25F,
          static_cast<float>(frame) - static_cast<float>(i),
          static_cast<float>(frame * 3 + i % 7),
          static_cast<std::uint8_t>(i + frame),
          i % 3 == 0 ? std::uint8_t{99} : std::uint8_t{40},
          static_cast<std::uint16_t>(i % 128),
          static_cast<float>(i) * 1e-6F};
}
/// The same as it lies in a PointCloud2.
[[nodiscard]] inline std::array<std::uint8_t, kPointStep> pattern_bytes(std::uint32_t frame,
                                                                        std::uint32_t i) noexcept {
  const PatternPoint point = pattern_point(frame, i);
  std::array<std::uint8_t, kPointStep> bytes{};
  const auto put = [&](std::size_t at, const auto& value) {
    std::memcpy(&bytes[at], &value, sizeof(value));
  };
  put(0, point.x_m);
  put(4, point.y_m);
  put(8, point.z_m);
  put(12, static_cast<float>(point.intensity));
  put(16, point.ring);
  put(18, point.label);
  put(20, point.time_s);
  return bytes;
}

/// Checks clouds as they come, by the frame's number in the stamp's seconds, and says so on
/// stderr, a line each: "frame 3", or what is wrong.
class Checker {
 public:
  template <class Bytes>
  void check(std::uint32_t frame, std::uint32_t width, std::uint32_t point_step, std::size_t fields,
             const std::string& frame_id, const Bytes& bytes) {
    if (width != kPoints || point_step != kPointStep || fields != 7 ||
        frame_id != "terracut_ground" || bytes.size() != std::size_t{width} * point_step) {
      say("wrong header in", frame);
      return;
    }
    for (std::uint32_t i = 0; i < width; ++i) {
      const auto expected = pattern_bytes(frame, i);
      if (std::memcmp(&bytes[std::size_t{i} * point_step], expected.data(), point_step) == 0) {
        continue;
      }
      say("wrong point in", frame);
      return;
    }
    ++right_;
    say("frame", frame);
  }
  [[nodiscard]] bool has_all() const noexcept { return right_ == kFrames; }

  static void say(const char* what, std::uint32_t frame = 0) {
    std::fprintf(stderr, "%s %u\n", what, frame);
  }

 private:
  std::uint32_t right_ = 0;
};

}  // namespace terracut::interop
