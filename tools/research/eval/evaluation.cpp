// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "evaluation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

#include "calib/mount/ring_profile.hpp"
#include "frame_judge.hpp"
#include "frame_labeller.hpp"
#include "pinned_thread.hpp"
#include "pipeline/ground/mount_search.hpp"
#include "result_keeper.hpp"
#include "rt/number_of.hpp"
#include "rt/threads/thread_setup.hpp"
#include "tools/lab/encode/sensor_motion.hpp"

namespace terracut::eval {
namespace {

namespace fs = std::filesystem;

/// A sequence that has been opened for evaluation.
struct OpenSequence {
  std::string name;
  datasets::Sequence scans;
  mount::RingProfile profile;
  std::optional<encode::SensorMotion> motion;  ///< Set if there are poses beside the frames.

  /// Returns the motion from frame `scan` to frame `before`; nothing unless `before` comes just
  /// before `scan`.
  [[nodiscard]] std::optional<encode::RigidMotion> motion_since(std::size_t before,
                                                                std::size_t scan) const {
    const auto from = rt::number_of<std::uint32_t>(scans.frame(scan));
    const auto to = rt::number_of<std::uint32_t>(scans.frame(before));
    if (!motion || !from || !to || *from != *to + 1) return std::nullopt;
    return motion->between(*from, *to);
  }
};

struct Work {
  const OpenSequence* sequence;
  std::size_t scan;

  [[nodiscard]] std::string frame() const { return sequence->scans.frame(scan); }
  [[nodiscard]] fs::path file() const { return sequence->scans.file(scan); }
};

/// Frames that one thread labels in order, so that results that carry over from frame to frame do
/// not depend on how work is distributed.
using FrameRun = std::vector<Work>;
constexpr std::size_t kLongestRun = 32;

/// Estimates the mount as a run does, from up to ten scans evenly spaced over the sequence.
Expected<mount::FoundMount> mount_of(const datasets::Sequence& sequence) {
  memory::FixedMemory memory;
  DirectWay way(sequence.shape(), mount::kAtTheSensor, memory);
  datasets::LabelledScan scan;
  ground::MountSearch search;
  const std::size_t scans = std::min(sequence.size(), mount::kFramesToFind);
  for (std::size_t i = 0; i < scans; ++i) {
    const Status read = sequence.read(i * sequence.size() / scans, scan);
    if (!read) continue;  // reported when the frame is labelled
    const auto placed = way.place(scan.scan.points, scan.rings.ring_of_point);
    if (placed) search.add_frame(*placed->image);
  }
  return search.found();
}

class Run {
 public:
  Run(const EvaluationConfig& config, datasets::Dataset dataset, Journal* journal,
      const std::function<void(std::size_t, std::size_t)>& on_progress,
      const std::function<bool()>& stop_wanted)
      : config_(config),
        on_progress_(on_progress),
        stop_wanted_(stop_wanted),
        dataset_(std::move(dataset)),
        keeper_(config.methods, config.predictions, journal) {}

  Expected<EvaluationOutcome> run() {
    const auto names = config_.sequences.empty()
                           ? dataset_.sequences()
                           : Expected<std::vector<std::string>>(config_.sequences);
    if (!names) return tl::unexpected(names.error());
    for (const std::string& name : *names) open_sequence(name);
    list_work();
    label_all();
    if (const auto failure = keeper_.failure()) return tl::unexpected(*failure);
    EvaluationOutcome outcome;
    outcome.interrupted = done_ < frames_ && stop_wanted_();
    outcome.results = keeper_.take_results();
    outcome.found_mounts = std::move(found_mounts_);
    for (auto& [key, fault] : faults_) outcome.faults.push_back(std::move(fault));
    return outcome;
  }

 private:
  [[nodiscard]] bool wants_whole_sequences() const {
    return config_.frames.first == 0 && config_.frames.last == SIZE_MAX;
  }

