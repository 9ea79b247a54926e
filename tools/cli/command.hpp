// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace terracut::cli {

/// The subcommands, in the order of `terracut --help`.
enum class Command : std::uint8_t {
  kReplay,
  kView,
  kSegment,
  kManifest,
  kRelabel,
  kCompare,
  kSimulate,
  kEncode,
  kCalibrate,
  kInfo,
  kPlan,
  kParameters,
  kDetection,
  kBench,
  kSend,
  kLive,
  kNode,
  kDump,
  kEval,
  kTop,
  kConfig,
  kDoctor
};

struct CommandText {
  std::string_view name, about;
};

/// Name and help of each Command.
inline constexpr std::array kCommands{
    CommandText{"replay", "Label every return of a capture, frame by frame"},
    CommandText{"view", "Show labelled frames in a browser, to play, step and seek"},
    CommandText{"segment", "Label clouds of any LiDAR: .bin, .pcd.bin, .pcd, .ply"},
    CommandText{"manifest", "List a fleet's recordings, with what goes with each, for relabel"},
    CommandText{"relabel",
                "Label a fleet's recordings, one shard of them; what is there already\n"
                "is left alone, so that any number of processes may do so"},
    CommandText{"compare",
                "Compare two labelings of the same recordings: what changed, where most"},
    CommandText{"simulate", "Drive a simulated sensor: capture, table and truth"},
    CommandText{"encode", "Turn recorded scans into packets, with their truth"},
    CommandText{"calibrate",
                "Find the mount and the rings' ground distances from a capture,\n"
                "or from clouds, taken on a straight, level, open road"},
    CommandText{"info", "What a capture holds: streams, sensor, rate, loss, calibration"},
    CommandText{"plan", "Memory the program takes, part by part"},
    CommandText{"parameters",
                "Every parameter of the method, as a table for "
                "docs/reference/parameters.md"},
    CommandText{"detection",
                "The lowest obstacles that are always found, by sensor, mount height and range,\n"
                "as tables for docs/reference/detection.md"},
    CommandText{"bench", "Time decoding and every stage on one core"},
    CommandText{"send", "Send a capture's datagrams by UDP, as its sensor would"},
    CommandText{"live",
                "Label a sensor's packets as they arrive, before a deadline. The first labels\n"
                "come about 2.3 s after the first packet: 1.2 s to hear an HDL-64E's table,\n"
                "1 s to find the mount; 0.4 s where --calibration and --setup state both"},
    CommandText{"node", "Label any driver's clouds by DDS: a ROS 2 node that needs no ROS"},
    CommandText{"dump", "Have a running `terracut live` write its last seconds of packets"},
    CommandText{"eval", "Measure methods on a labelled dataset, as the paper does"},
    CommandText{"top", "Watch a running `terracut live` from another shell"},
    CommandText{"config", "Print the configuration in force, or one to start from"},
    CommandText{"doctor", "What of this machine stands in the way of real time, and what mends it"},
};

[[nodiscard]] constexpr std::string_view name_of(Command command) noexcept {
  return kCommands[static_cast<std::size_t>(command)].name;
}

/// A set of commands, written as `kReplay | kLive`.
class CommandSet {
 public:
  constexpr CommandSet() noexcept = default;
  constexpr CommandSet(Command command) noexcept  // NOLINT: one is some, too
      : bits_(1U << static_cast<unsigned>(command)) {}

  [[nodiscard]] constexpr bool contains(Command command) const noexcept {
    return (bits_ & CommandSet(command).bits_) != 0;
  }
  friend constexpr CommandSet operator|(CommandSet a, CommandSet b) noexcept {
    a.bits_ |= b.bits_;
    return a;
  }

 private:
  std::uint32_t bits_ = 0;
};
[[nodiscard]] constexpr CommandSet operator|(Command a, Command b) noexcept {
  return CommandSet(a) | CommandSet(b);
}

/// Returns "replay, live".
[[nodiscard]] inline std::string names_of(CommandSet commands) {
  std::string names;
  for (std::size_t i = 0; i < kCommands.size(); ++i) {
    if (!commands.contains(static_cast<Command>(i))) continue;
    names += (names.empty() ? "" : ", ") + std::string(kCommands[i].name);
  }
  return names;
}

}  // namespace terracut::cli
