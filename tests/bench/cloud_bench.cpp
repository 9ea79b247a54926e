// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// What a cloud costs beside the same scan that lies in the image already, points in, labels out, by
// what tells its lasers: cloud_bench SCAN.bin (in KITTI's order). All ways in turn, round after
// round. Reports, asserts nothing.
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iostream>
#include <random>
#include <string>
#include <vector>

#include "firmware_io/cloud/sensor_rows.hpp"
#include "firmware_io/scan/scan_to_image.hpp"
#include "pipeline/ground/segmenter.hpp"
#include "rt/measure/thread_cpu_clock.hpp"
#include "terracut/segmenter.hpp"

namespace {

using namespace terracut;

constexpr int kRounds = 300;

struct Way {
  std::string name;
  std::function<void()> label;
  std::vector<double> ms = {};

  [[nodiscard]] double at(double share) const {
    std::vector<double> sorted = ms;
    std::ranges::sort(sorted);
    return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
  }
};

/// The same cloud in another order.
struct Shuffled {
  std::vector<CloudPoint> points;
  std::vector<std::uint16_t> laser;
};

Way by_cloud(std::string name, const Cloud& cloud) {
  auto segmenter =
      std::make_shared<Segmenter>(Segmenter::make({.mount = {.height_m = 1.73}}).value());
  return {std::move(name), [segmenter, cloud] {
            if (!segmenter->label(cloud)) std::abort();
          }};
}

}  // namespace

int main(int argc, char** argv) {
  scan::KittiScan scan;
  if (argc != 2) return std::cerr << "usage: cloud_bench SCAN.bin\n", 2;
  if (const Status read = scan::read_kitti_scan(argv[1], scan); !read) {
    return std::cerr << read.error().message << '\n', 3;
  }
  const auto rows = cloud::learn_rows(
      1, [&](std::size_t) -> Expected<cloud::CloudView> { return cloud::CloudView{scan.points}; });
  if (!rows) return std::cerr << rows.error().message << '\n', 3;
  scan::RingRecovery rings;
  (void)cloud::RowFinder(*rows).find({scan.points}, rings);

  memory::FixedMemory memory;
  frame::RangeImage image(rows->shape(), rows->shape().cells(), memory);
  scan::ScanToImage to_image(mount::Mount{});
  (void)to_image.place(scan.points, rings.ring_of_point, image);
  ground::Segmenter segmenter(ground::terracut_profile(),
                              scan::ring_profile(rows->rings.table, mount::Mount{}), rows->shape(),
                              image.return_capacity(), memory);

  std::vector<CloudPoint> points;
  std::vector<std::uint16_t> laser;
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const scan::ScanPoint& p = scan.points[i];
    points.push_back({p.x_m, p.y_m, p.z_m, p.remission});
    laser.push_back(static_cast<std::uint16_t>(std::max<std::int16_t>(rings.ring_of_point[i], 0)));
  }
  Shuffled shuffled;
  std::vector<std::size_t> order(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::shuffle(order, std::mt19937(1));
  for (const std::size_t i : order) {
    shuffled.points.push_back(points[i]);
    shuffled.laser.push_back(laser[i]);
  }

  Way ways[] = {
      {"in the image", [&] { (void)segmenter.segment(image); }},
      by_cloud("by the lasers' numbers", {points, laser}),
      by_cloud("... shuffled", {shuffled.points, shuffled.laser}),
      by_cloud("by KITTI's order", {points}),
      by_cloud("by elevations, shuffled", {shuffled.points}),
  };
  for (int round = -10; round < kRounds; ++round) {
    for (Way& way : ways) {
      const std::int64_t begun_ns = measure::thread_cpu_ns();
      way.label();
      const auto ns = static_cast<double>(measure::thread_cpu_ns() - begun_ns);
      if (round >= 0) way.ms.push_back(ns / 1e6);
    }
  }
  fmt::print("{} points, {} rounds, processor ms\n{:<28}{:>8}{:>8}{:>10}\n", points.size(), kRounds,
             "", "p50", "p99", "more p50");
  for (const Way& way : ways) {
    fmt::print("{:<28}{:>8.2f}{:>8.2f}{:>10.2f}\n", way.name, way.at(0.5), way.at(0.99),
               way.at(0.5) - ways[0].at(0.5));
  }
  return 0;
}
