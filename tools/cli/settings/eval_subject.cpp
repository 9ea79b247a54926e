// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "eval_subject.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "tools/lab/scenes/scene_names.hpp"
#include "tools/research/datasets/built_in_tables.hpp"

namespace terracut::cli {
namespace {

bool is_dataset(const std::string& word) {
  return word == "own" || word == "simulated" ||
         std::ranges::find(datasets::built_in_tables(), word, &datasets::BuiltInTable::dataset) !=
             datasets::built_in_tables().end();
}

}  // namespace

EvalSubject subject_of(const EvalOptions& options) {
  const EvalExtra extra = options.dataset == "hazards"   ? EvalExtra::kHazards
                          : options.dataset == "objects" ? EvalExtra::kObjects
                          : options.dataset == "free"    ? EvalExtra::kFree
                          : options.dataset == "sight"   ? EvalExtra::kSight
                                                         : EvalExtra::kNone;
  if (extra == EvalExtra::kNone) return {options.dataset, {options.root}, extra};
  EvalSubject subject{"semantickitti", {}, extra};
  std::vector<std::string> words{options.root.string()};
  words.insert(words.end(), options.more_roots.begin(), options.more_roots.end());
  if (words == std::vector<std::string>{"simulated"}) {
    for (const auto& scene : scenes::scene_names()) words.emplace_back(scene);
  }
  if (words.size() > 1 && is_dataset(words.front())) {
    subject.dataset = words.front();
    words.erase(words.begin());
  }
  if (subject.dataset == "simulated") words = {fmt::format("{}", fmt::join(words, ","))};
  subject.roots.assign(words.begin(), words.end());
  return subject;
}

}  // namespace terracut::cli
