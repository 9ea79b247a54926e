// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Of captures and recorded scans, without a sensor.
#include <CLI/CLI.hpp>

#include "command_options.hpp"
#include "option_checks.hpp"
#include "option_groups.hpp"

namespace terracut::cli {

void add_replay(CLI::App& sub, ReplayOptions& o) {
  add_capture(sub, o.capture);
  add_mount(sub, o.mount);
  add_method(sub, o.method);
  add_rivals(sub, o.method);
  add_outputs(sub, o.output);
  sub.add_option("--truth", o.output.truth,
                 "Folder of NNNNNN.label: print IoU_g and Recall_o, draw mistakes");
  sub.add_option("--rate", o.rate, "Pace by the capture's stamps: 1 as recorded, 0 flat out")
      ->check(range_of("replay.rate"))
      ->capture_default_str();
  add_loop(sub, o.loops);
  CLI::Option* can = sub.add_option(
      "--can", o.can,
      "Recording of the vehicle's CAN bus (candump log or capture) on the clock of the "
      "packets' stamps: its motion is taken out of every turn");
  add_motion(sub, can, o.motion);
}

void add_segment(CLI::App& sub, SegmentOptions& o) {
  sub.add_option("SCANS_DIR", o.scans, "Folder of .bin scans, or a SemanticKITTI sequence folder")
      ->required();
  sub.add_option("--calibration", o.calibration,
                 "Table of the unit that recorded them (default: one fitted to the scans)");
  add_mount(sub, o.mount);
  add_method(sub, o.method);
  add_rivals(sub, o.method);
  add_outputs(sub, o.output);
}

void add_encode(CLI::App& sub, EncodeOptions& o) {
  add_sensor(sub, o.sensor);
  sub.add_option("SCANS_DIR", o.scans, "Folder of .bin scans, or a SemanticKITTI sequence folder")
      ->required();
  sub.add_option("--calibration", o.calibration,
                 "Unit to encode through (default: one fitted to the scans; Ruby128: nominal)");
  auto* undo = sub.add_flag("--undo-compensation", o.undo_compensation,
                            "Put the sensor's motion back into the points, by poses.txt and "
                            "times.txt; refuse where they are not there (default: where they are)");
  auto* keep = sub.add_flag("--keep-compensation", o.keep_compensation,
                            "Take the points as they are recorded, poses or not")
                   ->excludes(undo);
  sub.add_flag("--can-log", o.can_log,
               "HDL-64E: write that motion beside the capture, NAME.can.log and NAME.can.dbc; the "
               "sensor then looks backwards, for recorded turns begin behind")
      ->excludes(keep);
  sub.add_option("-o,--output", o.output, "Capture to write; its table and truth go beside it")
      ->required();
}

void add_calibrate(CLI::App& sub, CalibrateOptions& o) {
  add_capture(sub, o.capture);
  add_mount(sub, o.mount);
  add_method(sub, o.method);
  refuse_rivals(sub, "a setup is measured with the method that `terracut live` runs with it: ours");
  sub.add_flag("--keep-mount", o.keep_mount,
               "Take the mount as given; only measure the rings' ground distances");
  sub.add_option("-o,--output", o.output, "Setup file to write, for --setup")->required();
}

void add_info(CLI::App& sub, InfoOptions& o) {
  sub.add_option("FILE", o.file, "Any capture, pcap or pcapng")->required();
  sub.add_option("--json", o.json, "The same as a file for programs");
}

void add_plan(CLI::App& sub, PlanOptions& o) {
  add_sensor(sub, o.sensor);
  add_method(sub, o.method);
  add_rivals(sub, o.method);
  sub.add_option("--json", o.json, "The same as a file for programs");
}

void add_bench(CLI::App& sub, BenchOptions& o) {
  add_capture(sub, o.capture);
  add_mount(sub, o.mount);
  add_method(sub, o.method);
  add_rivals(sub, o.method);
  sub.add_option("--repeat", o.repeat, "Passes over the capture")
      ->check(range_of("bench.repeat"))
      ->capture_default_str();
  sub.add_option("--core", o.core, "Processor core to stay on (default: the last one allowed)")
      ->check(CLI::Range(0, 4095));
  sub.add_option("--json", o.json, "The same as a file for programs");
}

}  // namespace terracut::cli