  void open_sequence(const std::string& name) {
    auto scans = dataset_.open(name);
    if (!scans) {
      faults_[{name, ""}] = {dataset_.folder(name).string(), scans.error().message};
      return;
    }
    if (const Status whole = scans->check_whole(); !whole && wants_whole_sequences()) {
      faults_[{name, ""}] = {dataset_.folder(name).string(), whole.error().message};
    }
    mount::Mount mount = config_.mount;
    if (config_.find_mount) {
      const auto found = mount_of(*scans);
      if (!found) {
        faults_[{name, ""}] = {dataset_.folder(name).string(),
                               name + ": the mount is not found: " + found.error().message};
        return;
      }
      mount = found_mounts_.insert_or_assign(name, *found).first->second.mount;
    }
    const auto profile = scan::ring_profile(scans->rings(), mount);
    sequences_.push_back(std::make_unique<OpenSequence>(
        OpenSequence{name, *std::move(scans), profile, motion_of(name)}));
  }

  /// Missing poses are no fault, but unreadable ones are.
  std::optional<encode::SensorMotion> motion_of(const std::string& name) {
    const fs::path folder = dataset_.folder(name);
    const fs::path poses = folder / "poses.txt", times = folder / "times.txt";
    std::error_code ignored;
    if (!fs::exists(poses, ignored) || !fs::exists(times, ignored)) return std::nullopt;
    auto motion = encode::SensorMotion::read(poses, times, folder / "calib.txt");
    if (motion) return *std::move(motion);
    faults_[{name, ""}] = {poses.string(), motion.error().message};
    return std::nullopt;
  }

  void list_work() {
    for (const auto& sequence : sequences_) {
      const FrameRange& frames = config_.frames;
      for (std::size_t i = frames.first; i < sequence->scans.size() && i <= frames.last;
           i += frames.step) {
        if (i == frames.first || runs_.back().size() == kLongestRun) runs_.emplace_back();
        runs_.back().push_back({sequence.get(), i});
        keeper_.expect(sequence->name, sequence->scans.frame(i));
        ++frames_;
      }
    }
  }

  void label_all() {
    const std::vector<int> cores = threads::allowed_cores();
    const std::size_t most = std::max<std::size_t>(1, cores.size());
    const std::size_t jobs = config_.jobs > 0 ? static_cast<std::size_t>(config_.jobs) : most;
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < std::min(jobs, runs_.size()); ++i) {
      try {
        threads.emplace_back([this, i, &cores] {
          pin_this_thread(fmt::format("tc-eval-{}", i), cores, i);
          label_some();
        });
      } catch (const std::system_error&) {  // no thread is left: those that run do all the work
        break;
      }
    }
    if (threads.empty()) label_some();
  }

  void label_some() {
    while (!stop_ && !stop_wanted_()) {
      const std::size_t i = next_++;
      if (i >= runs_.size()) return;
      label_run(runs_[i]);
    }
  }

  [[nodiscard]] bool is_done(const FrameRun& run) const {
    return std::ranges::all_of(run, [this](const Work& work) {
      return keeper_.methods_left(work.sequence->name, work.frame()).empty();
    });
  }

  void label_run(const FrameRun& run) {
    const OpenSequence& sequence = *run.front().sequence;
    std::unique_ptr<FrameLabeller> labeller;
    std::optional<FrameJudge> judge;
    if (!is_done(run)) {
      labeller = std::make_unique<FrameLabeller>(config_.methods, sequence.scans, sequence.profile,
                                                 config_.through_packets);
      if (config_.classes != nullptr) judge.emplace(*config_.classes, config_.methods.size());
    }
    datasets::LabelledScan scan;
    std::optional<std::size_t> before;  // the frame labelled last
    for (const Work& work : run) {
      if (stop_ || stop_wanted_()) return;
      if (labeller != nullptr && read_and_place(work, *labeller, scan)) {
        if (judge) {
          judge->look_at(scan.scan,
                         before ? sequence.motion_since(*before, work.scan) : std::nullopt);
        }
        label_frame(work, *labeller, judge ? &*judge : nullptr, scan);
        before = work.scan;
      }
      const std::scoped_lock lock(mutex_);
      on_progress_(++done_, frames_);
    }
  }

