// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "firmware_io/frame/loss_counters.hpp"
#include "input.hpp"

namespace terracut::fuzz {

/// Counts beside a decoder where its packets and their returns are, and requires after every packet
/// that each is in exactly one place: decoded, rejected under a name, told about the device, or
/// kept in doubt.
class PacketAccount {
 public:
  /// `decode()` decodes a packet and says why it was rejected; if it was not, it carries
  /// `returns()`.
  template <class Decoder, class Decode, class Returns>
  void feed(const Decoder& decoder, Decode&& decode, Returns&& returns) {
    const frame::LossCounters before = decoder.losses();
    const std::size_t kept_before = decoder.packets_kept();
    const std::optional<frame::Reject> reason = decode();
    const bool is_device_info = reason == frame::Reject::kDeviceInfo;
    ++fed_;
    device_info_ += is_device_info ? 1 : 0;
    if (reason && !is_device_info) {
      const auto i = static_cast<std::size_t>(*reason);
      require(decoder.losses().rejected[i] > before.rejected[i],
              "a packet was rejected for another reason than it said");
    }
    const std::size_t kept = decoder.packets_kept();
    if (kept == 0 || (!reason && kept <= kept_before)) {
      finalize(kept_before, decoder.losses().rejected_total() - before.rejected_total() -
                                (reason && !is_device_info ? 1 : 0));
    }
    if (!reason) (kept > 0 ? returns_kept_ : returns_decoded_) += returns();
    check(decoder);
  }

  template <class Decoder, class Flush>
  void flush(const Decoder& decoder, Flush&& flush) {
    const std::uint64_t before = decoder.losses().rejected_total();
    const std::size_t kept = decoder.packets_kept();
    flush();
    finalize(kept, decoder.losses().rejected_total() - before);
    require(decoder.packets_kept() == 0, "the end of the stream left packets in doubt");
    check(decoder);
  }

  /// `returns`: those in frames, or counted as too many.
  void require_all_returns(std::uint64_t returns) const {
    require(returns_decoded_ <= returns && returns <= returns_decoded_ + returns_uncertain_,
            "returns of decoded packets are neither in a frame nor counted");
  }

 private:
  template <class Decoder>
  void check(const Decoder& decoder) const {
    require(decoder.packets_decoded() + decoder.losses().rejected_total() + device_info_ +
                    decoder.packets_kept() ==
                fed_,
            "packets are not all accounted for");
  }

  /// Of the packets that were kept, so many turned out to be strays.
  void finalize(std::size_t kept, std::uint64_t strays) {
    require(strays <= kept, "packets were rejected that had not come");
    if (strays == 0) {
      returns_decoded_ += returns_kept_;
    } else if (strays < kept) {
      returns_uncertain_ += returns_kept_;  // which of them is not said
    }
    returns_kept_ = 0;
  }

  std::uint64_t fed_ = 0, device_info_ = 0;
  std::uint64_t returns_decoded_ = 0, returns_kept_ = 0, returns_uncertain_ = 0;
};

}  // namespace terracut::fuzz
