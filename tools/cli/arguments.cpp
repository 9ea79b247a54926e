// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// The only file that includes CLI11, which takes seconds to compile.
#include "arguments.hpp"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <limits>
#include <memory>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "configuration.hpp"
#include "configuration_file.hpp"
#include "console.hpp"
#include "exit_codes.hpp"
#include "firmware_io/sinks/stream_address.hpp"
#include "setup_choice.hpp"

namespace terracut::cli {
namespace {

constexpr const char* kAbout =
    "terracut: ground or obstacle for every LiDAR return, from the sensor's packets.\n\n"
    "  terracut simulate --scene street --duration 3 -o drive.pcap\n"
    "  terracut info drive.pcap\n"
    "  terracut replay drive.pcap --labels labels --png pictures --json report.json\n";

constexpr const char* kExitCodes =
    "Exit codes: 0 done; 1 internal error; 2 wrong command line; 3 an input was refused;\n"
    "4 an output could not be written; 5 packets were read but no frame came out;\n"
    "6 deadlines were missed; 7 doctor found a problem; 8 a measure got worse.\n"
    "`--config FILE` goes with every command (`terracut config --print-default` prints one).\n"
    "`terracut COMMAND --help` lists a command's options.";

/// A number in [low, high]. Unlike CLI::Range it lets no NaN through.
CLI::Validator number(double low, double high) {
  return CLI::Validator(
      [low, high](std::string& text) {
        double value = 0;
        if (CLI::detail::lexical_cast(text, value) && value >= low && value <= high) {
          return std::string();
        }
        std::ostringstream message;
        message << "expected a number from " << low << " to " << high << ", found '" << text << "'";
        return message.str();
      },
      "");
}

/// What the configuration file allows for the same.
CLI::Validator range_of(std::string_view key) {
  const Setting* setting = find_setting(key);
  return number(setting->least, setting->most);
}
CLI::IsMember one_of(std::string_view key) {
  const auto& choices = find_setting(key)->choices;
  return CLI::IsMember(std::vector<std::string>(choices.begin(), choices.end()));
}

/// What a capture and a live stream have in common.
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
        const Status valid = apply_setting(scratch, setting);
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

/// After add_method(): --profile and --stages choose among ours only.
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

/// The file of --config, before or behind the command, is read before anything else is.
void add_config_option(CLI::App& app) {
  app.add_option_function<std::string>(
         "--config", [](const std::string&) {},
         "Configuration file; the command line wins over it (docs/configuration.md)")
      ->type_name("FILE");
}

/// The command line wins: a setup given there is not moved by the file's height and angles.
void drop_overruled(const CLI::App& sub, MountOptions& mount) {
  if (sub.count("--setup") == 0) return;
  if (sub.count("--mount-height") == 0) mount.height_m.reset();
  if (sub.count("--mount-roll") == 0) mount.roll_deg.reset();
  if (sub.count("--mount-pitch") == 0) mount.pitch_deg.reset();
}

/// The same for parameters of the method: of two settings of one, the last counts.
void put_before(std::vector<std::string>& settings, const std::vector<std::string>& of_file) {
  settings.insert(settings.begin(), of_file.begin(), of_file.end());
}

/// What is read, and where to.
struct Reading {
  CLI::App& app;
  const Configuration& configuration;
  std::optional<Command>& command;
};

/// Makes the subcommand, whose options start from the configuration, and, when it is used, puts
/// them into `reading.command`.
template <class Options, class AddOptions>
void add_command(Reading reading, const char* name, const char* about, AddOptions&& add_options) {
  CLI::App* sub = reading.app.add_subcommand(name, about);
  auto options = std::make_shared<Options>();
  if constexpr (requires { start_from(reading.configuration, *options); }) {
    start_from(reading.configuration, *options);
  }
  add_options(*sub, *options);
  add_config_option(*sub);
  sub->callback([=] {
    if constexpr (requires { options->mount; }) drop_overruled(*sub, options->mount);
    [[maybe_unused]] const std::vector<std::string>& of_file =
        reading.configuration.live.method.settings;
    if constexpr (requires { options->method.settings; })
      put_before(options->method.settings, of_file);
    if constexpr (requires { options->settings; }) put_before(options->settings, of_file);
    reading.command = *options;
  });
}

CLI::Option* add_loop(CLI::App& sub, int& loops) {
  return sub
      .add_option("--loop", loops,
                  "Passes over the packets (once without this option); no number or 0: until "
                  "interrupted")
      ->expected(0, 1)
      ->default_str("0")
      ->check(CLI::Range(0, std::numeric_limits<int>::max()));
}

/// How datagrams are sent, whatever they are of.
std::vector<CLI::Option*> add_sending(CLI::App& sub, SendOptions& o) {
  return {
      sub.add_option("--interface", o.interface, "Send by this interface (default: by the routes)"),
      add_loop(sub, o.loops),
      sub.add_option("--faults", o.faults,
                     "What goes wrong on the way, by seconds since the first packet:\n"
                     "loss@2.5s:20packets reorder@4s:3 duplicate@4.5s:2 pause@5s:0.4s "
                     "burst@6s:50ms\nforeign@7s:50 clock@8s:+2.0s truncate@9s:5"),
      sub.add_option("--foreign-from", o.foreign_from,
                     "Address of this machine that foreign packets come from")
          ->check(CLI::ValidIPV4),
      sub.add_option("--json", o.json, "File for the summary: sent, lateness, what each fault did"),
  };
}

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
}

void add_segment(CLI::App& sub, SegmentOptions& o) {
  sub.add_option("SCANS_DIR", o.scans, "Folder of .bin scans, or a SemanticKITTI sequence folder")
      ->required();
  add_mount(sub, o.mount);
  add_method(sub, o.method);
  add_rivals(sub, o.method);
  add_outputs(sub, o.output);
}

void add_simulate(CLI::App& sub, SimulateOptions& o) {
  add_sensor(sub, o.sensor);
  sub.add_option("--scene", o.scene, "street, highway, rural, flat or hill")->capture_default_str();
  sub.add_option("--seed", o.seed, "The same seed gives the same drive")->capture_default_str();
  sub.add_option("--duration", o.duration_s, "Seconds to drive")
      ->check(range_of("simulate.duration_s"))
      ->capture_default_str();
  sub.add_option("--spin-hz,--rate", o.spin_hz, "Turns a second: 5, 10 and 20 are the sensors' own")
      ->check(range_of("simulate.spin_hz"))
      ->capture_default_str();
  sub.add_option("--returns", o.returns, "single: the strongest; dual: the strongest and the last")
      ->check(one_of("simulate.returns"))
      ->capture_default_str();
  sub.add_option("--timestamp", o.timestamp, "Ruby128: how its stamps are encoded")
      ->check(one_of("simulate.timestamp"))
      ->capture_default_str();
  sub.add_option("--noise", o.noise_m, "Standard deviation of the range noise, metres")
      ->check(range_of("simulate.noise_m"))
      ->capture_default_str();
  sub.add_option("--speed", o.speed_mps, "Of the vehicle, m/s (default: what is usual there)")
      ->check(CLI::Range(0.0, 60.0));
  sub.add_option("--yaw-rate", o.yaw_rate_dps,
                 "Degrees a second, left positive: drive on an arc instead of along the road")
      ->check(CLI::Range(-57.0, 57.0));
  sub.add_option("--calibration", o.calibration, "Unit to simulate (default: a nominal one)");
  add_mount(sub, o.mount);
  auto* output =
      sub.add_option("-o,--output", o.output, "Capture to write; its table and truth go beside it");
  sub.add_flag("--can-log", o.can_log,
               "Write the vehicle's speed and yaw rate beside it: NAME.can.log, NAME.can.dbc")
      ->needs(output);
  auto* udp = sub.add_option("--udp", o.udp.to,
                             "ADDRESS[:PORT]: be the sensor, and send the drive in real time once "
                             "it is computed");
  for (CLI::Option* option : add_sending(sub, o.udp)) option->needs(udp);
}

void add_encode(CLI::App& sub, EncodeOptions& o) {
  add_sensor(sub, o.sensor);
  sub.add_option("SCANS_DIR", o.scans, "Folder of .bin scans, or a SemanticKITTI sequence folder")
      ->required();
  sub.add_option("--calibration", o.calibration,
                 "Unit to encode through (default: one fitted to the scans; Ruby128: nominal)");
  auto* undo =
      sub.add_flag("--undo-compensation", o.undo_compensation,
                   "Put the sensor's motion back into the points; needs poses.txt and times.txt");
  sub.add_flag("--can-log", o.can_log,
               "HDL-64E: write that motion beside the capture, NAME.can.log and NAME.can.dbc; the "
               "sensor then looks backwards, for recorded turns begin behind")
      ->needs(undo);
  sub.add_option("-o,--output", o.output, "Capture to write; its table and truth go beside it")
      ->required();
}

void add_calibrate(CLI::App& sub, CalibrateOptions& o) {
  add_capture(sub, o.capture);
  add_mount(sub, o.mount);
  add_method(sub, o.method);
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
  sub.add_option("--json", o.json, "The same as a file for programs");
}

void add_bench(CLI::App& sub, BenchOptions& o) {
  add_capture(sub, o.capture);
  add_mount(sub, o.mount);
  add_method(sub, o.method);
  sub.add_option("--repeat", o.repeat, "Passes over the capture")
      ->check(range_of("bench.repeat"))
      ->capture_default_str();
  sub.add_option("--core", o.core, "Processor core to stay on (default: the last one allowed)")
      ->check(CLI::Range(0, 4095));
  sub.add_option("--json", o.json, "The same as a file for programs");
}

void add_send(CLI::App& sub, SendOptions& o) {
  sub.add_option("FILE", o.file, "Any capture with UDP, pcap or pcapng")->required();
  sub.add_option("--to", o.to,
                 "ADDRESS:PORT to send to; a multicast group and broadcast will do.\n"
                 "ADDRESS alone: every datagram to the port it was captured on")
      ->required();
  sub.add_option("--port", o.port, "Only UDP datagrams to this port (default: any)");
  sub.add_option("--from", o.from, "Only datagrams of this IPv4 address")->check(CLI::ValidIPV4);
  sub.add_option("--rate", o.rate, "Pace by the capture's stamps: 1 as recorded, 0 flat out")
      ->check(range_of("replay.rate"))
      ->capture_default_str();
  add_sending(sub, o);
}

void add_dump(CLI::App& sub, DumpOptions& o) {
  sub.add_option("NAME", o.name, "Name of the process (default: the only one that runs)");
  sub.add_option("--wait", o.wait_s, "Seconds to wait for its answer")
      ->check(number(0, 3600))
      ->capture_default_str();
}

void add_top(CLI::App& sub, TopOptions& o) {
  sub.add_option("NAME", o.name, "Status page of the process (default: the only one that runs)");
  sub.add_flag("--once", o.once, "Print once and exit");
  sub.add_flag("--json", o.json, "Print the figures once, for programs");
  sub.add_option("--interval", o.interval_s, "Seconds between two looks")
      ->check(number(0.1, 3600))
      ->capture_default_str();
}

void add_live(CLI::App& sub, LiveOptions& o) {
  sub.add_option("--listen", o.listen.address,
                 "ADDRESS:PORT; address 0.0.0.0 hears broadcasts, too")
      ->capture_default_str();
  sub.add_option("--interface", o.listen.interface, "Only what comes in by this interface");
  sub.add_option("--via", o.listen.via,
                 "libpcap hears what a socket does not: a mirror port, a port another program "
                 "holds; it needs --interface and CAP_NET_RAW")
      ->check(one_of("input.via"))
      ->capture_default_str();
  sub.add_option("--device-port", o.listen.device_port,
                 "Ruby128: port of its device information, heard at the start for its angles; "
                 "0: do not")
      ->capture_default_str();
  sub.add_option("--patience", o.patience_s, "Seconds to wait for the sensor at the start")
      ->check(range_of("input.patience_s"))
      ->capture_default_str();
  sub.add_option("--multicast", o.listen.multicast, "Group to join")->check(CLI::ValidIPV4);
  sub.add_flag("--share-port", o.listen.share_port, "Let other programs hear the same port");
  add_decoding(sub, o.capture);
  sub.add_option("--duration", o.capture.duration_s, "Stop after this many seconds")
      ->check(range_of("input.duration_s"));
  add_mount(sub, o.mount);
  add_method(sub, o.method);
  sub.add_option("--deadline-ms", o.deadline_ms, "From a turn's last packet to its labels")
      ->check(range_of("deadline.limit_ms"))
      ->capture_default_str();
  sub.add_option("--receive-priority", o.realtime.receive_priority, "SCHED_FIFO, 0: shared")
      ->check(range_of("realtime.receive_priority"))
      ->capture_default_str();
  sub.add_option("--segment-priority", o.realtime.segment_priority, "SCHED_FIFO, 0: shared")
      ->check(range_of("realtime.segment_priority"))
      ->capture_default_str();
  sub.add_option("--receive-core", o.realtime.receive_core, "Core of the receiving thread")
      ->check(range_of("realtime.receive_core"));
  sub.add_option("--segment-core", o.realtime.segment_core, "Core of the segmenting thread")
      ->check(range_of("realtime.segment_core"));
  sub.add_flag("!--no-lock-memory", o.realtime.lock_memory, "Leave memory to the system");
  sub.add_option("--labels", o.labels, "Folder for NNNNNN.label, SemanticKITTI predictions");
  sub.add_option("--stream", o.stream,
                 "ADDRESS:PORT or socket path where other programs get every turn's labelled "
                 "points (docs/labelled_stream.md); a port alone: this machine's programs")
      ->check([](const std::string& text) {
        const auto address = firmware_io::parse_stream_address(text);
        return address ? std::string() : address.error().message;
      });
  sub.add_option("--recorder-folder", o.recorder.folder,
                 "Folder for the last seconds of packets, written when a deadline is missed or "
                 "`terracut dump` asks");
  sub.add_option("--recorder-seconds", o.recorder.seconds, "How many seconds")
      ->check(range_of("recorder.seconds"))
      ->capture_default_str();
  sub.add_option("--metrics", o.watch.metrics, "ADDRESS:PORT of /metrics for Prometheus, or off")
      ->capture_default_str();
  sub.add_option("--name", o.watch.name, "Name for `terracut top` and `terracut dump`")
      ->capture_default_str();
  sub.add_option("--json", o.json, "File for the summary at the end");
  sub.add_option("--trace", o.trace, "File for the last frames as a trace, for ui.perfetto.dev");
}

void add_config(CLI::App& sub, ConfigOptions& o) {
  sub.add_flag("--print-default", o.print_default,
               "Print a file with every key, its range and default (else: the one in force)");
  sub.add_flag("--print-table", o.print_table, "Print the table of docs/configuration.md");
}

void add_doctor(CLI::App& sub, DoctorOptions& o) {
  sub.add_option("--interface", o.interface,
                 "Network interface of the sensor (default: all that are up)");
  sub.add_option("--port", o.port, "UDP port of the sensor")
      ->check(CLI::Range(1, 65535))
      ->capture_default_str();
  sub.add_flag("--json", o.json, "Print the findings for programs");
}

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
  add_settings(sub, o.settings);
  sub.add_option("--through", o.through,
                 "image: scans straight into the range image; packets: encoded and decoded first")
      ->check(CLI::IsMember({"image", "packets"}))
      ->capture_default_str();
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
}

