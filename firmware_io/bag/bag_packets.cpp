// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/bag/bag_packets.hpp"

#include <fmt/format.h>

#include "firmware_io/bag/topic_choice.hpp"

namespace terracut::bag {

Expected<BagPackets> BagPackets::open(const std::filesystem::path& path, std::string_view topic) {
  auto bag = Bag::open(path);
  if (!bag) return tl::unexpected(bag.error());
  const auto chosen = choose_topic(*bag, topic, Content::kPackets);
  if (!chosen) return tl::unexpected(chosen.error());
  return BagPackets(*std::move(bag), *chosen);
}

Expected<std::optional<packet::Datagram>> BagPackets::next() {
  while (next_ == packets_.size()) {
    if (is_broken_) {
      return fail(
          ErrorCode::kMalformed,
          fmt::format("{}: breaks off: a message of {} is no {}; what came before it is read",
                      name(), topic().name, topic().type));
    }
    const auto found = bag_.next(wanted_);
    if (!found) return tl::unexpected(found.error());
    if (!*found) return std::nullopt;
    next_ = 0;
    is_broken_ = !read_packets(topic().type, (*found)->message, packets_);
  }
  const PacketInMessage& packet = packets_[next_++];
  return packet::Datagram{.payload = packet.payload, .stamp_ns = packet.stamp_ns};
}

Status BagPackets::rewind() {
  packets_.clear();
  next_ = 0;
  is_broken_ = false;
  return bag_.seek({});
}

}  // namespace terracut::bag
