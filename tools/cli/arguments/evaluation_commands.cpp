// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Of labelled datasets.
#include <CLI/CLI.hpp>

#include "command_options.hpp"
#include "option_checks.hpp"
#include "option_groups.hpp"

namespace terracut::cli {

void add_eval(CLI::App& sub, EvalOptions& o) {
  sub.add_option("DATASET", o.dataset, "Layout of the dataset, or drives to simulate")
      ->required()
      ->check(CLI::IsMember({"semantickitti", "koblenz", "simulated"}));
  sub.add_option("ROOT", o.root,
                 "semantickitti: the folder of sequences/NN/{velodyne,labels}\n"
                 "koblenz: the folder of KoblenzForestMap/*.pcd and its like\n"
                 "simulated: scenes, like street,hill")
      ->required();
  sub.add_option("--sequences", o.sequences, "Only these, like 00,03 (default: all with labels)")
      ->delimiter(',');
  sub.add_option("--frames", o.frames,
                 "Only these of every sequence: FIRST, FIRST-LAST or FIRST-LAST:STEP, from 0");
  sub.add_option("--method", o.methods, "Methods to compare, like terracut,paper,ring_map")
      ->delimiter(',')
      ->capture_default_str();
  sub.add_option("--profile", o.methods, "The same, of our own profiles alone: terracut,paper")
      ->delimiter(',')
      ->check(one_of("method.profile"))
      ->excludes("--method");
  sub.add_option("--variant", o.variants,
                 "NAME=METHOD,KEY=VALUE,...: one more, a method with other parameters; repeatable")
      ->allow_extra_args(false);
  add_settings(sub, o.settings);
  sub.add_option("--through", o.through,
                 "image: scans straight into the range image; packets: encoded and decoded first")
      ->check(CLI::IsMember({"image", "packets"}))
      ->default_str("image");
  sub.add_option("--jobs", o.jobs, "Threads, each on a core of its own; 0: one a core")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  add_mount(sub, o.mount);
  sub.add_option("--sensor", o.sensor, "Of simulated: sensor model (default: hdl64e)")
      ->check(CLI::IsMember({"hdl64e", "ruby128"}));
  sub.add_option("--returns", o.returns, "Of simulated (default: single)")
      ->check(CLI::IsMember({"single", "dual"}));
  sub.add_option("--duration", o.duration_s, "Of simulated: seconds a scene (default: 3)")
      ->check(number(0.001, 3600));
  sub.add_option("--seed", o.seed, "Of simulated: the same seed gives the same drive (default: 1)");
  sub.add_option("--classes", o.classes,
                 "What the dataset's classes count as (default: as in the paper)");
  sub.add_option("--predictions", o.predictions,
                 "Folder for METHOD/sequences/NN/predictions/NNNNNN.label");
  sub.add_option("--json", o.json,
                 "File for the results; FILE.journal beside it lets an interrupted run go on");
  sub.add_option("--report", o.report,
                 "Folder for index.html: the paper's tables and figures, and where methods fail");
  sub.add_option("--changes", o.changes,
                 "Folder for pictures: of every method but the first the frame it labels most\n"
                 "differently from the first, METHOD.png, and what they show, changes.json;\n"
                 "every frame is labelled, so there is no journal");
}

void add_compare(CLI::App& sub, CompareOptions& o) {
  sub.add_option("BEFORE", o.before, "Report of `terracut eval --json`")->required();
  sub.add_option("AFTER", o.after, "Another one, of the same frames")->required();
  sub.add_option("--method", o.method, "Method to compare")->capture_default_str();
  sub.add_option("--method-after", o.method_after, "Method of AFTER (default: the same)");
  sub.add_option("--significance", o.significance,
                 "iou_g, recall_o or iou_road worse in the mean of frames, with a smaller\n"
                 "p (frames) than this, leads to exit code 8; times are shown, not judged")
      ->check(number(1e-12, 1))
      ->capture_default_str();
  sub.add_option("--json", o.json, "File for the same, for programs");
}

}  // namespace terracut::cli
