// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "dump_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <type_traits>
#include <utility>
#include <variant>

#include "calib/hesai/hesai_csv.hpp"
#include "calib/ouster/ouster_metadata.hpp"
#include "calib/robosense/unit_table.hpp"
#include "rt/caught.hpp"
#include "tools/cli/console.hpp"
#include "tools/lab/packets/hdl64e_encoder_traits.hpp"
#include "tools/lab/packets/ruby128_encoder_traits.hpp"

namespace terracut::cli {

using recorder::DumpReason;

namespace {

/// The encoder traits of the sensor whose calibration has this type.
template <class Calibration>
using EncoderTraitsOf =
    std::conditional_t<std::is_same_v<Calibration, hdl64e::Hdl64eCalibration>,
                       packets::Hdl64eEncoderTraits, packets::Ruby128EncoderTraits>;

}  // namespace

recorder::DumpFolderLimits dump_folder_of(const Options& options) {
  return {.folder = options.recorder.folder, .name = options.watch.name};
}

DumpWriter::DumpWriter(const Options& options, calib::SensorCalibration calibration,
                       recorder::FlightRecorder& recorder,
                       std::span<const std::string_view> stage_names, DumpAnswers& answers)
    : calibration_(std::move(calibration)),
      recorder_(recorder),
      stage_names_(stage_names),
      policy_({.folder = dump_folder_of(options)}),
      answers_(answers),
      thread_([this] { work(); },
              [](std::string_view why) { warn(fmt::format("no more dumps: {}", why)); }) {}

void DumpWriter::want(DumpReason reason, std::vector<status::FrameRecord> frames) {
  {
    const std::scoped_lock lock(mutex_);
    wanted_[static_cast<std::size_t>(reason)] = true;
    frames_ = std::move(frames);
  }
  changed_.notify_one();
}

bool DumpWriter::finish(std::chrono::milliseconds patience) {
  begin_to_finish();
  return thread_.ends_within(patience);
}

void DumpWriter::begin_to_finish() {
  {
    const std::scoped_lock lock(mutex_);
    finish_ = true;
  }
  changed_.notify_one();
}

void DumpWriter::work() {
  while (true) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock,
                  [this] { return finish_ || std::ranges::find(wanted_, true) != wanted_.end(); });
    const auto wanted = std::exchange(wanted_, {});
    const auto frames = frames_;
    const bool last_round = finish_;
    lock.unlock();
    for (std::size_t reason = 0; reason < wanted.size(); ++reason) {
      if (wanted[reason]) dump(static_cast<DumpReason>(reason), frames);
    }
    if (last_round) return;
  }
}

void DumpWriter::add_table(recorder::DumpReport& dump) const {
  const Status written = std::visit(
      [&]<class Calibration>(const Calibration& unit) -> Status {
        if constexpr (std::is_same_v<Calibration, beams::BeamTable>) {
          if (sensor::has_factory_table(unit.model)) return {};  // the decoder has it, too
          dump.calibration = recorder::dump_calibration_path(dump.capture, ".calibration.csv");
          return sensor::is_robosense(unit.model)
                     ? robosense::write_unit_csv(dump.calibration, unit)
                     : hesai::write_hesai_csv(dump.calibration, unit);
        } else if constexpr (std::is_same_v<Calibration, ouster::OusterCalibration>) {
          dump.calibration = recorder::dump_calibration_path(dump.capture, ".calibration.json");
          return ouster::write_ouster_metadata(dump.calibration, unit);
        } else {
          using EncoderTraits = EncoderTraitsOf<Calibration>;
          dump.calibration =
              recorder::dump_calibration_path(dump.capture, EncoderTraits::kCalibrationSuffix);
          return EncoderTraits::write_calibration(dump.calibration, unit);
        }
      },
      calibration_);
  if (written) return;
  warn("the table does not lie beside the dump: " + written.error().message);
  dump.calibration.clear();
}

void DumpWriter::dump(DumpReason reason, const std::vector<status::FrameRecord>& frames) {
  tl::expected<recorder::DumpReport, recorder::RefusedDump> outcome;
  const Status tried = rt::caught([&]() -> Status {
    outcome = recorder_.dump(policy_, reason, {frames, stage_names_});
    return {};
  });
  if (!tried) {
    outcome = tl::unexpected(
        recorder::RefusedDump{recorder::DumpRefusal::kWriteFailed, tried.error().message});
  }
  if (outcome) {
    add_table(*outcome);
    say(fmt::format("dumped {} datagrams to {}", outcome->datagrams, outcome->capture.string()));
  } else if (outcome.error().refusal != recorder::DumpRefusal::kTooSoon) {
    warn("not dumped: " + outcome.error().message);
  }
  if (reason != DumpReason::kAsked) return;
  if (const Status told = answers_.publish(outcome); !told) warn(told.error().message);
}

}  // namespace terracut::cli
