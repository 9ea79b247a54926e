// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "chosen_frames.hpp"

#include <map>
#include <optional>

namespace terracut::report {
namespace {

ChosenFrame chosen(const Json& frames, std::size_t index, std::string why) {
  return {frames[index].at("sequence").get<std::string>(),
          frames[index].at("frame").get<std::string>(), std::move(why)};
}

/// Returns the indices of the frames in the list, grouped by sequence.
std::map<std::string, std::vector<std::size_t>> by_sequence(const Json& frames) {
  std::map<std::string, std::vector<std::size_t>> sequences;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    sequences[frames[i].at("sequence").get<std::string>()].push_back(i);
  }
  return sequences;
}

std::optional<std::size_t> least(const Json& frames, const std::vector<std::size_t>& among,
                                 const char* measure) {
  std::optional<std::size_t> worst;
  for (const std::size_t i : among) {
    const Json& value = frames[i].at(measure);
    if (value.is_null()) continue;
    if (!worst || value.get<double>() < frames[*worst].at(measure).get<double>()) worst = i;
  }
  return worst;
}

}  // namespace

std::string method_in_question(const Json& evaluation) {
  const Json& methods = evaluation.at("methods");
  return methods.contains("terracut") ? "terracut" : methods.items().begin().key();
}

std::vector<ChosenFrame> middle_frames(const Json& method) {
  const Json& frames = method.at("frames");
  std::vector<ChosenFrame> list;
  for (const auto& [sequence, indices] : by_sequence(frames)) {
    list.push_back(chosen(frames, indices[indices.size() / 2], "middle"));
  }
  return list;
}

std::vector<ChosenFrame> worst_frames(const Json& method) {
  const Json& frames = method.at("frames");
  std::vector<ChosenFrame> list;
  for (const auto& [sequence, indices] : by_sequence(frames)) {
    const auto recall = least(frames, indices, "recall_o");
    const auto iou = least(frames, indices, "iou_g");
    if (recall && recall == iou) {
      list.push_back(chosen(frames, *recall, "lowest Recall_o and lowest IoU_g"));
      continue;
    }
    if (recall) list.push_back(chosen(frames, *recall, "lowest Recall_o"));
    if (iou) list.push_back(chosen(frames, *iou, "lowest IoU_g"));
  }
  return list;
}

}  // namespace terracut::report