void add_compare(CLI::App& sub, CompareOptions& o) {
  sub.add_option("BEFORE", o.before, "Report of `terracut eval --json`")->required();
  sub.add_option("AFTER", o.after, "Another one, of the same frames")->required();
  sub.add_option("--method", o.method, "Method to compare")->capture_default_str();
  sub.add_option("--method-after", o.method_after, "Method of AFTER (default: the same)");
  sub.add_option("--significance", o.significance,
                 "A measure that got worse with a smaller p than this leads to exit code 8")
      ->check(number(1e-12, 1))
      ->capture_default_str();
  sub.add_option("--json", o.json, "File for the same, for programs");
}

/// The file named by --config, wherever it stands; the last one counts.
std::filesystem::path configuration_file_of(int argc, char** argv) {
  constexpr std::string_view kOption = "--config";
  std::filesystem::path file;
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (word == "--") break;
    if (word == kOption && i + 1 < argc) file = argv[++i];
    if (word.starts_with("--config=")) file = word.substr(kOption.size() + 1);
  }
  return file;
}

/// CLI11 would say only that a subcommand is required.
void refuse_unknown_command(const CLI::App& app, int argc, char** argv) {
  const std::string first = argc > 1 ? argv[1] : "";
  if (first.empty() || first.front() == '-') return;
  std::string known;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (command->get_name() == first) return;
    known += (known.empty() ? "" : ", ") + command->get_name();
  }
  throw CLI::ParseError("there is no command '" + first + "'; expected one of: " + known,
                        CLI::ExitCodes::ExtrasError);
}

}  // namespace

