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
#include <thread>
#include <utility>

#include "calib/mount/ring_profile.hpp"
#include "frame_labeller.hpp"
#include "pinned_thread.hpp"
#include "result_keeper.hpp"
#include "rt/threads/thread_setup.hpp"

namespace terracut::eval {
namespace {

namespace fs = std::filesystem;

/// A sequence that can be evaluated.
struct OpenSequence {
  std::string name;
  datasets::Sequence scans;
  mount::RingProfile profile;
};

struct Work {
  const OpenSequence* sequence;
  std::size_t scan;

  [[nodiscard]] std::string frame() const { return sequence->scans.frame(scan); }
  [[nodiscard]] fs::path file() const { return sequence->scans.file(scan); }
};

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
    outcome.interrupted = next_ < work_.size() && stop_wanted_();
    outcome.results = keeper_.take_results();
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
    const auto profile = scan::ring_profile(scans->rings(), config_.mount);
    sequences_.push_back(
        std::make_unique<OpenSequence>(OpenSequence{name, *std::move(scans), profile}));
  }

  void list_work() {
    for (const auto& sequence : sequences_) {
      const FrameRange& frames = config_.frames;
      for (std::size_t i = frames.first; i < sequence->scans.size() && i <= frames.last;
           i += frames.step) {
        work_.push_back({sequence.get(), i});
        keeper_.expect(sequence->name, sequence->scans.frame(i));
      }
    }
  }

  void label_all() {
    const std::vector<int> cores = threads::allowed_cores();
    const std::size_t most = std::max<std::size_t>(1, cores.size());
    const std::size_t jobs = config_.jobs > 0 ? static_cast<std::size_t>(config_.jobs) : most;
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < std::min(jobs, work_.size()); ++i) {
      threads.emplace_back([this, i, &cores] {
        pin_this_thread(fmt::format("tc-eval-{}", i), cores, i);
        label_some();
      });
    }
  }

  void label_some() {
    const OpenSequence* at = nullptr;
    std::unique_ptr<FrameLabeller> labeller;
    datasets::LabelledScan scan;
    while (!stop_ && !stop_wanted_()) {
      const std::size_t i = next_++;
      if (i >= work_.size()) return;
      const Work& work = work_[i];
      const auto wanted = keeper_.methods_left(work.sequence->name, work.frame());
      if (!wanted.empty()) {
        if (at != work.sequence) {
          at = work.sequence;
          labeller = std::make_unique<FrameLabeller>(config_.methods, at->scans, at->profile,
                                                     config_.through_packets);
        }
        label_frame(work, wanted, *labeller, scan);
      }
      const std::scoped_lock lock(mutex_);
      on_progress_(++done_, work_.size());
    }
  }

  void label_frame(const Work& work, const std::vector<std::size_t>& methods,
                   FrameLabeller& labeller, datasets::LabelledScan& scan) {
    if (const Status read = work.sequence->scans.read(work.scan, scan); !read) {
      return note(work, read.error().message);
    }
    if (const Status placed = labeller.place(scan.scan, scan.rings); !placed) {
      return note(work, work.file().string() + ": " + placed.error().message);
    }
    for (const std::size_t i : methods) {
      FrameResult result = labeller.label(i);
      result.rings_realigned = scan.rings.aligned;
      if (!keeper_.keep({work.sequence->name, work.frame(), config_.methods[i].name},
                        labeller.points(), std::move(result))) {
        stop_ = true;
        return;
      }
    }
    if (config_.changed_frames != nullptr && methods.size() == config_.methods.size()) {
      show_changes(work, labeller, scan.scan);
    }
  }

  void show_changes(const Work& work, const FrameLabeller& labeller, const scan::KittiScan& scan) {
    std::vector<std::uint32_t> truth;
    for (const std::uint32_t point : labeller.placed().point_of_return) {
      truth.push_back(scan.labels[point]);
    }
    config_.changed_frames->look({work.sequence->name, work.frame(), *labeller.placed().image,
                                  truth, [&](std::size_t i) { return labeller.returns(i); }});
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
  std::vector<Work> work_;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<bool> stop_ = false;

  std::mutex mutex_;  ///< Guards what follows.
  std::size_t done_ = 0;
  std::map<std::pair<std::string, std::string>, Fault> faults_;  ///< By sequence and frame.
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
