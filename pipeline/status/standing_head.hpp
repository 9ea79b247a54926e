// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>

#include "firmware_io/net/datagram_account.hpp"

namespace terracut::status {

/// Tells whether the sensor's head stands still: packets come, but the decoder rejects all of them
/// for this reason, so no frame can follow. The user keeps threads apart.
class StandingHead {
 public:
  [[nodiscard]] bool is_standing(const net::DatagramAccount& account) noexcept {
    constexpr auto kStationary = static_cast<std::size_t>(frame::Reject::kStationary);
    const std::uint64_t refused = account.losses.rejected[kStationary];
    if (account.decoded != decoded_) refused_before_ = refused;
    decoded_ = account.decoded;
    return refused - refused_before_ >= kEnough;
  }

 private:
  static constexpr std::uint64_t kEnough = 500;  // packets of a tenth to a quarter of a second
  std::uint64_t decoded_ = 0, refused_before_ = 0;
};

}  // namespace terracut::status
