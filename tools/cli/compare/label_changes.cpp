// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "label_changes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <system_error>
#include <tuple>
#include <utility>

#include "firmware_io/scan/label_file.hpp"
#include "pipeline/output/label_sink.hpp"
#include "tools/cli/fleet/labelled_drive.hpp"
#include "tools/cli/stop_signal.hpp"
#include "tools/cli/terminal_text.hpp"

namespace terracut::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

enum class Side : std::uint8_t { kGround, kObstacle, kNeither };

Side side_of(std::uint32_t label) noexcept {
  using frame::Label;
  const std::uint32_t id = scan::semantic_class(label);
  if (id == output::semantic_kitti_class(Label::kObstacle)) return Side::kObstacle;
  const bool ground = id == output::semantic_kitti_class(Label::kGround) ||
                      id == output::semantic_kitti_class(Label::kOtherGround);
  return ground ? Side::kGround : Side::kNeither;
}

std::set<std::string> label_files_in(const fs::path& folder) {
  std::set<std::string> names;
  std::error_code error;
  fs::directory_iterator entry(folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    std::string name = entry->path().filename().string();
    if (!name.starts_with('.') && name.ends_with(".label")) names.insert(std::move(name));
  }
  return names;
}

/// Returns those sums in SHA256SUMS whose files have not been written since.
std::map<std::string, std::string> sums_still_true(const fs::path& folder) {
  std::map<std::string, std::string> sums = listed_sums(folder);
  std::error_code error;
  const fs::file_time_type summed = fs::last_write_time(folder / kDriveSums, error);
  std::erase_if(sums, [&](const auto& file) {
    const auto written = fs::last_write_time(folder / file.first, error);
    return error || written > summed;
  });
  return sums;
}

template <class Change>
bool is_before(const Change& a, const Change& b, const std::string& name_a,
               const std::string& name_b) {
  const double share_a = a.changes.share(), share_b = b.changes.share();
  return std::tie(share_b, name_a) < std::tie(share_a, name_b);
}

void keep_most(std::vector<FrameChange>& frames, std::size_t most) {
  std::ranges::sort(frames, [](const FrameChange& a, const FrameChange& b) {
    return is_before(a, b, a.drive + a.frame, b.drive + b.frame);
  });
  if (frames.size() > most) frames.resize(most);
}

/// Compares two folders of label files of one drive.
class DriveComparison {
 public:
  DriveComparison(std::string drive, const fs::path& before, const fs::path& after, bool trust_sums)
      : before_(before), after_(after) {
    change_.drive = std::move(drive);
    if (!trust_sums) return;
    sums_before_ = sums_still_true(before);
    sums_after_ = sums_still_true(after);
  }

  Status compare(LabelChanges& all, std::size_t most) {
    const std::set<std::string> before = label_files_in(before_), after = label_files_in(after_);
    for (const std::string& name : before) {
      if (const Status on = go_on(); !on) return on;
      if (!after.contains(name)) {
        ++all.frames_in_one_alone;
        continue;
      }
      if (const Status compared = compare_frame(name, all, most); !compared) return compared;
    }
    all.frames_in_one_alone += static_cast<std::uint64_t>(std::ranges::count_if(
        after, [&](const std::string& name) { return !before.contains(name); }));
    all.all.frames += change_.frames;
    all.all.changed_frames += change_.changed_frames;
    all.all.changes += change_.changes;
    all.drives.push_back(std::move(change_));
    return {};
  }

 private:
  Status compare_frame(const std::string& name, LabelChanges& all, std::size_t most) {
    ReturnChanges changes;
    if (const auto bytes = bytes_by_sum(name)) {
      changes.returns = *bytes / sizeof(std::uint32_t);
      ++all.frames_by_sum;
    } else {
      Status read = scan::read_label_file(before_ / name, 0, ids_before_);
      if (read) read = scan::read_label_file(after_ / name, 0, ids_after_);
      if (!read) return read;
      if (ids_before_.size() != ids_after_.size()) {
        ++all.frames_of_other_size;
        return {};
      }
      changes = count();
    }
    ++change_.frames;
    change_.changes += changes;
    if (changes.changed() == 0) return {};
    ++change_.changed_frames;
    all.most.push_back({change_.drive, fs::path(name).stem().string(), changes});
    if (all.most.size() > 2 * most) keep_most(all.most, most);
    return {};
  }

  /// Returns the size of a file whose sum is the same in both folders; nothing if the sums differ.
  [[nodiscard]] std::optional<std::uint64_t> bytes_by_sum(const std::string& name) const {
    const auto sum = sums_before_.find(name), other = sums_after_.find(name);
    if (sum == sums_before_.end() || other == sums_after_.end() || sum->second != other->second) {
      return std::nullopt;
    }
    std::error_code error;
    const std::uint64_t before = fs::file_size(before_ / name, error);
    if (error || before != fs::file_size(after_ / name, error)) return std::nullopt;
    return before;
  }

