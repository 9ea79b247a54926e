// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "hazard_choice.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "disturbance.hpp"
#include "hazard_kind.hpp"

namespace terracut::hazards {
namespace {

template <class Row>
bool take(std::span<const Row> rows, const std::string& word, std::vector<const Row*>& chosen) {
  const auto row = std::ranges::find(rows, word, &Row::word);
  if (row == rows.end()) return false;
  chosen.push_back(&*row);
  return true;
}

}  // namespace

Status choose(std::span<const std::string> words, HazardChoice& choice) {
  if (words.empty()) {
    for (const HazardKind& kind : hazard_kinds()) choice.kinds.push_back(&kind);
    for (const Disturbance& one : disturbances()) choice.disturbances.push_back(&one);
    return {};
  }
  for (const std::string& word : words) {
    if (take(hazard_kinds(), word, choice.kinds)) continue;
    if (take(disturbances(), word, choice.disturbances)) continue;
    std::string known;
    for (const HazardKind& kind : hazard_kinds()) known += fmt::format(" {}", kind.word);
    for (const Disturbance& one : disturbances()) known += fmt::format(" {}", one.word);
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("there is no hazard '{}'; expected one or more of:{}", word, known));
  }
  return {};
}

}  // namespace terracut::hazards
