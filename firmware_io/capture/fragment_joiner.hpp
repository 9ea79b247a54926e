// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "firmware_io/packet/udp_frame.hpp"

namespace terracut::capture {

/// Puts fragments of IPv4 packets together, in whatever order they come. Packets are told apart by
/// sender, receiver, VLAN and number. The first kMostOpen packets allocate; one thread.
class FragmentJoiner {
 public:
  /// How many packets may be incomplete at a time; of more, the oldest is given up.
  static constexpr std::size_t kMostOpen = 16;

  struct Joined {
    packet::IpFragment whole;  ///< The packet; its payload is valid until the next call of add().
    std::uint64_t fragments = 0;  ///< How many it came in, repeated ones left out.
  };
  /// Adds a fragment. Returns the packet if this was the last that was missing.
  [[nodiscard]] std::optional<Joined> add(const packet::IpFragment& fragment);
  /// Forgets all fragments.
  void clear() noexcept;

 private:
  static constexpr std::size_t kMostBytes = 65'536, kUnitBytes = 8;

  struct Open {
    packet::IpFragment key;
    std::vector<std::uint8_t> bytes;  ///< Has kMostBytes once used.
    std::array<std::uint64_t, kMostBytes / kUnitBytes / 64> has_unit{};
    std::size_t units = 0;        ///< Units of 8 bytes that have come.
    std::size_t total_bytes = 0;  ///< Of the packet; 0 until its last fragment has come.
    std::uint64_t fragments = 0, age = 0;
  };
  [[nodiscard]] Open& open_of(const packet::IpFragment& fragment);
  /// Marks the units of a fragment; returns how many are new.
  [[nodiscard]] static std::size_t mark(Open& open, std::size_t at, std::size_t bytes) noexcept;

  std::vector<Open> open_;
  std::uint64_t age_ = 0;
};

}  // namespace terracut::capture
