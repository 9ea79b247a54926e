// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "evaluation.hpp"

#include <fmt/format.h>
#include <sched.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>
#include <thread>
#include <utility>

#include "firmware_io/scan/scan_reader.hpp"
#include "firmware_io/sinks/label_sink.hpp"
#include "frame_labeller.hpp"
#include "rt/thread_setup.hpp"

namespace terracut::evaluation {
namespace {

namespace fs = std::filesystem;
using firmware_io::ScanReader;

/// A sequence that can be evaluated.
struct Sequence {
  std::string name;
  ScanReader reader;
  calib::Hdl64eCalibration calibration;
  calib::RingProfile profile;
};

struct Work {
  const Sequence* sequence;
  std::size_t scan;
};

/// The cores this process may run on.
std::vector<int> allowed_cores() {
  ::cpu_set_t set;
  CPU_ZERO(&set);
  std::vector<int> cores;
  if (::sched_getaffinity(0, sizeof(set), &set) != 0) return cores;
  for (int core = 0; core < CPU_SETSIZE; ++core) {
    if (CPU_ISSET(core, &set)) cores.push_back(core);
  }
  return cores;
}

Expected<std::vector<std::string>> names_of(const EvaluationConfig& config) {
  if (!config.sequences.empty()) return config.sequences;
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(config.root / "sequences", error)) {
    if (fs::is_directory(entry.path() / "labels", error)) {
      names.push_back(entry.path().filename().string());
    }
  }
  std::ranges::sort(names);
  if (!names.empty()) return names;
  return fail(ErrorCode::kNotFound, fmt::format("expected {}/sequences/NN with velodyne/ and "
                                                "labels/, found no such folder",
                                                config.root.string()));
}

Expected<Sequence> open_sequence(const EvaluationConfig& config, const std::string& name) {
  auto reader = ScanReader::open(config.root / "sequences" / name);
  if (!reader) return tl::unexpected(reader.error());
  const auto fitted = reader->fit_rings();
  if (!fitted) return tl::unexpected(fitted.error());
  Sequence sequence{name, *std::move(reader), firmware_io::hdl64e_calibration(fitted->table), {}};
  sequence.profile = calib::ring_profile(sequence.calibration, config.mount);
  return sequence;
}

class Run {
 public:
  Run(const EvaluationConfig& config, Journal* journal,
      const std::function<void(std::size_t, std::size_t)>& on_progress,
      const std::function<bool()>& stop_wanted)
      : config_(config), journal_(journal), on_progress_(on_progress), stop_wanted_(stop_wanted) {}

  Expected<EvaluationOutcome> run() {
    const auto names = names_of(config_);
    if (!names) return tl::unexpected(names.error());
    if (journal_ != nullptr) take_from_journal();
    open_sequences(*names);
    list_work();
    label_all();
    if (failure_) return tl::unexpected(*failure_);
    outcome_.interrupted = next_ < work_.size() && stop_wanted_();
    for (auto& [key, fault] : faults_) outcome_.faults.push_back(std::move(fault));
    return std::move(outcome_);
  }

 private:
  void take_from_journal() {
    for (auto& [key, result] : journal_->take_results()) {
      const bool asked = std::ranges::any_of(
          config_.methods, [&](const MethodChoice& method) { return method.name == key.method; });
      if (asked) outcome_.results.emplace(key, result);
    }
  }

  void open_sequences(const std::vector<std::string>& names) {
    for (const std::string& name : names) {
      auto sequence = open_sequence(config_, name);
      if (sequence) {
        sequences_.push_back(std::make_unique<Sequence>(*std::move(sequence)));
      } else {
        const fs::path folder = config_.root / "sequences" / name;
        faults_[{name, ""}] = {folder.string(), sequence.error().message};
      }
    }
  }

  void list_work() {
    for (const auto& sequence : sequences_) {
      const FrameRange& frames = config_.frames;
      for (std::size_t i = frames.first; i < sequence->reader.size() && i <= frames.last;
           i += frames.step) {
        work_.push_back({sequence.get(), i});
      }
    }
  }

  void label_all() {
    const std::vector<int> cores = allowed_cores();
    const std::size_t most = std::max<std::size_t>(1, cores.size());
    const std::size_t jobs = config_.jobs > 0 ? static_cast<std::size_t>(config_.jobs) : most;
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < std::min(jobs, work_.size()); ++i) {
      threads.emplace_back([this, i, &cores] {
        rt::ThreadWish wish{.name = fmt::format("tc-eval-{}", i), .scheduling = {}, .core = {}};
        if (!cores.empty()) wish.core = cores[i % cores.size()];
        (void)rt::set_up_this_thread(wish);  // a core that is refused costs accuracy of times only
        label_some();
      });
    }
  }

