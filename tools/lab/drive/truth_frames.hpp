// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "tools/lab/packets/return_mode.hpp"

namespace terracut::drive {

/// Sorts the truth of a drive's returns into frames as the decoder does: by each beam's own
/// azimuth, in order of arrival. `EncoderTraits`: see encoder_traits.hpp. Not real-time safe
/// (allocates).
template <class EncoderTraits>
class TruthFrames {
 public:
  using Column = typename EncoderTraits::Column;

  TruthFrames(const typename EncoderTraits::Offsets& offsets, packets::ReturnMode returns)
      : offsets_(offsets), returns_(returns) {}

  /// Adds the columns of one group of firings.
  void add(std::span<const Column> columns);

  /// If no further beam can reach the oldest frame, moves its labels to `labels` and returns true.
  /// Drops frames without labels.
  [[nodiscard]] bool take_finished(std::vector<std::uint32_t>& labels);
  /// Moves the labels of the oldest frame, finished or not; for the end of the drive.
  [[nodiscard]] bool take_any(std::vector<std::uint32_t>& labels);

 private:
  typename EncoderTraits::Offsets offsets_;
  packets::ReturnMode returns_;
  std::map<std::int64_t, std::vector<std::uint32_t>> by_frame_;
  std::int64_t oldest_reachable_ = 0;
  std::optional<std::int32_t> last_cdeg_;  ///< Azimuth of the head at the last firing.
};

}  // namespace terracut::drive
