// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "hazard_report.hpp"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "disturbance.hpp"
#include "hazard_kind.hpp"
#include "spots.hpp"
#include "tools/research/statistics/measure_json.hpp"

namespace terracut::hazards {
namespace {

using Json = nlohmann::ordered_json;
using statistics::iou_g, statistics::mean, statistics::recall_o;

/// Returns the mean of each measure over `parts`.
Json elsewhere_json(const std::vector<Elsewhere>& parts) {
  std::vector<Json> iou_before, iou_after, recall_before, recall_after;
  for (const Elsewhere& part : parts) {
    iou_before.push_back(iou_g(part.before));
    iou_after.push_back(iou_g(part.after));
    recall_before.push_back(recall_o(part.before));
    recall_after.push_back(recall_o(part.after));
  }
  return {{"iou_g", {{"before", mean(iou_before)}, {"after", mean(iou_after)}}},
          {"recall_o", {{"before", mean(recall_before)}, {"after", mean(recall_after)}}}};
}

std::string percent(const Json& share) {
  return share.is_null() ? "-" : fmt::format("{:.2f}", 100 * share.get<double>());
}

/// Returns `after` minus `before` in percent points: "+0.01".
std::string change_text(const Json& measure) {
  if (measure.at("after").is_null() || measure.at("before").is_null()) return "-";
  return fmt::format(
      "{:+.2f}", 100 * (measure.at("after").get<double>() - measure.at("before").get<double>()));
}

/// A line of the table, for one kind of hazard on one ground: a cell for each range bin, and the
/// mean change elsewhere over all trials.
class HazardRow {
 public:
  explicit HazardRow(const Json& entry)
      : title_(fmt::format("{:<16}{:<9}", entry.at("hazard").get<std::string>(),
                           entry.at("ground").get<std::string>())) {}

  [[nodiscard]] const std::string& title() const { return title_; }

  void add(const Json& entry) {
    for (std::size_t bin = 0; bin < kRangeBins.size(); ++bin) {
      if (entry.at("from_m") == kRangeBins[bin].from_m) cells_[bin] = cell_text(entry);
    }
    iou_.add(entry.at("elsewhere").at("iou_g"), entry.at("trials"));
    recall_.add(entry.at("elsewhere").at("recall_o"), entry.at("trials"));
  }

  [[nodiscard]] std::string text() const {
    std::string text = title_;
    for (const std::string& cell : cells_) text += fmt::format("{:<19}", cell);
    return text + fmt::format("{:>7}{:>9}\n", iou_.text(), recall_.text());
  }

 private:
  /// The mean change of a measure.
  struct Change {
    double sum = 0, trials = 0;

    void add(const Json& measure, const Json& of_trials) {
      if (measure.at("after").is_null() || measure.at("before").is_null()) return;
      trials += of_trials.get<double>();
      sum += of_trials.get<double>() *
             (measure.at("after").get<double>() - measure.at("before").get<double>());
    }
    [[nodiscard]] std::string text() const {
      return trials > 0 ? fmt::format("{:+.2f}", 100 * sum / trials) : "-";
    }
  };

  static std::string cell_text(const Json& entry) {
    const auto percent_of = [](const Json& part, const Json& whole) {
      return 100 * part.get<double>() / whole.get<double>();
    };
    const Json& trials = entry.at("trials");
    return fmt::format("{:>4.0f}{:>4.0f}{:>4.0f} ({})", percent_of(entry.at("found"), trials),
                       percent_of(entry.at("unseen"), trials),
                       percent_of(entry.at("returns_as_obstacle"), entry.at("returns")),
                       trials.get<std::uint64_t>());
  }

  std::string title_;
  std::array<std::string, kRangeBins.size()> cells_{"   -", "   -", "   -", "   -"};
  Change iou_, recall_;
};

std::string hazards_text(const std::string& method, const Json& hazards) {
  std::string text = fmt::format(
      "{}: found, not one return, returns called obstacle, % (trials); change elsewhere\n{:<25}",
      method, "");
  for (const RangeBin& bin : kRangeBins) {
    text += fmt::format("{:<19}", fmt::format("{:>4.0f} to {:.0f} m", bin.from_m, bin.to_m));
  }
  text += fmt::format("{:>7}{:>9}\n", "IoU_g", "Recall_o");
  std::optional<HazardRow> row;
  for (const Json& entry : hazards) {
    if (HazardRow next(entry); !row || row->title() != next.title()) {
      if (row) text += row->text();
      row = std::move(next);
    }
    row->add(entry);
  }
  return text + row->text();
}

std::string disturbances_text(const std::string& method, const Json& disturbances) {
  const auto line = [](const std::string& title, const auto&... cells) {
    return fmt::format("{:<28}{:>8}{:>8}{:>8}{:>11}{:>8}{:>8}\n", title, cells...);
  };
  std::string text = line(method + ": what is not moved, %", "IoU_g", "before", "change",
                          "Recall_o", "before", "change");
  for (const Json& entry : disturbances) {
    const Json& iou = entry.at("elsewhere").at("iou_g");
    const Json& recall = entry.at("elsewhere").at("recall_o");
    text += line(entry.at("disturbance").get<std::string>(), percent(iou.at("after")),
                 percent(iou.at("before")), change_text(iou), percent(recall.at("after")),
                 percent(recall.at("before")), change_text(recall));
  }
  return text;
}

}  // namespace

Json hazard_json(const HazardTrials& trials, std::size_t index) {
  const MethodTrials& of_method = trials.trials()[index];
  Json json{{"hazards", Json::array()}, {"disturbances", Json::array()}};
  for (const auto& [key, counts] : of_method.hazards) {
    json["hazards"].push_back({{"hazard", trials.choice().kinds[key.kind]->word},
                               {"ground", to_string(key.ground)},
                               {"from_m", kRangeBins[key.bin].from_m},
                               {"to_m", kRangeBins[key.bin].to_m},
                               {"trials", counts.trials},
                               {"found", counts.found},
                               {"unseen", counts.unseen},
                               {"returns", counts.returns},
                               {"returns_as_obstacle", counts.as_obstacle},
                               {"elsewhere", elsewhere_json({counts.elsewhere})}});
  }
  for (const auto& [disturbance, by_sequence] : of_method.disturbances) {
    std::vector<Elsewhere> parts;
    for (const auto& [sequence, counts] : by_sequence) parts.push_back(counts);
    json["disturbances"].push_back(
        {{"disturbance", trials.choice().disturbances[disturbance]->word},
         {"elsewhere", elsewhere_json(parts)}});
  }
  return json;
}

std::string hazard_text(const std::string& method, const Json& json) {
  std::string text;
  if (!json.at("hazards").empty()) text += hazards_text(method, json.at("hazards"));
  if (!json.at("disturbances").empty()) {
    text += disturbances_text(method, json.at("disturbances"));
  }
  return text;
}

}  // namespace terracut::hazards
