// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iostream>
#include <optional>
#include <string>
#include <utility>
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

/// Writes an entry of SemanticKITTI's label files for each point.
inline bool write_labels(const std::string& path, const std::vector<std::uint32_t>& labels) {
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(labels.data()),
             static_cast<std::streamsize>(labels.size() * sizeof(labels[0])));
  return static_cast<bool>(file.flush());
}

/// main() of `PEER REPEAT LABELS SCAN.bin...`: prints a line for every scan, REPEAT times over: the
/// nanoseconds of processor time of Peer::segment(). Where LABELS is not "-", writes
/// <LABELS>/NNNNNN.label for the n-th scan. Peer has
///
///   using Scan = ..;               its own container
///   void prepare(const Scan&);     not timed
///   void segment(const Scan&);
///
/// `scan_of(path)` returns a Scan, or nothing if the file is not a scan; `labels_of(peer, scan)`
/// the label file's entries, of the last segment(). Neither is timed.
template <class Peer, class ScanOf, class LabelsOf>
int run_program(int argc, char** argv, ScanOf scan_of, LabelsOf labels_of) {
  if (argc < 4) {
    std::cerr << "usage: " << argv[0] << " REPEAT LABELS SCAN.bin...\n";
    return 1;
  }
  const int repeat = std::atoi(argv[1]);
  const std::string folder = argv[2];
  std::vector<typename Peer::Scan> scans;
  for (int i = 3; i < argc; ++i) {
    std::optional<typename Peer::Scan> scan = scan_of(argv[i]);
    if (!scan) {
      std::cerr << argv[i] << ": not a scan of x, y, z, remission\n";
      return 1;
    }
    scans.push_back(std::move(*scan));
  }
  // Silences the peer, whether it prints by std::cout or by printf.
  std::FILE* const times = fdopen(dup(STDOUT_FILENO), "w");
  if (times == nullptr || std::freopen("/dev/null", "w", stdout) == nullptr) return 1;
  std::cout.setstate(std::ios::failbit);
  Peer peer;
  for (int pass = 0; pass <= repeat; ++pass) {  // the first pass warms caches and is not counted
    for (std::size_t i = 0; i < scans.size(); ++i) {
      peer.prepare(scans[i]);
      const std::int64_t begun_ns = process_cpu_ns();
      peer.segment(scans[i]);
      const std::int64_t spent_ns = process_cpu_ns() - begun_ns;
      if (pass > 0) std::fprintf(times, "%lld\n", static_cast<long long>(spent_ns));
      if (pass > 0 || folder == "-") continue;
      std::array<char, 32> name{};
      std::snprintf(name.data(), name.size(), "/%06zu.label", i);
      if (!write_labels(folder + name.data(), labels_of(peer, scans[i]))) {
        std::cerr << folder << ": labels cannot be written\n";
        return 1;
      }
    }
  }
  return std::fclose(times) == 0 ? 0 : 1;
}

/// main() of a peer that finds the ground: a Peer of run_program() with
///
///   static Scan scan_of(const std::vector<Point>&);         not timed
///   std::vector<bool> is_ground(const Scan&);               by point; of the last segment()
///
/// All points that are not called ground are obstacles, including points that the peer removed.
template <class Peer>
int run_peer(int argc, char** argv) {
  using Scan = typename Peer::Scan;
  const auto scan_of = [](const char* path) -> std::optional<Scan> {
    const std::vector<Point> points = read_scan(path);
    if (points.empty()) return std::nullopt;
    return Peer::scan_of(points);
  };
  const auto labels_of = [](Peer& peer, const Scan& scan) {
    constexpr std::uint32_t kGround = 40, kObstacle = 50;
    std::vector<std::uint32_t> labels;
    for (const bool ground : peer.is_ground(scan)) labels.push_back(ground ? kGround : kObstacle);
    return labels;
  };
  return run_program<Peer>(argc, argv, scan_of, labels_of);
}

}  // namespace terracut::peers
