// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "pipeline/visibility/visibility.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "tools/research/datasets/class_table.hpp"
#include "tools/research/eval/labelled_by_all.hpp"
#include "tools/research/eval/method_choice.hpp"

namespace terracut::sight_measures {

/// What became of one effect in all sequences that were long enough.
struct EffectCounts {
  std::uint64_t sequences = 0;    ///< In so many it was there.
  std::uint64_t named = 0;        ///< In so many it was named, ...
  int most_turns = 0;             ///< ... after so many turns at most.
  std::uint64_t wrong_turns = 0;  ///< Turns in which the worst condition had another cause.
};

/// The view of one method.
struct SightCounts {
  std::uint64_t turns = 0;            ///< Of the sequences as they are, ...
  std::uint64_t alarms = 0;           ///< ... in so many of which something was named.
  std::uint64_t standing_turns = 0;   ///< Of the sequences as if the sensor stood, ...
  std::uint64_t standing_alarms = 0;  ///< ... in so many of which something was named.
  std::vector<EffectCounts> effects;  ///< By sight_effects().
};

/// Looks at the frames of sequences, which follow each other, as they are, and each kStandingTurns
/// times, as if the sensor stood there, so that short sequences are more than learnt: whatever is
/// named is a false alarm. Then lets each effect begin at turn kCleanTurns, and looks when it is
/// named. For any thread; but frames of a sequence must come in order.
class SightTrials {
 public:
  static constexpr int kCleanTurns = 15;
  static constexpr int kStandingTurns = 6;

  /// `methods` and `classes` must outlive this object.
  SightTrials(std::span<const eval::MethodChoice> methods, const datasets::ClassTable& classes,
              std::uint64_t seed)
      : methods_(methods), classes_(classes), seed_(seed) {}

  void look(const eval::LabelledByAll& frame);

  /// Must not be called during look().
  [[nodiscard]] SightCounts counts(std::size_t method) const;

 private:
  /// The turns of a sequence, as they are or with an effect.
  struct Run {
    memory::FixedMemory memory;
    std::unique_ptr<visibility::Visibility> visibility;
    int turns = 0;
    std::uint64_t alarms = 0;  ///< Turns with a cause that is not the effect's.
    int named_after = 0;       ///< Turns of the effect; 0: not named.
  };
  /// The runs of a sequence and method: as it is, then by effect, then as if the sensor stood.
  using Runs = std::vector<std::unique_ptr<Run>>;

  Runs& runs_of(const eval::LabelledByAll& frame, std::size_t method);

  std::span<const eval::MethodChoice> methods_;
  const datasets::ClassTable& classes_;
  std::uint64_t seed_;
  std::mutex mutex_;                                          ///< Guards the following member.
  std::map<std::pair<std::size_t, std::string>, Runs> runs_;  ///< By method and sequence.
};

}  // namespace terracut::sight_measures
