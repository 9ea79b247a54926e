// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "simulated_evaluation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <thread>
#include <utility>

#include "calib/mount/ring_profile.hpp"
#include "firmware_io/capture/capture_source.hpp"
#include "firmware_io/decode/decoder.hpp"
#include "firmware_io/frame/each_return.hpp"
#include "firmware_io/scan/label_file.hpp"
#include "method_bench.hpp"
#include "pinned_thread.hpp"
#include "pipeline/ground/mount_search.hpp"
#include "result_keeper.hpp"
#include "rt/measure/thread_cpu_clock.hpp"
#include "rt/threads/thread_setup.hpp"
#include "tools/cli/files/temporary_folder.hpp"
#include "tools/lab/drive/drive_writer.hpp"
#include "tools/lab/scenes/scene_names.hpp"
#include "tools/lab/simulator/drive.hpp"

namespace terracut::eval {
namespace {

namespace fs = std::filesystem;
using frame::FrameInfo;
using packets::ReturnMode;

constexpr double kSpin_hz = 10;

std::size_t frames_of(const SimulatedDrives& drives) {
  return static_cast<std::size_t>(std::max(1L, std::lround(drives.duration_s * kSpin_hz)));
}

bool is_wanted(const FrameRange& frames, std::size_t frame) {
  return frame >= frames.first && frame <= frames.last && (frame - frames.first) % frames.step == 0;
}

std::string name_of(std::size_t frame) {
  return fmt::format("{:06}", frame);
}

/// Checks the names first, because the simulation takes long.
Status check_scenes(const std::vector<std::string>& scenes) {
  const auto known = scenes::scene_names();
  for (auto scene = scenes.begin(); scene != scenes.end(); ++scene) {
    if (std::ranges::find(known, *scene) == known.end()) {
      return fail(ErrorCode::kInvalidArgument,
                  fmt::format("there is no scene '{}'; expected one or more of: {}", *scene,
                              fmt::join(known, ",")));
    }
    if (std::find(scenes.begin(), scene, *scene) != scene) {
      return fail(ErrorCode::kInvalidArgument,
                  fmt::format("scene '{}' stands there a second time", *scene));
    }
  }
  return {};
}

decode::Decoder::Config decoder_config(int columns) {
  decode::Decoder::Config config;
  config.columns = columns;
  return config;
}

/// Estimates the mount as a run does, from the first ten frames of the drive.
Expected<mount::FoundMount> mount_of(const fs::path& capture,
                                     const calib::SensorCalibration& calibration, int columns) {
  auto source = capture::CaptureSource::open(capture);
  if (!source) return tl::unexpected(source.error());
  memory::FixedMemory memory;
  decode::Decoder decoder(calibration, mount::kAtTheSensor, decoder_config(columns), memory);
  frame::PointImage points = decoder.point_image(memory);
  ground::MountSearch search;
  for (bool is_over = false; !is_over && !search.has_enough_frames();) {
    const auto next = source->next();
    if (!next) return tl::unexpected(next.error());
    is_over = !*next;
    if (is_over) {
      decoder.end_stream();
    } else {
      decoder.push(**next);
    }
    while (const frame::Frame* frame = decoder.next()) {
      search.add_frame(points.make(*frame->returns));
    }
  }
  return search.found();
}

/// Evaluates one drive on disk, from packets to counts. Used by one thread.
class DriveEvaluation {
 public:
  DriveEvaluation(const SimulatedConfig& config, const mount::Mount& mount, std::string scene,
                  fs::path truth, const calib::SensorCalibration& calibration, int columns,
                  ResultKeeper& keeper, std::function<void()> on_frame_done)
      : config_(config),
        scene_(std::move(scene)),
        truth_folder_(std::move(truth)),
        decoder_(calibration, mount, decoder_config(columns), memory_),
        points_(decoder_.point_image(memory_)),
        profile_(calib::ring_profile(calibration, mount)),
        bench_(config.methods, profile_, decoder_.shape(), decoder_.return_capacity(), memory_),
        keeper_(keeper),
        on_frame_done_(std::move(on_frame_done)) {}

  Status run(const fs::path& capture, const std::function<bool()>& stop_wanted) {
    auto source = capture::CaptureSource::open(capture);
    if (!source) return tl::unexpected(source.error());
    while (!stop_wanted() && !keeper_.failure()) {
      const auto next = source->next();
      if (!next) return tl::unexpected(next.error());
      resumed_ns_ = measure::thread_cpu_ns();
      if (*next) {
        decoder_.push(**next);
      } else {
        decoder_.end_stream();
      }
      take_frames();
      if (!*next) return {};
    }
    return {};
  }

