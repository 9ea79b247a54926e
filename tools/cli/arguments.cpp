// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// The only file that includes CLI11, which takes seconds to compile.
#include "arguments.hpp"

#include <CLI/CLI.hpp>

#include <limits>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "exit_codes.hpp"
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
    "6 deadlines were missed.\n"
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

constexpr double kLongest_s = 1e9;

/// What a capture and a live stream have in common.
void add_decoding(CLI::App& app, CaptureOptions& capture) {
  app.add_option("--sensor", capture.sensor, "Sensor model (default: the one found)")
      ->check(CLI::IsMember({"auto", "hdl64e", "ruby128"}))
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
      ->check(CLI::Range(16, 36000));
  app.add_option("--cell-owner", capture.cell_owner,
                 "Dual return: which return stands for its cell; all of them are labelled")
      ->check(CLI::IsMember({"strongest", "last", "first", "both"}))
      ->capture_default_str();
  app.add_option("--timestamp", capture.timestamp,
                 "Ruby128: how its stamps are encoded (default: found out from the packets)")
      ->check(CLI::IsMember({"auto", "calendar", "us", "ns"}))
      ->capture_default_str();
  app.add_option("--clock-offset", capture.clock_offset_s,
                 "Seconds to add to the device's clock where it is reported")
      ->check(number(-kLongest_s, kLongest_s));
  app.add_option("--geometry", capture.geometry,
                 "Meaning of the table: the maker's manual, or as ROS drivers take it")
      ->check(CLI::IsMember({"manual", "ros"}))
      ->capture_default_str();
}

void add_capture(CLI::App& app, CaptureOptions& capture) {
  app.add_option("FILE", capture.file, "Capture of HDL-64E or RS-Ruby128 packets, pcap or pcapng")
      ->required();
  app.add_option("--port", capture.port, "Only UDP datagrams to this port (default: any)");
  add_decoding(app, capture);
  app.add_option("--start", capture.start_s, "Skip this many seconds of the capture")
      ->check(number(0, kLongest_s));
  app.add_option("--duration", capture.duration_s, "Stop after this many seconds of the capture")
      ->check(number(1e-6, kLongest_s));
}

void add_mount(CLI::App& app, MountOptions& mount) {
  app.add_option("--setup", mount.setup, "Mount and ring distances found by `terracut calibrate`");
  app.add_option("--mount-height", mount.height_m,
                 "Metres from the ground to the sensor's origin (default 1.73)")
      ->check(number(0.2, 6));
  app.add_option("--mount-roll", mount.roll_deg, "Degrees, left side up (default 0)")
      ->check(number(-28, 28));
  app.add_option("--mount-pitch", mount.pitch_deg, "Degrees, looking down in front (default 0)")
      ->check(number(-28, 28));
}