Arguments parse_arguments(int argc, char** argv) {
  Arguments result;
  Configuration configuration;
  if (const std::filesystem::path file = configuration_file_of(argc, argv); !file.empty()) {
    Expected<Configuration> read = read_configuration(file);
    if (!read) {
      result.exit_code = refuse(kInputRefused, read.error().message);
      return result;
    }
    configuration = *std::move(read);
  }
  CLI::App app{kAbout, "terracut"};
  app.footer(kExitCodes);
  app.set_version_flag("--version", "terracut " TERRACUT_VERSION);
  app.require_subcommand(1);
  add_config_option(app);
  const Reading reading{app, configuration, result.command};

  add_command<ReplayOptions>(reading, "replay", "Label every return of a capture, frame by frame",
                             add_replay);
  add_command<SegmentOptions>(reading, "segment", "Label recorded scans (.bin) without packets",
                              add_segment);
  add_command<SimulateOptions>(reading, "simulate",
                               "Drive a simulated sensor: capture, table and truth", add_simulate);
  add_command<EncodeOptions>(reading, "encode", "Turn recorded scans into packets with their truth",
                             add_encode);
  add_command<CalibrateOptions>(reading, "calibrate",
                                "Find the mount and the rings' ground distances from a capture\n"
                                "taken on a straight, level, open road",
                                add_calibrate);
  add_command<InfoOptions>(
      reading, "info", "What a capture holds: streams, sensor, rate, loss, calibration", add_info);
  add_command<PlanOptions>(reading, "plan", "Memory the program takes, part by part", add_plan);
  add_command<ParametersOptions>(reading, "parameters",
                                 "Every parameter of the method, as a table for docs/parameters.md",
                                 [](CLI::App&, ParametersOptions&) {});
  add_command<BenchOptions>(reading, "bench", "Time decoding and every stage on one core",
                            add_bench);
  add_command<SendOptions>(reading, "send",
                           "Send a capture's datagrams by UDP, as its sensor would", add_send);
  add_command<LiveOptions>(reading, "live",
                           "Label a sensor's packets as they arrive, before a deadline", add_live);
  add_command<DumpOptions>(reading, "dump",
                           "Have a running `terracut live` write its last seconds of packets",
                           add_dump);
  add_command<EvalOptions>(reading, "eval",
                           "Measure methods on a labelled dataset, as the paper does", add_eval);
  add_command<CompareOptions>(
      reading, "compare", "What a change did: two reports of eval, frame by frame", add_compare);
  add_command<TopOptions>(reading, "top", "Watch a running `terracut live` from another shell",
                          add_top);
  add_command<ConfigOptions>(reading, "config",
                             "Print the configuration in force, or one to start from", add_config);
  add_command<DoctorOptions>(
      reading, "doctor", "What of this machine stands in the way of real time, and what mends it",
      add_doctor);
  app.failure_message([](const CLI::App*, const CLI::Error& error) {
    return std::string("error: ") + error.what() +
           "\n`terracut --help` and `terracut COMMAND --help` say what is expected\n";
  });
  try {
    refuse_unknown_command(app, argc, argv);
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    result.command.reset();
    result.exit_code = app.exit(error) == 0 ? kOk : kUsage;
  }
  return result;
}

}  // namespace terracut::cli