  void label_some() {
    const Sequence* at = nullptr;
    std::unique_ptr<FrameLabeller> labeller;
    firmware_io::KittiScan scan;
    firmware_io::RingRecovery rings;
    while (!stop_ && !stop_wanted_()) {
      const std::size_t i = next_++;
      if (i >= work_.size()) return;
      const Work& work = work_[i];
      const auto wanted = methods_without_result(work);
      if (!wanted.empty()) {
        if (at != work.sequence) {
          at = work.sequence;
          labeller = std::make_unique<FrameLabeller>(config_.methods, at->calibration, at->profile,
                                                     config_.through_packets);
        }
        label_frame(work, wanted, *labeller, scan, rings);
      }
      const std::scoped_lock lock(mutex_);
      on_progress_(++done_, work_.size());
    }
  }

  std::vector<std::size_t> methods_without_result(const Work& work) {
    std::vector<std::size_t> wanted;
    const std::scoped_lock lock(mutex_);
    for (std::size_t i = 0; i < config_.methods.size(); ++i) {
      if (!outcome_.results.contains(key_of(work, config_.methods[i].name))) wanted.push_back(i);
    }
    return wanted;
  }

  [[nodiscard]] static FrameKey key_of(const Work& work, const std::string& method) {
    return {work.sequence->name, work.sequence->reader.file(work.scan).name, method};
  }

  void label_frame(const Work& work, const std::vector<std::size_t>& methods,
                   FrameLabeller& labeller, firmware_io::KittiScan& scan,
                   firmware_io::RingRecovery& rings) {
    const firmware_io::ScanFile& file = work.sequence->reader.file(work.scan);
    if (!file.labels) return note(work, file.points.string() + ": there is no label file for it");
    if (const Status read = work.sequence->reader.read(work.scan, scan, rings); !read) {
      return note(work, read.error().message);
    }
    if (const Status placed = labeller.place(scan, rings); !placed) {
      return note(work, file.points.string() + ": " + placed.error().message);
    }
    for (const std::size_t i : methods) {
      const FrameKey key = key_of(work, config_.methods[i].name);
      FrameResult result = labeller.label(i);
      result.rings_realigned = rings.aligned;
      if (!keep(key, labeller.points(), std::move(result))) return;
    }
  }

  bool keep(const FrameKey& key, std::span<const pipeline::Label> labels, FrameResult result) {
    Status kept;
    if (!config_.predictions.empty()) {
      kept =
          firmware_io::write_label_file(config_.predictions / key.method / "sequences" /
                                            key.sequence / "predictions" / (key.frame + ".label"),
                                        labels);
    }
    if (kept && journal_ != nullptr) kept = journal_->add(key, result);
    const std::scoped_lock lock(mutex_);
    if (kept) {
      outcome_.results.insert_or_assign(key, std::move(result));
    } else if (!failure_) {
      failure_ = kept.error();
      stop_ = true;
    }
    return kept.has_value();
  }

  void note(const Work& work, std::string what) {
    const firmware_io::ScanFile& file = work.sequence->reader.file(work.scan);
    const std::scoped_lock lock(mutex_);
    faults_[{work.sequence->name, file.name}] = {file.points.string(), std::move(what)};
  }

  const EvaluationConfig& config_;
  Journal* journal_;
  const std::function<void(std::size_t, std::size_t)>& on_progress_;
  const std::function<bool()>& stop_wanted_;

  std::vector<std::unique_ptr<Sequence>> sequences_;
  std::vector<Work> work_;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<bool> stop_ = false;

  std::mutex mutex_;  ///< Guards what follows.
  std::size_t done_ = 0;
  EvaluationOutcome outcome_;
  std::map<std::pair<std::string, std::string>, Fault> faults_;  ///< By sequence and frame.
  std::optional<Error> failure_;
};

}  // namespace

Expected<EvaluationOutcome> evaluate(
    const EvaluationConfig& config, Journal* journal,
    const std::function<void(std::size_t, std::size_t)>& on_progress,
    const std::function<bool()>& stop_wanted) {
  return Run(config, journal, on_progress, stop_wanted).run();
}

}  // namespace terracut::evaluation