void add_method(CLI::App& app, MethodOptions& method) {
  app.add_option("--profile", method.profile,
                 "paper: the method as printed; terracut: what measured better")
      ->check(CLI::IsMember({"paper", "terracut"}))
      ->capture_default_str();
  app.add_option("--stages", method.stages,
                 "How far to refine: elevation map, + adjacent points, + random field (mrf)")
      ->check(CLI::IsMember({"elevation", "adjacent", "mrf"}))
      ->capture_default_str();
  app.add_option(
         "--set", method.settings,
         "KEY=VALUE, any parameter of the method (`terracut parameters` lists them); repeatable")
      ->check([](const std::string& setting) {
        pipeline::MethodConfig scratch;
        const Status valid = apply_setting(scratch, setting);
        return valid ? std::string() : valid.error().message;
      })
      ->allow_extra_args(false);
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

/// Makes the subcommand and, when it is used, puts its options into `command`.
template <class Options, class AddOptions>
void add_command(CLI::App& app, std::optional<Command>& command, const char* name,
                 const char* about, AddOptions&& add_options) {
  CLI::App* sub = app.add_subcommand(name, about);
  auto options = std::make_shared<Options>();
  add_options(*sub, *options);
  sub->callback([&command, options] { command = *options; });
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
      ->check(number(0, 1000))
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
      ->check(number(0.1, 3600))
      ->capture_default_str();
  sub.add_option("--spin-hz,--rate", o.spin_hz, "Turns a second: 5, 10 and 20 are the sensors' own")
      ->check(number(5, 20))
      ->capture_default_str();
  sub.add_option("--returns", o.returns, "single: the strongest; dual: the strongest and the last")
      ->check(CLI::IsMember({"single", "dual"}))
      ->capture_default_str();
  sub.add_option("--timestamp", o.timestamp, "Ruby128: how its stamps are encoded")
      ->check(CLI::IsMember({"calendar", "us", "ns"}))
      ->capture_default_str();
  sub.add_option("--noise", o.noise_m, "Standard deviation of the range noise, metres")
      ->check(number(0, 1))
      ->capture_default_str();
  sub.add_option("--calibration", o.calibration, "Unit to simulate (default: a nominal one)");
  add_mount(sub, o.mount);
  sub.add_option("-o,--output", o.output, "Capture to write; its table and truth go beside it");
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
  sub.add_flag("--undo-compensation", o.undo_compensation,
               "Put the sensor's motion back into the points; needs poses.txt and times.txt");
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
      ->check(CLI::Range(1, 100000))
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
      ->check(number(0, 1000))
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
      ->check(CLI::IsMember({"socket", "libpcap"}))
      ->capture_default_str();
  sub.add_option("--device-port", o.listen.device_port,
                 "Ruby128: port of its device information, heard at the start for its angles; "
                 "0: do not")
      ->capture_default_str();
  sub.add_option("--patience", o.patience_s, "Seconds to wait for the sensor at the start")
      ->check(number(0.1, kLongest_s))
      ->capture_default_str();
  sub.add_option("--multicast", o.listen.multicast, "Group to join")->check(CLI::ValidIPV4);
  sub.add_flag("--share-port", o.listen.share_port, "Let other programs hear the same port");
  add_decoding(sub, o.capture);
  sub.add_option("--duration", o.capture.duration_s, "Stop after this many seconds")
      ->check(number(1e-6, kLongest_s));
  add_mount(sub, o.mount);
  add_method(sub, o.method);
  sub.add_option("--deadline-ms", o.deadline_ms, "From a turn's last packet to its labels")
      ->check(number(1, 10'000))
      ->capture_default_str();
  sub.add_option("--receive-priority", o.realtime.receive_priority, "SCHED_FIFO, 0: shared")
      ->check(CLI::Range(0, 99))
      ->capture_default_str();
  sub.add_option("--segment-priority", o.realtime.segment_priority, "SCHED_FIFO, 0: shared")
      ->check(CLI::Range(0, 99))
      ->capture_default_str();
  sub.add_option("--receive-core", o.realtime.receive_core, "Core of the receiving thread")
      ->check(CLI::Range(0, 4095));
  sub.add_option("--segment-core", o.realtime.segment_core, "Core of the segmenting thread")
      ->check(CLI::Range(0, 4095));
  sub.add_flag("!--no-lock-memory", o.realtime.lock_memory, "Leave memory to the system");
  sub.add_option("--labels", o.labels, "Folder for NNNNNN.label, SemanticKITTI predictions");
  sub.add_option("--recorder-folder", o.recorder.folder,
                 "Folder for the last seconds of packets, written when a deadline is missed or "
                 "`terracut dump` asks");
  sub.add_option("--recorder-seconds", o.recorder.seconds, "How many seconds")
      ->check(number(0, 600))
      ->capture_default_str();
  sub.add_option("--metrics", o.watch.metrics, "ADDRESS:PORT of /metrics for Prometheus, or off")
      ->capture_default_str();
  sub.add_option("--name", o.watch.name, "Name for `terracut top` and `terracut dump`")
      ->capture_default_str();
  sub.add_option("--json", o.json, "File for the summary at the end");
  sub.add_option("--trace", o.trace, "File for the last frames as a trace, for ui.perfetto.dev");
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
  CLI::App app{kAbout, "terracut"};
  app.footer(kExitCodes);
  app.set_version_flag("--version", "terracut " TERRACUT_VERSION);
  app.require_subcommand(1);

  add_command<ReplayOptions>(app, result.command, "replay",
                             "Label every return of a capture, frame by frame", add_replay);
  add_command<SegmentOptions>(app, result.command, "segment",
                              "Label recorded scans (.bin) without packets", add_segment);
  add_command<SimulateOptions>(app, result.command, "simulate",
                               "Drive a simulated sensor: capture, table and truth", add_simulate);
  add_command<EncodeOptions>(app, result.command, "encode",
                             "Turn recorded scans into packets with their truth", add_encode);
  add_command<CalibrateOptions>(app, result.command, "calibrate",
                                "Find the mount and the rings' ground distances from a capture\n"
                                "taken on a straight, level, open road",
                                add_calibrate);
  add_command<InfoOptions>(app, result.command, "info",
                           "What a capture holds: streams, sensor, rate, loss, calibration",
                           add_info);
  add_command<PlanOptions>(app, result.command, "plan", "Memory the program takes, part by part",
                           add_plan);
  add_command<ParametersOptions>(app, result.command, "parameters",
                                 "Every parameter of the method, as a table for docs/parameters.md",
                                 [](CLI::App&, ParametersOptions&) {});
  add_command<BenchOptions>(app, result.command, "bench",
                            "Time decoding and every stage on one core", add_bench);
  add_command<SendOptions>(app, result.command, "send",
                           "Send a capture's datagrams by UDP, as its sensor would", add_send);
  add_command<LiveOptions>(app, result.command, "live",
                           "Label a sensor's packets as they arrive, before a deadline", add_live);
  add_command<DumpOptions>(app, result.command, "dump",
                           "Have a running `terracut live` write its last seconds of packets",
                           add_dump);
  add_command<TopOptions>(app, result.command, "top",
                          "Watch a running `terracut live` from another shell", add_top);
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
