// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <vector>

#include "firmware_io/decode/datagram.hpp"

namespace terracut::cli {

/// Datagrams kept in memory, so that reading a file does not disturb what is measured.
class PacketStore {
 public:
  void add(const decode::Datagram& datagram);

  [[nodiscard]] std::size_t size() const noexcept { return entries_.size(); }
  /// Valid until the next add().
  [[nodiscard]] decode::Datagram at(std::size_t i) const noexcept;

 private:
  struct Entry {
    decode::Datagram datagram;  ///< Without its payload, which lies in bytes_.
    std::size_t offset, size;
  };
  std::vector<Entry> entries_;
  std::vector<std::uint8_t> bytes_;
};

inline void PacketStore::add(const decode::Datagram& datagram) {
  entries_.push_back({datagram, bytes_.size(), datagram.payload.size()});
  entries_.back().datagram.payload = {};
  bytes_.insert(bytes_.end(), datagram.payload.begin(), datagram.payload.end());
}

inline decode::Datagram PacketStore::at(std::size_t i) const noexcept {
  decode::Datagram datagram = entries_[i].datagram;
  datagram.payload = {bytes_.data() + entries_[i].offset, entries_[i].size};
  return datagram;
}

}  // namespace terracut::cli
