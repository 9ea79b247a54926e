// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "hazard_trials.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "beam_cast.hpp"
#include "disturbance.hpp"
#include "hazard_kind.hpp"
#include "labelled_frame.hpp"
#include "spots.hpp"
#include "trial_labels.hpp"

namespace terracut::hazards {
namespace {

std::uint64_t key_of(std::uint64_t key, std::string_view name) {
  for (const char letter : name) key = world::mix_keys(key, static_cast<unsigned char>(letter));
  return key;
}

/// The trials of one frame.
class FrameTrials {
 public:
  FrameTrials(std::span<const eval::MethodChoice> methods, const HazardChoice& choice,
              const LabelledFrame& frame, const eval::LabelledByAll& seen, ScanWriter* writer)
      : choice_(choice),
        frame_(frame),
        seen_(seen),
        writer_(writer),
        key_(key_of(key_of(choice.seed, seen.sequence), seen.frame)),
        labels_(methods, frame, seen.profile),
        clear_(methods.size()),
        trials_(methods.size()) {
    labels_.label({});
    write({.name = "clear"}, {});
    for (std::size_t i = 0; i < clear_.size(); ++i) {
      clear_[i].assign(labels_.of(i).begin(), labels_.of(i).end());
    }
  }

  void put_hazards(const Spots& spots) {
    for (std::size_t kind = 0; kind < choice_.kinds.size(); ++kind) {
      for (const GroundKind ground : kGroundKinds) {
        for (std::size_t bin = 0; bin < kRangeBins.size(); ++bin) {
          for (int trial = 0; trial < choice_.trials; ++trial) {
            put_one(spots, {kind, ground, bin}, trial);
          }
        }
      }
    }
  }

  void disturb() {
    for (std::size_t i = 0; i < choice_.disturbances.size(); ++i) {
      const Disturbance& disturbance = *choice_.disturbances[i];
      const MovedReturns moved = disturbed(frame_, disturbance, key_of(key_, disturbance.word));
      labels_.label(moved);
      const std::string word(disturbance.word);
      write({.name = word, .what = word}, moved);
      for (std::size_t method = 0; method < trials_.size(); ++method) {
        trials_[method].disturbances[i][seen_.sequence] += unmoved(method, moved);
      }
    }
  }

  [[nodiscard]] const std::vector<MethodTrials>& trials() const noexcept { return trials_; }

 private:
  void put_one(const Spots& spots, const TrialKey& at, int trial) {
    const HazardKind& kind = *choice_.kinds[at.kind];
    std::uint64_t key = key_of(key_of(key_, kind.word), to_string(at.ground));
    key = world::mix_keys(world::mix_keys(key, at.bin), static_cast<std::uint64_t>(trial));
    world::Random random(key);
    const Hazard hazard = kind.make(random);
    const auto spot = spots.draw(hazard, at.ground, at.bin, random);
    if (!spot) return;
    const MovedReturns moved = put_in(frame_, hazard, *spot, key);
    if (static_cast<std::uint64_t>(std::ranges::count(moved, true, &MovedReturn::counts)) <
        kFewestReturns) {
      return;
    }
    labels_.label(moved);
    const RangeBin& bin = kRangeBins[at.bin];
    write({.name =
               fmt::format("{}_{}_{:02.0f}_{}", kind.word, to_string(at.ground), bin.from_m, trial),
           .what = std::string(kind.word),
           .ground = std::string(to_string(at.ground)),
           .from_m = bin.from_m,
           .to_m = bin.to_m},
          moved);
    for (std::size_t method = 0; method < trials_.size(); ++method) {
      trials_[method].hazards[at].add(seen_hazard(moved, labels_.of(method)),
                                      unmoved(method, moved));
    }
  }

  /// Writes a scan. `scan` has only the end of its name; the rest is filled in here.
  void write(WrittenScan scan, const MovedReturns& moved) const {
    if (writer_ == nullptr) return;
    scan.sequence = seen_.sequence;
    scan.name = seen_.frame + "_" + scan.name;
    writer_->write(scan, frame_, seen_.profile.mount, moved);
  }

  [[nodiscard]] Elsewhere unmoved(std::size_t method, const MovedReturns& moved) const {
    return elsewhere(frame_, moved, clear_[method], labels_.of(method));
  }

  const HazardChoice& choice_;
  const LabelledFrame& frame_;
  const eval::LabelledByAll& seen_;
  ScanWriter* writer_;
  std::uint64_t key_;
  TrialLabels labels_;
  std::vector<std::vector<frame::Label>> clear_;  ///< Labels of the unchanged frame, by method.
  std::vector<MethodTrials> trials_;
};

}  // namespace

bool HazardTrials::is_empty() const {
  return std::ranges::all_of(trials_, [](const MethodTrials& of_method) {
    return of_method.hazards.empty() && of_method.disturbances.empty();
  });
}

void HazardTrials::look(const eval::LabelledByAll& seen) {
  const LabelledFrame frame = labelled_frame(seen.image, seen.truth, seen.profile.mount, classes_);
  const Spots spots(frame);
  if (!spots.has_ground()) {
    const std::scoped_lock lock(mutex_);
    ++frames_without_ground_;
    return;
  }
  FrameTrials of_frame(methods_, choice_, frame, seen, writer_);
  of_frame.put_hazards(spots);
  of_frame.disturb();

  const std::scoped_lock lock(mutex_);
  for (std::size_t method = 0; method < trials_.size(); ++method) {
    for (const auto& [key, counts] : of_frame.trials()[method].hazards) {
      trials_[method].hazards[key] += counts;
    }
    for (const auto& [index, by_sequence] : of_frame.trials()[method].disturbances) {
      for (const auto& [sequence, counts] : by_sequence) {
        trials_[method].disturbances[index][sequence] += counts;
      }
    }
  }
}

}  // namespace terracut::hazards
