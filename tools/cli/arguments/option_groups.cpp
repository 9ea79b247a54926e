// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "option_groups.hpp"

#include <CLI/CLI.hpp>

#include <limits>

#include "option_checks.hpp"
#include "pipeline/parameter_table.hpp"
#include "tools/cli/setup_choice.hpp"

namespace terracut::cli {

void add_decoding(CLI::App& app, CaptureOptions& capture) {
  app.add_option("--sensor", capture.sensor, "Sensor model (default: the one found)")
      ->check(one_of("sensor.model"))
      ->capture_default_str();
  app.add_option("--from", capture.from, "Only datagrams of this IPv4 address")
      ->check(CLI::ValidIPV4);
  app.add_option("--calibration", capture.calibration,
                 "The unit's table: db.xml or yaml of an HDL-64E, angle.csv of a Ruby128 (default: "
                 "the one in the packets)");
  app.add_flag(
      "--nominal-calibration", capture.nominal_calibration,
      "Ruby128: take the model's table where there is none of the unit; heights may be off");
  app.add_option("--columns", capture.columns,
                 "Columns of the range image (default: firings a turn at the spin rate found)")
      ->check(range_of("sensor.columns"));
  app.add_option("--cell-owner", capture.cell_owner,
                 "Dual return: which return stands for its cell; all of them are labelled")
      ->check(one_of("sensor.cell_owner"))
      ->capture_default_str();
  app.add_option("--timestamp", capture.timestamp,
                 "Ruby128: how its stamps are encoded (default: found out from the packets)")
      ->check(one_of("sensor.timestamp"))
      ->capture_default_str();
  app.add_option("--clock-offset", capture.clock_offset_s,
                 "Seconds to add to the device's clock where it is reported")
      ->check(range_of("sensor.clock_offset_s"));
  app.add_option("--geometry", capture.geometry,
                 "Meaning of the table: the maker's manual, or as ROS drivers take it")
      ->check(one_of("sensor.geometry"))
      ->capture_default_str();
  app.add_option("--reorder-packets", capture.reorder_packets,
                 "How many packets late one may come and still find its turn, which waits for it "
                 "(default: captures 2, live 0)")
      ->check(range_of("input.reorder_packets"));
}

void add_capture(CLI::App& app, CaptureOptions& capture) {
  app.add_option("FILE", capture.file, "Capture of HDL-64E or RS-Ruby128 packets, pcap or pcapng")
      ->required();
  app.add_option("--port", capture.port, "Only UDP datagrams to this port (default: any)");
  add_decoding(app, capture);
  app.add_option("--start", capture.start_s, "Skip this many seconds of the capture")
      ->check(range_of("input.start_s"));
  app.add_option("--duration", capture.duration_s, "Stop after this many seconds of the capture")
      ->check(range_of("input.duration_s"));
}

void add_mount(CLI::App& app, MountOptions& mount) {
  app.add_option("--setup", mount.setup, "Mount and ring distances found by `terracut calibrate`");
  app.add_option("--mount-height", mount.height_m,
                 "Metres from the ground to the sensor's origin (default 1.73)")
      ->check(range_of("mount.height_m"));
  app.add_option("--mount-roll", mount.roll_deg, "Degrees, left side up (default 0)")
      ->check(range_of("mount.roll_deg"));
  app.add_option("--mount-pitch", mount.pitch_deg, "Degrees, looking down in front (default 0)")
      ->check(range_of("mount.pitch_deg"));
}

void add_settings(CLI::App& app, std::vector<std::string>& settings) {
  app.add_option(
         "--set", settings,
         "KEY=VALUE, any parameter of the method (`terracut parameters` lists them); repeatable")
      ->check([](const std::string& setting) {
        pipeline::MethodConfig scratch;
        const Status valid = pipeline::apply_setting(scratch, setting);
        return valid ? std::string() : valid.error().message;
      })
      ->allow_extra_args(false);
}

void add_method(CLI::App& app, MethodOptions& method) {
  app.add_option("--profile", method.profile,
                 "paper: the method as printed; terracut: what measured better")
      ->check(one_of("method.profile"))
      ->capture_default_str();
  app.add_option("--stages", method.stages,
                 "How far to refine: elevation map, + adjacent points, + random field (mrf)")
      ->check(one_of("method.stages"))
      ->capture_default_str();
  add_settings(app, method.settings);
}

void add_motion(CLI::App& app, CLI::Option* can, MotionOptions& motion) {
  CLI::Option* dbc = app.add_option(
      "--dbc", motion.dbc,
      "DBC file that says what the CAN frames mean; section motion of the configuration names the "
      "signals (default: as `terracut simulate --can-log` does)");
  CLI::Option* to =
      app.add_option("--deskew-to", motion.deskew_to,
                     "Instant of the turn at which all its returns are to lie where they were")
          ->check(one_of("motion.deskew_to"))
          ->capture_default_str();
  if (can == nullptr) return;
  dbc->needs(can);
  to->needs(can);
}

void add_rivals(CLI::App& app, MethodOptions& method) {
  std::string about = "Ours or a rival by name, instead of --profile and --stages:";
  std::vector<std::string> names;
  for (const pipeline::MethodName& known : pipeline::method_names()) {
    names.emplace_back(known.name);
    about += "\n  " + names.back() + ": " + std::string(known.about);
  }
  app.add_option("--method", method.method, about)
      ->check(CLI::IsMember(names))
      ->excludes(app.get_option("--profile"))
      ->excludes(app.get_option("--stages"));
}

void refuse_rivals(CLI::App& app, const std::string& why) {
  app.add_option_function<std::string>(
         "--method", [why](const std::string&) { throw CLI::ValidationError("--method", why); })
      ->group("");
}

void add_outputs(CLI::App& app, OutputOptions& output) {
  app.add_option("--labels", output.labels, "Folder for NNNNNN.label, SemanticKITTI predictions");
  app.add_option("--pcd", output.pcd, "Folder for NNNNNN.pcd: x y z intensity ring label");
  app.add_option("--png", output.png, "Folder for pictures: from above and as the sensor sees it");
  app.add_option("--json", output.json, "File for the report: returns, losses and times by frame");
}

void add_sensor(CLI::App& app, std::string& sensor) {
  app.add_option("--sensor", sensor, "Sensor model")
      ->check(CLI::IsMember({"hdl64e", "ruby128"}))
      ->capture_default_str();
}

CLI::Option* add_loop(CLI::App& app, int& loops) {
  return app
      .add_option("--loop", loops,
                  "Passes over the packets (once without this option); no number or 0: until "
                  "interrupted")
      ->expected(0, 1)
      ->default_str("0")
      ->check(CLI::Range(0, std::numeric_limits<int>::max()));
}

std::vector<CLI::Option*> add_sending(CLI::App& app, SendOptions& options) {
  return {
      app.add_option("--interface", options.interface,
                     "Send by this interface (default: by the routes)"),
      add_loop(app, options.loops),
      app.add_option("--faults", options.faults,
                     "What goes wrong on the way, by seconds since the first packet:\n"
                     "loss@2.5s:20packets reorder@4s:3 duplicate@4.5s:2 pause@5s:0.4s "
                     "burst@6s:50ms\nforeign@7s:50 clock@8s:+2.0s truncate@9s:5"),
      app.add_option("--foreign-from", options.foreign_from,
                     "Address of this machine that foreign packets come from")
          ->check(CLI::ValidIPV4),
      app.add_option("--json", options.json,
                     "File for the summary: sent, lateness, what each fault did"),
  };
}

}  // namespace terracut::cli