  bool read_and_place(const Work& work, FrameLabeller& labeller, datasets::LabelledScan& scan) {
    if (const Status read = work.sequence->scans.read(work.scan, scan); !read) {
      note(work, read.error().message);
      return false;
    }
    if (const Status placed = labeller.place(scan.scan, scan.rings); !placed) {
      note(work, work.file().string() + ": " + placed.error().message);
      return false;
    }
    return true;
  }

  void label_frame(const Work& work, FrameLabeller& labeller, FrameJudge* judge,
                   const datasets::LabelledScan& scan) {
    const std::vector<std::size_t> left = keeper_.methods_left(work.sequence->name, work.frame());
    for (std::size_t i = 0; i < config_.methods.size(); ++i) {
      FrameResult result = labeller.label(i);
      if (judge != nullptr) judge->judge(i, labeller.points(), result);
      if (std::ranges::find(left, i) == left.end()) continue;
      result.rings_realigned = scan.rings.aligned;
      if (!keeper_.keep({work.sequence->name, work.frame(), config_.methods[i].name},
                        labeller.points(), std::move(result))) {
        stop_ = true;
        return;
      }
    }
    if (config_.on_labelled && left.size() == config_.methods.size()) {
      show_labels(work, labeller, scan.scan);
    }
  }

  void show_labels(const Work& work, const FrameLabeller& labeller, const scan::KittiScan& scan) {
    std::vector<std::uint32_t> truth;
    for (const std::uint32_t point : labeller.placed().point_of_return) {
      truth.push_back(scan.labels[point]);
    }
    config_.on_labelled({work.sequence->name, work.frame(), *labeller.placed().image,
                         work.sequence->profile, truth,
                         [&](std::size_t i) { return labeller.returns(i); },
                         [&](std::size_t i) -> decltype(auto) { return labeller.planes(i); }});
  }

  void note(const Work& work, std::string what) {
    const std::scoped_lock lock(mutex_);
    faults_[{work.sequence->name, work.frame()}] = {work.file().string(), std::move(what)};
  }

  const EvaluationConfig& config_;
  const std::function<void(std::size_t, std::size_t)>& on_progress_;
  const std::function<bool()>& stop_wanted_;
  datasets::Dataset dataset_;
  ResultKeeper keeper_;

  std::vector<std::unique_ptr<OpenSequence>> sequences_;
  std::map<std::string, mount::FoundMount> found_mounts_;
  std::vector<FrameRun> runs_;
  std::size_t frames_ = 0;             ///< Frames of all runs.
  std::atomic<std::size_t> next_ = 0;  ///< The next run.
  std::atomic<bool> stop_ = false;

  std::mutex mutex_;  ///< Guards the following members.
  std::size_t done_ = 0;
  std::map<std::pair<std::string, std::string>, Fault> faults_;  ///< Keyed by sequence and frame.
};

}  // namespace

Expected<EvaluationOutcome> evaluate(
    const EvaluationConfig& config, Journal* journal,
    const std::function<void(std::size_t, std::size_t)>& on_progress,
    const std::function<bool()>& stop_wanted) {
  if (config.through_packets && config.layout.rings != scan::kScanRings) {
    return fail(ErrorCode::kUnsupported,
                fmt::format("{}: only the packets of an HDL-64E can be made of clouds, and these "
                            "have {} rings; evaluate them without `--through packets`",
                            config.root.string(), config.layout.rings));
  }
  auto dataset = datasets::Dataset::at(config.layout, config.root);
  if (!dataset) return tl::unexpected(dataset.error());
  return Run(config, *std::move(dataset), journal, on_progress, stop_wanted).run();
}

}  // namespace terracut::eval
