// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "firmware_io/bag/bag.hpp"
#include "firmware_io/bag/packet_messages.hpp"
#include "firmware_io/packet/datagram.hpp"
#include "rt/error.hpp"

namespace terracut::bag {

/// The packets of one topic of a bag, in order. Messages do not say who sent them, so addresses
/// and ports of the datagrams are 0. Not thread-safe; blocks on the disk.
class BagPackets {
 public:
  /// Fails as Bag::open() and choose_topic() do; an empty `topic` takes the only one with packets.
  [[nodiscard]] static Expected<BagPackets> open(const std::filesystem::path& path,
                                                 std::string_view topic);

  /// Returns the next packet, valid until the next call; nothing at the end. Fails as Bag::next()
  /// does, and at a message that is broken, after its packets before the fault.
  [[nodiscard]] Expected<std::optional<packet::Datagram>> next();
  [[nodiscard]] Status rewind();

  [[nodiscard]] const std::string& name() const noexcept { return bag_.name(); }
  [[nodiscard]] const Topic& topic() const noexcept { return bag_.topics()[topic_]; }

 private:
  BagPackets(Bag bag, std::size_t topic)
      : bag_(std::move(bag)), topic_(topic), wanted_(bag_.topics().size()) {
    wanted_[topic] = true;
  }

  Bag bag_;
  std::size_t topic_;
  std::vector<bool> wanted_;
  std::vector<PacketInMessage> packets_;  ///< Of the newest message.
  std::size_t next_ = 0;                  ///< Of packets_.
  bool is_broken_ = false;                ///< True if the newest message is.
};

}  // namespace terracut::bag