  [[nodiscard]] std::vector<Fault> take_faults() { return std::move(faults_); }

 private:
  void take_frames() {
    const frame::Frame* frame = decoder_.next();
    for (; frame != nullptr; frame = decoder_.next()) {
      const frame::RangeImage& image = points_.make(*frame->returns);
      decode_ns_ += measure::thread_cpu_ns() - resumed_ns_;
      take(frame->info, image);
      decode_ns_ = 0;
      resumed_ns_ = measure::thread_cpu_ns();
    }
    decode_ns_ += measure::thread_cpu_ns() - resumed_ns_;
  }

  void take(const FrameInfo& info, const frame::RangeImage& image) {
    if (!is_wanted(config_.frames, info.number)) return;
    const std::string frame = name_of(info.number);
    const auto left = keeper_.methods_left(scene_, frame);
    if (!left.empty()) label(frame, image, left);
    on_frame_done_();
  }

  void label(const std::string& frame, const frame::RangeImage& image,
             const std::vector<std::size_t>& methods) {
    const fs::path file = truth_folder_ / (frame + ".label");
    if (const Status read = scan::read_label_file(file, image.returns(), truth_); !read) {
      faults_.push_back({scene_ + "/" + frame, read.error().message});
      return;
    }
    for (const std::size_t i : methods) {
      FrameResult result;
      result.times = bench_.segment(i, image);
      result.times.decode_ns = decode_ns_;
      result.points = truth_.size();
      count(image, bench_.labels(i), result.counts);
      if (!keeper_.keep({scene_, frame, config_.methods[i].name}, bench_.labels(i),
                        std::move(result))) {
        return;
      }
    }
    if (config_.on_labelled && methods.size() == config_.methods.size()) {
      config_.on_labelled({scene_, frame, image, profile_, truth_,
                           [&](std::size_t i) { return bench_.labels(i); },
                           [&](std::size_t i) -> decltype(auto) { return bench_.planes(i); }});
    }
  }

  void count(const frame::RangeImage& image, std::span<const frame::Label> labels,
             statistics::FrameCounts& counts) const {
    frame::for_each_return(image, [&](const frame::PlacedReturn& placed) {
      counts.add(scan::semantic_class(truth_[placed.return_index]),
                 statistics::range_band(placed.point.ground_range_m), labels[placed.return_index]);
    });
  }

  const SimulatedConfig& config_;
  std::string scene_;
  fs::path truth_folder_;
  memory::FixedMemory memory_;
  decode::Decoder decoder_;
  frame::PointImage points_;
  mount::RingProfile profile_;
  MethodBench bench_;
  ResultKeeper& keeper_;
  std::function<void()> on_frame_done_;

  std::vector<std::uint32_t> truth_;  ///< Of the current frame, by return index.
  std::vector<Fault> faults_;
  std::int64_t decode_ns_ = 0;   ///< For the current frame.
  std::int64_t resumed_ns_ = 0;  ///< Start of the current decoding.
};

/// Evaluates all drives of one kind of sensor, one after the other.
template <class EncoderTraits>
class Run {
 public:
  Run(const SimulatedConfig& config, Journal* journal, const SimulatedProgress& progress,
      const std::function<bool()>& stop_wanted)
      : config_(config),
        progress_(progress),
        stop_wanted_(stop_wanted),
        keeper_(config.methods, config.predictions, journal) {
    for (std::size_t i = 0; i < frames_of(config.drives); ++i) {
      if (!is_wanted(config.frames, i)) continue;
      ++frames_per_drive_;
      for (const std::string& scene : config.drives.scenes) keeper_.expect(scene, name_of(i));
    }
  }

  Expected<EvaluationOutcome> run() {
    for (const std::string& scene : config_.drives.scenes) {
      if (stop_wanted_()) break;
      if (is_done(scene)) {
        done_ += frames_per_drive_;
        progress_.evaluated(done_, frames());
      } else if (const Status status = evaluate_scene(scene); !status) {
        return tl::unexpected(status.error());
      }
      ++scenes_begun_;
    }
    if (const auto failure = keeper_.failure()) return tl::unexpected(*failure);
    outcome_.interrupted = done_ < frames() && stop_wanted_();
    outcome_.results = keeper_.take_results();
    return std::move(outcome_);
  }

 private:
  [[nodiscard]] std::size_t frames() const {
    return frames_per_drive_ * config_.drives.scenes.size();
  }

