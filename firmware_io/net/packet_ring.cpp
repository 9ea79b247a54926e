// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/net/packet_ring.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace terracut::net {
namespace {

constexpr std::size_t kWordBytes = sizeof(std::uint64_t);
using Word = std::atomic_ref<std::uint64_t>;
static_assert(Word::is_always_lock_free);

constexpr std::size_t words_of(std::size_t bytes) noexcept {
  return (bytes + kWordBytes - 1) / kWordBytes;
}

void store(std::uint64_t& word, std::uint64_t value) noexcept {
  Word(word).store(value, std::memory_order_release);
}
std::uint64_t load(std::uint64_t& word) noexcept {
  return Word(word).load(std::memory_order_acquire);
}

std::uint32_t high_half(std::uint64_t word) noexcept {
  return static_cast<std::uint32_t>(word >> 32);
}
std::uint32_t low_half(std::uint64_t word) noexcept {
  return static_cast<std::uint32_t>(word);
}

}  // namespace

PacketRingSize packet_ring_size(double seconds, double packets_per_second,
                                std::size_t packet_bytes) {
  constexpr double kReserve = 1.125;
  constexpr double kMostBytes = 64.0 * 1024 * 1024 * 1024;
  const double datagrams = std::ceil(seconds * packets_per_second * kReserve);
  const double bytes = datagrams * static_cast<double>(words_of(packet_bytes) * kWordBytes);
  if (!(seconds > 0) || !(packets_per_second > 0) || packet_bytes == 0 || !(bytes <= kMostBytes)) {
    throw std::invalid_argument(
        fmt::format("flight recorder: {} s of {} packets/s of {} bytes; expected numbers above 0 "
                    "and at most 64 GiB in all",
                    seconds, packets_per_second, packet_bytes));
  }
  return {static_cast<std::size_t>(datagrams), static_cast<std::size_t>(bytes)};
}

PacketWindow::PacketWindow(const PacketRingSize& size, memory::FixedMemory& memory)
    : headers_(memory.take<Header>("flight recorder window", size.datagrams)),
      words_(memory.take<std::uint64_t>("flight recorder window", words_of(size.payload_bytes))) {}

packet::Datagram PacketWindow::datagram(std::size_t n) const noexcept {
  const Header& header = headers_[n];
  packet::Datagram datagram = header.datagram;
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(words_.data() + header.first_word);
  datagram.payload = {bytes, header.bytes};
  return datagram;
}

PacketRing::PacketRing(const PacketRingSize& size, memory::FixedMemory& memory)
    : headers_(memory.take<Header>("flight recorder ring", size.datagrams)),
      words_(memory.take<std::uint64_t>("flight recorder ring", words_of(size.payload_bytes))) {
  if (headers_.empty() || words_.empty()) {
    throw std::invalid_argument("flight recorder: room for no datagram; give it some seconds");
  }
}

void PacketRing::add(const packet::Datagram& datagram) noexcept TERRACUT_NONBLOCKING {
  const std::size_t bytes = datagram.payload.size();
  const std::size_t words = words_of(bytes);
  if (words > words_.size()) return;
  announced_.store(next_ + 1, std::memory_order_relaxed);
  announced_words_.store(next_word_ + words, std::memory_order_relaxed);

  std::size_t at = next_word_at_;
  const std::uint8_t* from = datagram.payload.data();
  for (std::size_t done = 0; done < bytes; done += kWordBytes) {
    std::uint64_t word = 0;
    std::memcpy(&word, from + done, std::min(kWordBytes, bytes - done));
    store(words_[at], word);
    if (++at == words_.size()) at = 0;
  }
  Header& header = headers_[next_header_at_];
  store(header.stamp_ns, static_cast<std::uint64_t>(datagram.stamp_ns));
  store(header.addresses,
        std::uint64_t{datagram.source_address} << 32 | std::uint64_t{datagram.destination_address});
  store(header.ports_and_bytes, std::uint64_t{datagram.source_port} << 48 |
                                    std::uint64_t{datagram.destination_port} << 32 | bytes);
  store(header.first_word, next_word_);

  ++next_;
  next_word_ += words;
  next_word_at_ = at;
  if (++next_header_at_ == headers_.size()) next_header_at_ = 0;
  published_.store(next_, std::memory_order_release);
}

PacketRing::Header PacketRing::load_header(std::uint64_t n) const noexcept {
  Header& header = headers_[n % headers_.size()];
  return {load(header.stamp_ns), load(header.addresses), load(header.ports_and_bytes),
          load(header.first_word)};
}

void PacketRing::load_words(std::uint64_t first_word,
                            std::span<std::uint64_t> into) const noexcept {
  std::size_t at = first_word % words_.size();
  for (std::uint64_t& word : into) {
    word = load(words_[at]);
    if (++at == words_.size()) at = 0;
  }
}

void PacketRing::copy_to(PacketWindow& window) const noexcept {
  const std::uint64_t end = published_.load(std::memory_order_acquire);
  const std::uint64_t announced = announced_.load(std::memory_order_relaxed);
  const std::uint64_t announced_words = announced_words_.load(std::memory_order_relaxed);
  // The ring still holds a datagram if no announcement has reached its header or its words.
  const std::uint64_t begin = announced > headers_.size() ? announced - headers_.size() : 0;
  const auto held = [&](std::uint64_t first_word) {
    return first_word + words_.size() >= announced_words;
  };

  window.datagrams_ = 0;
  window.payload_bytes_ = 0;
  window.overwritten_ = 0;
  std::size_t free_word = 0;
  // Drops the datagrams copied so far: a gap inside the window would look like lost packets.
  const auto start_again = [&] {
    window.overwritten_ += window.datagrams_ + 1;
    window.datagrams_ = 0;
    window.payload_bytes_ = 0;
    free_word = 0;
  };
  for (std::uint64_t n = begin; n < end; ++n) {
    const Header header = load_header(n);
    if (announced_.load(std::memory_order_relaxed) > n + headers_.size()) {
      start_again();
      continue;
    }
    if (!held(header.first_word)) continue;
    const std::size_t bytes = low_half(header.ports_and_bytes);
    const auto into = window.words_.subspan(free_word, words_of(bytes));
    load_words(header.first_word, into);
    if (announced_words_.load(std::memory_order_relaxed) > header.first_word + words_.size()) {
      start_again();
      continue;
    }
    packet::Datagram datagram;
    datagram.stamp_ns = static_cast<std::int64_t>(header.stamp_ns);
    datagram.source_address = high_half(header.addresses);
    datagram.destination_address = low_half(header.addresses);
    datagram.source_port = static_cast<std::uint16_t>(header.ports_and_bytes >> 48);
    datagram.destination_port = static_cast<std::uint16_t>(header.ports_and_bytes >> 32);
    window.headers_[window.datagrams_++] = {datagram, free_word, bytes};
    window.payload_bytes_ += bytes;
    free_word += into.size();
  }
}

}  // namespace terracut::net
