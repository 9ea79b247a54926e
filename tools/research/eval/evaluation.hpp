// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "calib/mount/mount_finder.hpp"
#include "frame_result.hpp"
#include "journal.hpp"
#include "method_choice.hpp"
#include "rt/error.hpp"
#include "tools/research/datasets/class_table.hpp"
#include "tools/research/datasets/dataset.hpp"
#include "tools/research/eval/labelled_by_all.hpp"

namespace terracut::eval {

/// Frames of a sequence by index: first, first + step, and so on up to last.
struct FrameRange {
  std::size_t first = 0;
  std::size_t last = SIZE_MAX;
  std::size_t step = 1;  ///< >= 1
};

struct EvaluationConfig {
  datasets::CloudLayout layout;
  std::filesystem::path root;          ///< Folder of the dataset.
  std::vector<std::string> sequences;  ///< Names of sequences; empty: all with labels.
  FrameRange frames;
  std::vector<MethodChoice> methods;
  mount::Mount mount;
  bool find_mount = false;  ///< Finds the mount of each sequence; else uses `mount`.
  bool through_packets = false;
  int jobs = 0;  ///< Threads, each on its own core; 0: one per core.
  /// States which classes are tall or immobile; if null, neither is counted. Must outlive the run.
  const datasets::ClassTable* classes = nullptr;
  std::filesystem::path predictions;  ///< Folder; empty: none are written.
  LabelledByAllSink on_labelled;  ///< Receives every frame that all methods label; may be empty.
};

/// A frame, file or sequence that could not be evaluated.
struct Fault {
  std::string where;  ///< File or folder.
  std::string what;
};

struct EvaluationOutcome {
  FrameResults results;       ///< Without faulty frames.
  std::vector<Fault> faults;  ///< Faults in order of sequence and frame.
  std::map<std::string, mount::FoundMount> found_mounts;  ///< Keyed by sequence.
  bool interrupted = false;
};

/// Labels every frame of a dataset with every method and counts the labels. A sequence whose mount
/// is not found is a fault as a whole. An unreadable file is a fault, and the work goes on. Results
/// in `journal` are kept. Methods remember earlier frames, so one thread labels 32 successive
/// frames in order; if any of the 32 is not in the journal, all of them are labelled again. Faulty
/// frames are not in the journal. Predictions are written to
/// `<predictions>/<method>/sequences/NN/predictions/NNNNNN.label`.
///
/// `on_progress(done, of)` is called from any thread, one call at a time; `stop_wanted()` is asked
/// between frames. Results depend neither on the number of jobs nor on interruptions; times do.
///
/// Fails with kNotFound if there is no sequence; kUnsupported as Dataset::at() does, or for packets
/// of another sensor than an HDL-64E; kWriteFailed if predictions or journal cannot be written.
[[nodiscard]] Expected<EvaluationOutcome> evaluate(
    const EvaluationConfig& config, Journal* journal,
    const std::function<void(std::size_t, std::size_t)>& on_progress,
    const std::function<bool()>& stop_wanted);

}  // namespace terracut::eval