  [[nodiscard]] bool is_done(const std::string& scene) const {
    for (std::size_t i = 0; i < frames_of(config_.drives); ++i) {
      if (is_wanted(config_.frames, i) && !keeper_.methods_left(scene, name_of(i)).empty()) {
        return false;
      }
    }
    return true;
  }

  Status evaluate_scene(const std::string& scene) {
    const cli::TemporaryFolder scratch;
    if (scratch.path().empty()) {
      return fail(ErrorCode::kWriteFailed, "no temporary folder can be made for the drive");
    }
    const fs::path capture = scratch.path() / "drive.pcap";
    const auto calibration =
        packets::unit_in_mode<EncoderTraits>(EncoderTraits::nominal(), returns(), kSpin_hz);
    const auto simulated = simulate(scene, capture, calibration);
    if (!simulated) return tl::unexpected(simulated.error());
    if (!*simulated) return {};

    const int columns = packets::image_columns<EncoderTraits>(kSpin_hz, returns());
    mount::Mount mount = config_.mount;
    if (config_.find_mount) {
      const auto found = mount_of(capture, calibration, columns);
      if (!found) return tl::unexpected(found.error());
      mount = outcome_.found_mounts.insert_or_assign(scene, *found).first->second.mount;
    }
    DriveEvaluation drive(config_, mount, scene, drive::truth_folder_of(capture), calibration,
                          columns, keeper_, [this] { progress_.evaluated(++done_, frames()); });
    Status status;
    // Evaluates the drive on a thread that is pinned to one core. The thread ends before the next
    // drive is simulated, which uses all cores.
    std::thread([&] {
      pin_this_thread("tc-eval-0", threads::allowed_cores(), 0);
      status = drive.run(capture, stop_wanted_);
    }).join();
    for (Fault& fault : drive.take_faults()) outcome_.faults.push_back(std::move(fault));
    return status;
  }

  [[nodiscard]] ReturnMode returns() const {
    return config_.drives.dual_return ? ReturnMode::kDual : ReturnMode::kSingle;
  }

  /// Simulates a drive. Returns false if it was interrupted.
  Expected<bool> simulate(const std::string& scene, const fs::path& capture,
                          const typename EncoderTraits::Calibration& calibration) {
    simulator::SimulationConfig<EncoderTraits> config;
    config.scene = scene;
    config.seed = config_.drives.seed;
    config.duration_s = config_.drives.duration_s;
    config.spin_hz = kSpin_hz;
    config.mount = config_.mount;
    config.threads = static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1U, 64U));
    config.calibration = calibration;
    config.sensor.returns = returns();
    auto writer = drive::DriveWriter<EncoderTraits>::create(capture, calibration, config.sensor);
    if (!writer) return tl::unexpected(writer.error());
    bool stopped = false;
    const double before_s = config.duration_s * static_cast<double>(scenes_begun_);
    const double of_s = config.duration_s * static_cast<double>(config_.drives.scenes.size());
    const auto simulated = simulator::simulate_drive(
        config, [&](const simulator::SimulatedColumn<EncoderTraits>& column) -> Status {
          stopped = stop_wanted_();
          if (stopped) return fail(ErrorCode::kNothingCameOut, "interrupted");
          progress_.simulated_s(before_s + std::clamp(column.time_s, 0.0, config.duration_s), of_s);
          return writer->add_column(column.wire.stamp_ns, column.wire.unwrapped_azimuth_cdeg,
                                    column.wire.by_laser);
        });
    if (stopped) return false;
    if (!simulated) return tl::unexpected(simulated.error());
    const auto written = writer->finish();
    if (!written) return tl::unexpected(written.error());
    return true;
  }

  const SimulatedConfig& config_;
  const SimulatedProgress& progress_;
  const std::function<bool()>& stop_wanted_;
  ResultKeeper keeper_;
  std::size_t frames_per_drive_ = 0;
  std::size_t scenes_begun_ = 0;
  std::size_t done_ = 0;
  EvaluationOutcome outcome_;
};

}  // namespace

Expected<EvaluationOutcome> evaluate_simulated(const SimulatedConfig& config, Journal* journal,
                                               const SimulatedProgress& progress,
                                               const std::function<bool()>& stop_wanted) {
  if (const Status checked = check_scenes(config.drives.scenes); !checked) {
    return tl::unexpected(checked.error());
  }
  return packets::with_encoder_traits(config.drives.sensor, [&](auto traits) {
    return Run<decltype(traits)>(config, journal, progress, stop_wanted).run();
  });
}

}  // namespace terracut::eval
