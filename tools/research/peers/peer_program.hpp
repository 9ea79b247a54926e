// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

/// Code shared by the peers' adapters. An adapter is built with its peer, never by this project
/// (docs/reference/benchmark.md, "Beside its peers"), so it includes nothing of this project.
namespace terracut::peers {

using Point = std::array<float, 4>;  ///< x, y, z in metres, remission; as in the file.

/// Returns the processor time of all threads of the process: some peers start threads in every
/// call.
inline std::int64_t process_cpu_ns() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return now.tv_sec * INT64_C(1'000'000'000) + now.tv_nsec;
}

/// Returns the points of a file; an empty list if there is no such file, or it does not hold
/// points.
inline std::vector<Point> read_scan(const char* path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file || file.tellg() % static_cast<std::streamoff>(sizeof(Point)) != 0) return {};
  std::vector<Point> points(static_cast<std::size_t>(file.tellg()) / sizeof(Point));
  file.seekg(0);
  file.read(reinterpret_cast<char*>(points.data()),
            static_cast<std::streamsize>(points.size() * sizeof(Point)));
  return file ? points : std::vector<Point>{};
}

/// Writes SemanticKITTI ids. All points that are not called ground are obstacles, including points
/// that the peer removed.
inline bool write_labels(const std::string& path, const std::vector<bool>& is_ground) {
  constexpr std::uint32_t kGround = 40, kObstacle = 50;
  std::vector<std::uint32_t> labels;
  for (const bool ground : is_ground) labels.push_back(ground ? kGround : kObstacle);
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(labels.data()),
             static_cast<std::streamsize>(labels.size() * sizeof(labels[0])));
  return static_cast<bool>(file.flush());
}

/// main() of `PEER REPEAT LABELS SCAN.bin...`: prints a line for every scan, REPEAT times over: the
/// nanoseconds of processor time of Peer::segment(). Where LABELS is not "-", writes
/// <LABELS>/NNNNNN.label for the n-th scan. Peer has
///
///   using Scan = ..;                                        its own container
///   static Scan scan_of(const std::vector<Point>&);         not timed
///   void prepare(const Scan&);                              not timed
///   void segment(const Scan&);
///   std::vector<bool> is_ground(const Scan&);               by point; of the last segment()
template <class Peer>
int run_peer(int argc, char** argv) {
  if (argc < 4) {
    std::cerr << "usage: " << argv[0] << " REPEAT LABELS SCAN.bin...\n";
    return 1;
  }
  const int repeat = std::atoi(argv[1]);
  const std::string folder = argv[2];
  std::vector<typename Peer::Scan> scans;
  for (int i = 3; i < argc; ++i) {
    const std::vector<Point> points = read_scan(argv[i]);
    if (points.empty()) {
      std::cerr << argv[i] << ": not a scan of x, y, z, remission\n";
      return 1;
    }
    scans.push_back(Peer::scan_of(points));
  }
  std::cout.setstate(std::ios::failbit);  // silences the peer; times are printed by printf
  Peer peer;
  for (int pass = 0; pass <= repeat; ++pass) {  // the first pass warms caches and is not counted
    for (std::size_t i = 0; i < scans.size(); ++i) {
      peer.prepare(scans[i]);
      const std::int64_t begun_ns = process_cpu_ns();
      peer.segment(scans[i]);
      const std::int64_t spent_ns = process_cpu_ns() - begun_ns;
      if (pass > 0) std::printf("%lld\n", static_cast<long long>(spent_ns));
      if (pass > 0 || folder == "-") continue;
      std::array<char, 32> name{};
      std::snprintf(name.data(), name.size(), "/%06zu.label", i);
      if (!write_labels(folder + name.data(), peer.is_ground(scans[i]))) {
        std::cerr << folder << ": labels cannot be written\n";
        return 1;
      }
    }
  }
  return 0;
}

}  // namespace terracut::peers