  [[nodiscard]] ReturnChanges count() const {
    ReturnChanges changes;
    changes.returns = ids_before_.size();
    for (std::size_t i = 0; i < ids_before_.size(); ++i) {
      switch (change_between(ids_before_[i], ids_after_[i])) {
        case LabelChange::kNone:
          break;
        case LabelChange::kToObstacle:
          ++changes.to_obstacle;
          break;
        case LabelChange::kToGround:
          ++changes.to_ground;
          break;
        case LabelChange::kOther:
          ++changes.other;
          break;
      }
    }
    return changes;
  }

  fs::path before_, after_;
  std::map<std::string, std::string> sums_before_, sums_after_;
  std::vector<std::uint32_t> ids_before_, ids_after_;
  DriveChange change_;
};

std::string counts_of(const ReturnChanges& changes) {
  return fmt::format("{} to obstacle, {} to ground, {} else", changes.to_obstacle,
                     changes.to_ground, changes.other);
}

Json json_of(const ReturnChanges& changes) {
  return {{"returns", changes.returns},
          {"to_obstacle", changes.to_obstacle},
          {"to_ground", changes.to_ground},
          {"other", changes.other}};
}

Json json_of(const DriveChange& drive) {
  Json json{{"frames", drive.frames}, {"changed_frames", drive.changed_frames}};
  json.update(json_of(drive.changes));
  return json;
}

}  // namespace

bool is_obstacle_id(std::uint32_t label) noexcept {
  return side_of(label) == Side::kObstacle;
}

LabelChange change_between(std::uint32_t before, std::uint32_t after) noexcept {
  if (scan::semantic_class(before) == scan::semantic_class(after)) return LabelChange::kNone;
  const Side from = side_of(before), to = side_of(after);
  if (from == Side::kGround && to == Side::kObstacle) return LabelChange::kToObstacle;
  if (from == Side::kObstacle && to == Side::kGround) return LabelChange::kToGround;
  return LabelChange::kOther;
}

ReturnChanges& ReturnChanges::operator+=(const ReturnChanges& more) noexcept {
  returns += more.returns;
  to_obstacle += more.to_obstacle;
  to_ground += more.to_ground;
  other += more.other;
  return *this;
}

Expected<LabelChanges> compare_labels(const Labelling& before, const Labelling& after,
                                      std::size_t most, bool trust_sums) {
  LabelChanges changes;
  for (const auto& [drive, folder] : before.drives) {
    const auto its = after.drives.find(drive);
    if (its == after.drives.end()) {
      ++changes.drives_before_alone;
      continue;
    }
    DriveComparison comparison(drive, folder, its->second, trust_sums);
    if (Status compared = comparison.compare(changes, most); !compared) {
      return tl::unexpected(compared.error());
    }
  }
  changes.drives_after_alone = after.drives.size() - changes.drives.size();
  if (changes.drives.empty()) {
    return fail(ErrorCode::kNotFound, "no drive is in both of them, by its name");
  }
  keep_most(changes.most, most);
  std::ranges::sort(changes.drives, [](const DriveChange& a, const DriveChange& b) {
    return is_before(a, b, a.drive, b.drive);
  });
  return changes;
}

std::string LabelChanges::text(std::size_t shown) const {
  std::string text = fmt::format(
      "drives    {} in both, {} before alone, {} after alone\n"
      "frames    {} compared, {} differ; {} in one alone, {} with another number of returns\n"
      "returns   {}, {:.4f} % differ: {}\n",
      drives.size(), drives_before_alone, drives_after_alone, all.frames, all.changed_frames,
      frames_in_one_alone, frames_of_other_size, all.changes.returns, 100 * all.changes.share(),
      counts_of(all.changes));
  if (frames_by_sum > 0) {
    text += fmt::format("not read  {} of these frames, whose sums are the same\n", frames_by_sum);
  }
  if (all.changed_frames == 0) return text;
  text += "most changed drives\n";
  for (std::size_t i = 0; i < std::min(shown, drives.size()); ++i) {
    const DriveChange& drive = drives[i];
    if (drive.changed_frames == 0) break;
    text += fmt::format("{:9.4f} %  {}: {} of {} frames; {}\n", 100 * drive.changes.share(),
                        line_for_terminal(drive.drive), drive.changed_frames, drive.frames,
                        counts_of(drive.changes));
  }
  text += "most changed frames\n";
  for (const FrameChange& frame : most) {
    text += fmt::format("{:9.4f} %  {} {}: {}\n", 100 * frame.changes.share(),
                        line_for_terminal(frame.drive), line_for_terminal(frame.frame),
                        counts_of(frame.changes));
  }
  return text;
}

Json LabelChanges::json() const {
  Json json{{"drives_before_alone", drives_before_alone},
            {"drives_after_alone", drives_after_alone},
            {"frames_in_one_alone", frames_in_one_alone},
            {"frames_of_other_size", frames_of_other_size},
            {"frames_by_sum", frames_by_sum},
            {"all", json_of(all)},
            {"drives", Json::object()},
            {"most", Json::array()}};
  for (const DriveChange& drive : drives) json["drives"][drive.drive] = json_of(drive);
  for (const FrameChange& frame : most) {
    json["most"].push_back(Json{{"drive", frame.drive}, {"frame", frame.frame}});
    json["most"].back().update(json_of(frame.changes));
  }
  return json;
}

}  // namespace terracut::cli
