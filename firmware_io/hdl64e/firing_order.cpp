// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/hdl64e/firing_order.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <string>

#include "firmware_io/hdl64e/packet_check.hpp"
#include "firmware_io/hdl64e/wire.hpp"

namespace terracut::firmware_io {
namespace {

constexpr std::int64_t kLeastStep_cdeg = kMinSweep_cdeg / (kColumnsPerPacketSingle - 1);
constexpr std::int64_t kLeastStep_ns = 1'000;  // the device clock must tell packets apart
/// Tighter than the decoder's own limits (stream_tracker.cpp), which know the speed less exactly.
constexpr std::int64_t kGapSlack_cdeg = 1'500;
constexpr std::int64_t kLongestGap_ns = 900'000'000;

tl::unexpected<Error> refuse(std::uint64_t firing, const std::string& what) {
  return fail(ErrorCode::kInvalidArgument, fmt::format("firing {} of the drive: {}", firing, what));
}

}  // namespace

Status FiringOrder::check(std::int64_t stamp_ns, std::int64_t azimuth_cdeg) {
  const std::uint64_t place = firings_ % kColumnsPerPacketSingle;
  if (firings_ > 0) {
    const std::int64_t step_ns = stamp_ns - last_.stamp_ns;
    const std::int64_t step_cdeg = azimuth_cdeg - last_.azimuth_cdeg;
    if (step_ns < kLeastStep_ns) {
      return refuse(firings_, fmt::format("expected a stamp at least {} ns after the one before, "
                                          "found a step of {} ns",
                                          kLeastStep_ns, step_ns));
    }
    if (step_cdeg < kLeastStep_cdeg || (place != 0 && step_cdeg > kMaxColumnStep_cdeg)) {
      return refuse(firings_,
                    fmt::format("expected the head to turn on by {} to {} hundredths of a degree "
                                "inside a packet and by {} or more between packets, found {}",
                                kLeastStep_cdeg, kMaxColumnStep_cdeg, kLeastStep_cdeg, step_cdeg));
    }
    if (place != 0) {
      step_ns_ = step_ns;
      step_cdeg_ = step_cdeg;
    } else {
      const std::int64_t gap_ns = stamp_ns - packet_first_.stamp_ns;
      const std::int64_t gap_cdeg = azimuth_cdeg - packet_first_.azimuth_cdeg;
      const std::int64_t packet_cdeg = last_.azimuth_cdeg - packet_first_.azimuth_cdeg;
      const std::int64_t packet_ns = last_.stamp_ns - packet_first_.stamp_ns;
      if (gap_ns > kLongestGap_ns) {
        return refuse(firings_,
                      fmt::format("expected the next packet within {} ms, found a gap of {} "
                                  "ms; write a second drive instead",
                                  kLongestGap_ns / 1'000'000, gap_ns / 1'000'000));
      }
      const std::int64_t expected_cdeg = packet_cdeg * gap_ns / packet_ns;
      if (std::abs(gap_cdeg - expected_cdeg) > kGapSlack_cdeg) {
        return refuse(
            firings_,
            fmt::format("the head's speed and the stamps say it turned by {:.2f} degrees "
                        "since the packet before began, the azimuths say {:.2f}; they may "
                        "differ by {:.0f} degrees",
                        static_cast<double>(expected_cdeg) / 100.0,
                        static_cast<double>(gap_cdeg) / 100.0,
                        static_cast<double>(kGapSlack_cdeg) / 100.0));
      }
    }
  }
  last_ = {stamp_ns, azimuth_cdeg};
  if (place == 0) packet_first_ = last_;
  ++firings_;
  return {};
}

std::pair<std::int64_t, std::int64_t> FiringOrder::next() const noexcept {
  return {last_.stamp_ns + step_ns_, last_.azimuth_cdeg + step_cdeg_};
}

}  // namespace terracut::firmware_io
