// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "sight_trials.hpp"

#include <algorithm>
#include <utility>

#include "sight_effect.hpp"
#include "tools/lab/world/random.hpp"
#include "tools/research/hazards/trial_labels.hpp"

namespace terracut::sight_measures {

using visibility::Cause;
using visibility::Visibility;

SightTrials::Runs& SightTrials::runs_of(const eval::LabelledByAll& frame, std::size_t method) {
  Runs& runs = runs_[{method, frame.sequence}];
  while (runs.size() < 2 + sight_effects().size()) {
    auto run = std::make_unique<Run>();
    run->visibility = std::make_unique<Visibility>(Visibility::Config{}, frame.profile,
                                                   frame.image.shape(), run->memory);
    runs.push_back(std::move(run));
  }
  return runs;
}

void SightTrials::look(const eval::LabelledByAll& frame) {
  const std::scoped_lock lock(mutex_);
  int turn = 0;
  for (std::size_t method = 0; method < methods_.size(); ++method) {
    Runs& runs = runs_of(frame, method);
    turn = ++runs[0]->turns;
    for (const auto& run : runs) {
      if (run == runs.back() || (run != runs[0] && turn > kCleanTurns)) break;
      run->visibility->look(frame.image, frame.planes_of(method));
    }
    Run& standing = *runs.back();
    for (int i = 0; i < kStandingTurns; ++i) {
      ++standing.turns;
      standing.visibility->look(frame.image, frame.planes_of(method));
      standing.alarms += standing.visibility->worst().cause != Cause::kNone ? 1 : 0;
    }
    runs[0]->alarms += runs[0]->visibility->worst().cause != Cause::kNone ? 1 : 0;
  }
  if (turn <= kCleanTurns) return;

  const hazards::LabelledFrame labelled =
      hazards::labelled_frame(frame.image, frame.truth, frame.profile.mount, classes_);
  hazards::TrialLabels labels(methods_, labelled, frame.profile);
  for (std::size_t i = 0; i < sight_effects().size(); ++i) {
    const SightEffect& effect = sight_effects()[i];
    const std::uint64_t key = world::mix_keys(seed_, i);
    labels.label(effect.apply(labelled, key, world::mix_keys(key, static_cast<unsigned>(turn))));
    for (std::size_t method = 0; method < methods_.size(); ++method) {
      Run& run = *runs_of(frame, method)[i + 1];
      ++run.turns;
      run.visibility->look(labels.image(), labels.planes(method));
      const Cause cause = run.visibility->worst().cause;
      if (cause == effect.cause && run.named_after == 0) run.named_after = run.turns;
      run.alarms += cause != Cause::kNone && cause != effect.cause ? 1 : 0;
    }
  }
}

SightCounts SightTrials::counts(std::size_t method) const {
  SightCounts counts{.effects = std::vector<EffectCounts>(sight_effects().size())};
  for (const auto& [key, runs] : runs_) {
    if (key.first != method) continue;
    counts.turns += static_cast<std::uint64_t>(runs[0]->turns);
    counts.alarms += runs[0]->alarms;
    counts.standing_turns += static_cast<std::uint64_t>(runs.back()->turns);
    counts.standing_alarms += runs.back()->alarms;
    for (std::size_t i = 0; i < counts.effects.size(); ++i) {
      const Run& run = *runs[i + 1];
      if (run.turns == 0) continue;
      EffectCounts& effect = counts.effects[i];
      ++effect.sequences;
      effect.named += run.named_after > 0 ? 1 : 0;
      effect.most_turns = std::max(effect.most_turns, run.named_after);
      effect.wrong_turns += run.alarms;
    }
  }
  return counts;
}

}  // namespace terracut::sight_measures
