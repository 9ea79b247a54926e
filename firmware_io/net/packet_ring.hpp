// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware_io/packet/datagram.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::net {

/// Size of a ring that keeps the newest traffic.
struct PacketRingSize {
  std::size_t datagrams = 0;
  /// Bytes for all payloads together; each payload is rounded up to 8 bytes.
  std::size_t payload_bytes = 0;
};

/// Returns the size for `seconds` at `packets_per_second` packets of `packet_bytes`, plus an eighth
/// for the sensor's other packets and for clocks that run apart. Throws std::invalid_argument
/// unless all are greater than 0 and the whole stays below 64 GiB.
[[nodiscard]] PacketRingSize packet_ring_size(double seconds, double packets_per_second,
                                              std::size_t packet_bytes);

/// A copy of a PacketRing's content at one moment, oldest datagram first, in its own memory. The
/// copy has no gaps: if a datagram was overwritten before it was copied, those before it are left
/// out, too.
class PacketWindow {
 public:
  /// Takes memory for any window of a ring of this size; `terracut plan` lists it as "flight
  /// recorder window".
  PacketWindow(const PacketRingSize& size, memory::FixedMemory& memory);

  [[nodiscard]] std::size_t datagrams() const noexcept { return datagrams_; }
  /// Returns datagram number n, counted from the oldest; its payload points into the window.
  [[nodiscard]] packet::Datagram datagram(std::size_t n) const noexcept;
  [[nodiscard]] std::uint64_t payload_bytes() const noexcept { return payload_bytes_; }
  /// Returns how many datagrams of the ring are missing in this window, because they, or later
  /// ones, were overwritten before they were copied.
  [[nodiscard]] std::uint64_t overwritten() const noexcept { return overwritten_; }

 private:
  friend class PacketRing;
  struct Header {
    packet::Datagram datagram;  ///< The datagram without its payload.
    std::size_t first_word = 0;
    std::size_t bytes = 0;
  };

  std::span<Header> headers_;
  std::span<std::uint64_t> words_;
  std::size_t datagrams_ = 0;
  std::uint64_t payload_bytes_ = 0;
  std::uint64_t overwritten_ = 0;
};

/// Keeps the newest datagrams of a stream in fixed memory: one thread adds, another may copy them
/// all at any time. Neither ever waits for the other; a datagram added while the copy runs wins.
///
///     words    [ .. | payload 7   | payload 8     | payload 9 |   (payload 3, being overwritten)
///     headers  [ 8 | 9 |   | 3 | 4 | 5 | 6 | 7 ]
///
/// Datagram n has header n modulo the ring and words [first, last) modulo the ring; both numbers
/// only grow. The writer (1) announces how far it is about to overwrite, (2) stores words and
/// header, (3) publishes n + 1.
///
/// Why no torn datagram is taken for a good one, and why there is no data race: every shared word
/// is read and written as an atomic; the stores of (2) release, the reader's loads acquire. A
/// reader that loaded even one word of a newer datagram therefore sees its announcement (1), which
/// the writer made before. So the reader loads the announcement after its copy and drops the copy
/// if the announcement reaches into it; a header is checked in the same way before it is used. A
/// word that no announcement reaches still holds what (3) published. On x86-64 these loads and
/// stores are plain moves.
class PacketRing {
 public:
  /// Takes all memory; `terracut plan` lists it as "flight recorder ring". Throws
  /// std::invalid_argument for a size of 0.
  PacketRing(const PacketRingSize& size, memory::FixedMemory& memory);

  /// Adds a datagram; for the writer thread only. Wait-free, bounded by the payload's length;
  /// allocates nothing. Leaves out a payload longer than the whole ring.
  void add(const packet::Datagram& datagram) noexcept TERRACUT_NONBLOCKING;

  /// Copies the ring into `window`, whose size must be the ring's, while the writer goes on; for
  /// one reader thread. Allocates nothing.
  void copy_to(PacketWindow& window) const noexcept;

  /// Returns how many datagrams were added since construction, including overwritten ones. Any
  /// thread.
  [[nodiscard]] std::uint64_t added() const noexcept {
    return published_.load(std::memory_order_acquire);
  }

 private:
  struct Header {
    std::uint64_t stamp_ns, addresses, ports_and_bytes, first_word;
  };

  [[nodiscard]] Header load_header(std::uint64_t n) const noexcept;
  void load_words(std::uint64_t first_word, std::span<std::uint64_t> into) const noexcept;

  std::span<Header> headers_;
  std::span<std::uint64_t> words_;

  // Used by the writer only.
  std::uint64_t next_ = 0;       ///< Number of the next datagram.
  std::uint64_t next_word_ = 0;  ///< Where the payload of the next datagram begins.
  std::size_t next_header_at_ = 0, next_word_at_ = 0;  ///< next_ and next_word_ modulo the ring.

  std::atomic<std::uint64_t> announced_{0};  ///< Number of datagrams that the writer has begun.
  /// Number of words of all datagrams that the writer has begun.
  std::atomic<std::uint64_t> announced_words_{0};
  std::atomic<std::uint64_t> published_{0};  ///< Number of datagrams that are complete.
};

}  // namespace terracut::net
