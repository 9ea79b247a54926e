// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "command_files.hpp"

#include <system_error>
#include <variant>

#include "firmware_io/drive/drive_files.hpp"
#include "firmware_io/drive/transmitter.hpp"
#include "firmware_io/motion/vehicle_log.hpp"
#include "rt/file_place.hpp"

namespace terracut::cli {
namespace {

namespace fs = std::filesystem;
using Kind = RunFiles::Kind;

void add_calibration(RunFiles& files, const fs::path& calibration) {
  files.read("--calibration", calibration, "the calibration");
}

void add(RunFiles& files, const CaptureOptions& capture) {
  files.read("FILE", capture.file, "the capture");
  add_calibration(files, capture.calibration);
}

void add(RunFiles& files, const MountOptions& mount) {
  files.read("--setup", mount.setup, "the setup");
}

void add(RunFiles& files, const OutputOptions& output) {
  files.read("--truth", output.truth, "the truth");
  files.write("--labels", output.labels, Kind::kFrames, ".label");
  files.write("--pcd", output.pcd, Kind::kFrames, ".pcd");
  files.write("--png", output.png, Kind::kFrames, ".png");
  files.write("--json", output.json);
}

/// A sequence folder is read in parts, so that results may lie in it; a plain one is read whole.
void add_scans(RunFiles& files, const fs::path& scans) {
  constexpr const char* kPoints = "velodyne";
  std::error_code none;
  const bool is_sequence = fs::is_directory(scans / kPoints, none);
  files.read("SCANS_DIR", is_sequence ? scans / kPoints : scans, "the folder of scans");
  // Of a sequence's points alone the rest of it is not read, and is to be kept all the same.
  const fs::path place = rt::FilePlace(scans).path();
  if (!is_sequence && place.filename() != kPoints) return;
  const fs::path sequence = is_sequence ? scans : place.parent_path();
  files.read("SCANS_DIR", sequence / "labels", "the truth of the scans");
  for (const char* const name : {"poses.txt", "times.txt", "calib.txt"}) {
    files.read("SCANS_DIR", sequence / name, "a part of the sequence");
  }
}

template <class Transmitter>
void add_drive(RunFiles& files, const fs::path& capture, bool can_log) {
  if (capture.empty()) return;
  files.write("--output", capture);
  files.write("the table of --output", firmware_io::calibration_path_of<Transmitter>(capture));
  files.write("the truth of --output", firmware_io::truth_folder_of(capture),
              Kind::kReplacedFolder);
  if (!can_log) return;
  files.write("--can-log", firmware_io::can_log_path_of(capture));
  files.write("--can-log", firmware_io::can_dbc_path_of(capture));
}

void add_drive(RunFiles& files, const std::string& sensor, const fs::path& capture, bool can_log) {
  if (sensor == "ruby128") {
    add_drive<firmware_io::Ruby128Transmitter>(files, capture, can_log);
  } else {
    add_drive<firmware_io::Hdl64eTransmitter>(files, capture, can_log);
  }
}

}  // namespace

RunFiles files_of(const ReplayOptions& options) {
  RunFiles files;
  add(files, options.capture);
  add(files, options.mount);
  files.read("--can", options.can, "the CAN recording");
  files.read("--dbc", options.motion.dbc, "the DBC file");
  add(files, options.output);
  return files;
}

RunFiles files_of(const SegmentOptions& options) {
  RunFiles files;
  add_scans(files, options.scans);
  add(files, options.mount);
  add(files, options.output);
  return files;
}

RunFiles files_of(const SimulateOptions& options) {
  RunFiles files;
  add_calibration(files, options.calibration);
  add(files, options.mount);
  add_drive(files, options.sensor, options.output, options.can_log);
  files.write("--json", options.udp.json);
  return files;
}

RunFiles files_of(const EncodeOptions& options) {
  RunFiles files;
  add_scans(files, options.scans);
  add_calibration(files, options.calibration);
  add_drive(files, options.sensor, options.output, options.can_log);
  return files;
}

RunFiles files_of(const CalibrateOptions& options) {
  RunFiles files;
  add(files, options.capture);
  add(files, options.mount);
  files.write("--output", options.output);
  return files;
}

RunFiles files_of(const InfoOptions& options) {
  RunFiles files;
  files.read("FILE", options.file, "the capture");
  files.write("--json", options.json);
  return files;
}

RunFiles files_of(const PlanOptions& options) {
  RunFiles files;
  files.write("--json", options.json);
  return files;
}

RunFiles files_of(const ParametersOptions&) {
  return {};
}

RunFiles files_of(const BenchOptions& options) {
  RunFiles files;
  add(files, options.capture);
  add(files, options.mount);
  files.write("--json", options.json);
  return files;
}

RunFiles files_of(const SendOptions& options) {
  RunFiles files;
  files.read("FILE", options.file, "the capture");
  files.write("--json", options.json);
  return files;
}

RunFiles files_of(const DumpOptions&) {
  return {};
}

RunFiles files_of(const TopOptions&) {
  return {};
}

RunFiles files_of(const EvalOptions& options) {
  RunFiles files;
  if (options.dataset == "semantickitti") {
    files.read("ROOT", options.root / "sequences", "the dataset");
  } else if (options.dataset != "simulated") {
    files.read("ROOT", options.root, "the dataset");
  }
  add(files, options.mount);
  files.read("--classes", options.classes, "the table of classes");
  files.write("--predictions", options.predictions, Kind::kFolder);
  files.write("--report", options.report, Kind::kFolder);
  files.write("--changes", options.changes, Kind::kFolder);
  files.write("--json", options.json);
  if (!options.json.empty() && options.changes.empty()) {
    files.write("the journal of --json", options.json.string() + ".journal");
  }
  return files;
}

RunFiles files_of(const CompareOptions& options) {
  RunFiles files;
  files.read("BEFORE", options.before, "the report");
  files.read("AFTER", options.after, "the report");
  files.write("--json", options.json);
  return files;
}

RunFiles files_of(const LiveOptions& options) {
  RunFiles files;
  add_calibration(files, options.capture.calibration);
  add(files, options.mount);
  files.read("--dbc", options.motion.dbc, "the DBC file");
  files.write("--labels", options.labels, Kind::kFrames, ".label");
  files.write("--json", options.json);
  files.write("--trace", options.trace);
  files.write("--recorder-folder", options.recorder.folder, Kind::kSharedFolder);
  return files;
}

RunFiles files_of(const ConfigOptions&) {
  return {};
}

RunFiles files_of(const DoctorOptions&) {
  return {};
}

RunFiles files_of(const Command& command, const fs::path& configuration) {
  RunFiles files = std::visit([](const auto& options) { return files_of(options); }, command);
  files.read("--config", configuration, "the configuration");
  return files;
}

}  // namespace terracut::cli
