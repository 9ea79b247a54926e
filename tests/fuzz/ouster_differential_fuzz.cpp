// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// The Ouster decoder beside the plain reference on packets that the input makes and bends: the same
// refusals, and the same frame, cell and place of every return.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "any_ouster.hpp"
#include "firmware_io/decode/decoder.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "tests/support/hand_out.hpp"
#include "tests/support/reference/agreement.hpp"
#include "tests/support/reference/ouster_reference.hpp"

namespace {

using namespace terracut;

using fuzz::require;

/// Decodes a stretch of packets of one unit, which follow each other by the unit's clock.
class Stretch {
 public:
  explicit Stretch(fuzz::Input& input)
      : input_(input),
        random_(input.next(1)),
        unit_(made(input, random_)),
        mount_(reference::random_mount(random_)),
        reference_(unit_),
        expected_(reference::elevations_of(unit_.lasers), mount_, unit_.columns_per_frame),
        decoder_(unit_, mount_, {}, memory_) {}

  void run() {
    constexpr int kMostPackets = 40;
    for (int n = 0; n < kMostPackets && !input_.empty(); ++n) {
      const double share = input_.below(4) / 8.0;
      auto payload = reference::ouster_payloads(
          unit_, {.packets = 1, .share_of_returns = share, .seed = input_.next(1)})[0];
      const int packets = unit_.columns_per_frame / unit_.format.columns;
      const int first = (1 + n) % packets * unit_.format.columns;
      const auto stamp_ns = static_cast<std::uint64_t>(
          1'767'225'600'000'000'000 + n * 1'000'000'000.0 / (unit_.rate_hz * packets));
      const std::uint32_t valid = input_.below(4) == 0 ? input_.next(2) : ~0U;
      reference::set_ouster_columns(unit_, payload.bytes, first, stamp_ns, valid);
      for (int bends = std::max(0, input_.below(16) - 12); bends > 0; --bends) bend(payload.bytes);
      feed(payload.bytes, static_cast<std::int64_t>(stamp_ns));
    }
    test::end_stream(decoder_, handed_.keep());
    if (has_agreed_) {
      require(reference::first_difference(expected_, handed_, unit_.columns_per_frame).empty());
    }
  }

 private:
  static ouster::OusterCalibration made(fuzz::Input& input, std::mt19937& random) {
    const int rows = fuzz::any_rows(input);
    return reference::random_ouster(rows, fuzz::any_profile(input), random);
  }

  void bend(std::vector<std::uint8_t>& bytes) {
    const std::size_t at = input_.next(2) % bytes.size();
    bytes[at] = static_cast<std::uint8_t>(input_.next(1));
  }

  void feed(const std::vector<std::uint8_t>& bytes, std::int64_t stamp_ns) {
    const reference::Packet plain = reference_.decode(bytes);
    const auto reason =
        test::decode(decoder_, {.payload = bytes, .stamp_ns = stamp_ns}, handed_.keep());
    require(reference::as_refusal(reason) == plain.refusal ||
            plain.refusal == reference::Refusal::kNone);
    // A stamp or a number that the input bent may put a packet into doubt or elsewhere.
    has_agreed_ &= !reason && decoder_.packets_kept() == 0 && is_in_order(plain);
    if (has_agreed_) expected_.add(plain, frames_.unwrap(plain));
  }
  [[nodiscard]] bool is_in_order(const reference::Packet& plain) {
    const double was_deg = std::exchange(last_deg_, plain.first_deg);
    const double pace_deg = 360.0 * unit_.format.columns / unit_.columns_per_frame;
    return was_deg < 0 ||
           std::abs(std::remainder(plain.first_deg - was_deg - pace_deg, 360)) < 1e-6;
  }

  fuzz::Input& input_;
  std::mt19937 random_;
  ouster::OusterCalibration unit_;
  mount::Mount mount_;
  reference::OusterReference reference_;
  reference::ExpectedFrames expected_;
  reference::Frames frames_;
  memory::FixedMemory memory_;
  decode::Decoder decoder_;
  reference::HandedFrames handed_;
  bool has_agreed_ = true;
  double last_deg_ = -1;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Input input({data, size});
  Stretch(input).run();
  return 0;
}
