// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <algorithm>
#include <array>
#include <limits>

#include "setting.hpp"
#include "tools/lab/scenes/scene_names.hpp"
#include "tools/lab/simulator/shot_pattern.hpp"
#include "tools/research/baselines/method_config.hpp"
#include "tools/research/datasets/built_in_tables.hpp"
#include "words.hpp"

namespace terracut::cli {
namespace {

using C = Command;
using F = SettingField;
using Kind = RunFiles::Kind;
using O = Options;

constexpr double kLongest_s = 1e9;
constexpr double kMostLoops = std::numeric_limits<int>::max();
constexpr double kMostSeed = 9007199254740992;  // whole numbers up to here are exact

constexpr CommandSet kPlayed = C::kReplay | C::kView;
constexpr CommandSet kCaptures = kPlayed | C::kCalibrate | C::kBench;
constexpr CommandSet kWholeCaptures = C::kReplay | C::kBench | C::kInfo | C::kSend;
constexpr CommandSet kPackets = kCaptures | C::kLive;
constexpr CommandSet kMounted = kPackets | C::kSegment | C::kSimulate | C::kEval | C::kNode;
constexpr CommandSet kGuessing = C::kReplay | C::kSegment | C::kRelabel | C::kLive;
constexpr CommandSet kMethods = kPackets | C::kSegment | C::kRelabel | C::kPlan | C::kNode;
constexpr CommandSet kDriven = kPlayed | C::kLive;
constexpr CommandSet kMoved = kDriven | C::kRelabel;
constexpr CommandSet kFrames = C::kReplay | C::kSegment;
constexpr CommandSet kPublished = kFrames | C::kLive;
constexpr CommandSet kDrives = C::kSimulate | C::kEval;
constexpr CommandSet kSending = C::kSend | C::kSimulate;
constexpr CommandSet kDds = C::kReplay | C::kLive | C::kSegment | C::kNode;
constexpr CommandSet kResults = C::kInfo | C::kPlan | C::kBench | C::kDetection;

template <class Value, class Words>
ChoiceField choice(Value& value, const Words& words) {
  ChoiceField field{.words = {}, .chosen = word_of(words, value), .choose = [&](std::size_t i) {
                      value = words[i].value;
                    }};
  for (const auto& word : words) field.words.push_back(word.name);
  return field;
}

ChoiceField name_choice(std::string& value, const std::vector<std::string_view>& names) {
  return {.words = names, .chosen = value, .choose = [&value, names](std::size_t i) {
            value = names[i];
          }};
}

ChoiceField method_choice(std::string& method) {
  std::vector<std::string_view> names;
  for (const auto& known : baselines::method_names()) names.push_back(known.name);
  return name_choice(method, names);
}

ChoiceField pattern_choice(std::string& pattern) {
  std::vector<std::string_view> names;
  for (const auto& known : simulator::shot_patterns()) names.push_back(known.name);
  return name_choice(pattern, names);
}

ChoiceField dataset_choice(std::string& dataset) {
  std::vector<std::string_view> names;
  for (const auto& table : datasets::built_in_tables()) names.push_back(table.dataset);
  names.insert(names.end(), {"own", "simulated", "hazards", "objects", "free", "sight"});
  return name_choice(dataset, names);
}

// clang-format off: a table reads better with an entry on two lines than one word a line.
constexpr std::array kSettings{
    // The input of a run
    Setting{.option = "FILE", .commands = kWholeCaptures, .required_by = kWholeCaptures, .help = "Capture, pcap or pcapng; or a bag with packets, MCAP or rosbag2's (a file, or its folder)",
            .reads = "the capture", .field = [](O& o) -> F { return &o.capture.file; }},
    Setting{.option = "FILE", .commands = C::kCalibrate | C::kView, .required_by = C::kCalibrate | C::kView, .help = "Capture, pcap or pcapng; or clouds, a folder or one file, as segment takes them; or a bag with either",
            .reads = "the capture", .field = [](O& o) -> F { return &o.capture.file; }},
    Setting{.option = "SCANS_DIR", .commands = C::kSegment | C::kEncode, .required_by = C::kSegment | C::kEncode, .help = "Folder of scans (.bin; segment: .pcd.bin, .pcd and .ply, too, or one file), or a SemanticKITTI sequence folder; segment: or a bag with clouds, MCAP or rosbag2's",
            .field = [](O& o) -> F { return &o.scans; }},
    Setting{.option = "DATASET", .commands = C::kEval, .required_by = C::kEval, .help = "Which dataset, or own clouds, or drives to simulate; hazards: any\nof these, with persons, boxes, ghosts and the like put in; objects: any\nof these, and how well objects come apart; free: any of these, and\nhow right the free way is; sight: any of these, and what is named where\nless is seen",
            .field = [](O& o) -> F { return dataset_choice(o.eval.dataset); }},
    Setting{.option = "ROOT", .commands = C::kEval, .required_by = C::kEval, .help = "Folder of the dataset, laid out as its class table says (see\ndocs/reference/evaluation.md); simulated: scenes, like street,hill;\nhazards, objects, free, sight: a dataset and its ROOTs, or\nsemantickitti's alone",
            .field = [](O& o) -> F { return &o.eval.root; }},
    Setting{.option = "MORE", .commands = C::kEval, .help = "hazards, objects, free, sight: more of them",
            .form = TextForm::kList, .field = [](O& o) -> F { return &o.eval.more_roots; }},
    Setting{.option = "NAME", .commands = C::kDump | C::kTop, .help = "Name of the process (default: the only one that runs)",
            .form = TextForm::kName, .field = [](O& o) -> F { return &o.watched; }},
    Setting{.option = "-o,--output", .commands = C::kSimulate | C::kEncode, .required_by = C::kEncode, .help = "Capture to write; its table and truth go beside it; with --pattern a folder",
            .field = [](O& o) -> F { return &o.written; }},
    Setting{.option = "-o,--output", .commands = C::kCalibrate, .required_by = C::kCalibrate, .help = "Setup file to write, for --setup",
            .writes = Kind::kFile, .field = [](O& o) -> F { return &o.written; }},
    Setting{.option = "ROOT", .commands = C::kManifest, .required_by = C::kManifest, .help = "Folder to look for captures and folders of clouds in, at any depth",
            .field = [](O& o) -> F { return &o.fleet.root; }},
    Setting{.option = "-o,--output", .commands = C::kManifest, .required_by = C::kManifest, .help = "Manifest to write, for relabel",
            .writes = Kind::kFile, .field = [](O& o) -> F { return &o.written; }},
    Setting{.option = "MANIFEST", .commands = C::kRelabel, .help = "What `terracut manifest` has written",
            .reads = "the manifest", .field = [](O& o) -> F { return &o.fleet.manifest; }},
    Setting{.option = "-o,--output", .commands = C::kRelabel, .help = "Folder for NAME-HASH/, one a drive, named by content, program and settings",
            .writes = Kind::kSharedFolder, .field = [](O& o) -> F { return &o.written; }},

    Setting{.key = "sensor.model", .option = "--sensor", .commands = kPackets | C::kSimulate | C::kPlan | C::kEval | C::kRelabel, .help = "Sensor model; auto: the one found, or hdl64e where there is none to find",
            .field = [](O& o) -> F { return choice(o.capture.sensor, kSensorWords); }},
    Setting{.option = "--sensor", .commands = C::kDetection, .help = "Sensor model; auto: each of them",
            .field = [](O& o) -> F { return choice(o.capture.sensor, kSensorWords); }},
    Setting{.key = "sensor.calibration", .option = "--calibration", .commands = kPackets | C::kSegment | C::kSimulate | C::kEncode | C::kDetection, .help = "The unit's table: db.xml or yaml of an HDL-64E, csv of a RoboSense or Hesai, json of an Ouster (default: the one in the packets; of scans: fitted to them; simulate, detection: a nominal one)",
            .reads = "the calibration", .field = [](O& o) -> F { return &o.capture.calibration; }},
    Setting{.key = "sensor.nominal_calibration", .option = "--nominal-calibration", .commands = kPackets | C::kRelabel, .help = "Ruby128: take the model's table where there is none of the unit; heights may be off",
            .bare = "yes", .field = [](O& o) -> F { return &o.capture.nominal_calibration; }},
    Setting{.key = "sensor.columns", .option = "--columns", .commands = kPackets | C::kRelabel, .unit = "columns", .help = "Columns of the range image (default: firings a frame at the spin rate found)",
            .least = 16, .most = 36000, .field = [](O& o) -> F { return &o.capture.columns; }},
    Setting{.key = "sensor.cell_owner", .option = "--cell-owner", .commands = kPackets | C::kRelabel, .help = "Dual return: which return stands for its cell; all of them are labelled",
            .field = [](O& o) -> F { return choice(o.capture.cell_owner, kCellOwnerWords); }},
    Setting{.key = "sensor.timestamp", .option = "--timestamp", .commands = kPackets | C::kRelabel, .help = "RoboSense: how its stamps are encoded; auto: found out from the packets",
            .field = [](O& o) -> F { return choice(o.capture.timestamp, kAnyTimestampWords); }},
    Setting{.key = "sensor.clock_offset_s", .option = "--clock-offset", .commands = kPackets, .unit = "s", .help = "To add to the device's clock where it is reported",
            .least = -kLongest_s, .most = kLongest_s, .field = [](O& o) -> F { return &o.capture.clock_offset_s; }},
    Setting{.key = "sensor.geometry", .option = "--geometry", .commands = kPackets | C::kRelabel, .help = "Meaning of the table: the maker's manual, or as ROS drivers take it",
            .field = [](O& o) -> F { return choice(o.capture.geometry, kGeometryWords); }},

    Setting{.key = "input.topic", .option = "--topic", .commands = kCaptures | C::kInfo | C::kSend | C::kSegment | C::kRelabel, .help = "Bags: the topic to read, of packets or of clouds (default: the only one)",
            .field = [](O& o) -> F { return &o.capture.topic; }},
    Setting{.key = "input.port", .option = "--port", .commands = kCaptures | C::kSend | C::kRelabel, .help = "Only UDP datagrams to this port (default: any)",
            .least = 0, .most = 65535, .field = [](O& o) -> F { return &o.capture.port; }},
    Setting{.key = "input.from", .option = "--from", .commands = kPackets | C::kSend | C::kRelabel, .help = "Only datagrams of this IPv4 address, or of this port of it (default: any)",
            .form = TextForm::kSender, .field = [](O& o) -> F { return &o.capture.from; }},
    Setting{.key = "input.to", .option = "--to", .commands = kCaptures | C::kRelabel, .help = "Only datagrams to this IPv4 address (default: any)",
            .form = TextForm::kAddress, .field = [](O& o) -> F { return &o.capture.to; }},
    Setting{.key = "input.vlan", .option = "--vlan", .commands = kCaptures | C::kSend | C::kRelabel, .help = "Only datagrams in this VLAN; 0: in none (default: any)",
            .form = TextForm::kVlan, .field = [](O& o) -> F { return &o.capture.vlan; }},
    Setting{.key = "input.mac", .option = "--mac", .commands = kCaptures | C::kSend | C::kRelabel, .help = "Only datagrams from this link-layer address (default: any)",
            .form = TextForm::kMac, .field = [](O& o) -> F { return &o.capture.mac; }},
    Setting{.key = "input.start_s", .option = "--start", .commands = kCaptures, .unit = "s", .help = "Skip so much of the capture's beginning",
            .least = 0, .most = kLongest_s, .field = [](O& o) -> F { return &o.capture.start_s; }},
    Setting{.key = "input.duration_s", .option = "--duration", .commands = kPackets | C::kNode, .unit = "s", .help = "Stop after so much (default: at the end; live, node: when interrupted)",
            .least = 1e-6, .most = kLongest_s, .field = [](O& o) -> F { return &o.capture.duration_s; }},
    Setting{.key = "input.reorder_packets", .option = "--reorder-packets", .commands = kPackets | C::kRelabel, .unit = "packets", .help = "How many packets late one may come and still find its frame, which waits for it (default: captures 2, live 0)",
            .least = 0, .most = 16, .field = [](O& o) -> F { return &o.capture.reorder_packets; }},
    Setting{.key = "input.listen", .option = "--listen", .commands = C::kLive | C::kDoctor, .help = "Where the sensor sends to; address 0.0.0.0, or a port alone, hears broadcasts too",
            .form = TextForm::kEndpoint, .field = [](O& o) -> F { return &o.listen.address; }},
    Setting{.key = "input.via", .option = "--via", .commands = C::kLive, .help = "libpcap hears what a socket does not: a mirror port, a port another program holds; it needs --interface and CAP_NET_RAW",
            .field = [](O& o) -> F { return choice(o.listen.via, kViaWords); }},
    Setting{.key = "input.interface", .option = "--interface", .commands = C::kLive | C::kDoctor, .help = "Only what comes in by this interface (default: any)",
            .form = TextForm::kName, .field = [](O& o) -> F { return &o.listen.interface; }},
    Setting{.key = "input.multicast", .option = "--multicast", .commands = C::kLive, .help = "Group to join (default: none)",
            .form = TextForm::kAddress, .field = [](O& o) -> F { return &o.listen.multicast; }},
    Setting{.key = "input.share_port", .option = "--share-port", .commands = C::kLive, .help = "Let other programs that ask for the same hear the port too",
            .bare = "yes", .field = [](O& o) -> F { return &o.listen.share_port; }},
    Setting{.key = "input.device_port", .option = "--device-port", .commands = C::kLive, .help = "RoboSense: port of its device information, heard at the start for its angles; 0: do not",
            .least = 0, .most = 65535, .field = [](O& o) -> F { return &o.listen.device_port; }},
    Setting{.key = "input.gather_ms", .option = "--gather", .commands = C::kLive, .unit = "ms", .help = "How long packets may wait to be fetched together, and labels with them; 0: each as it comes, which costs more wake-ups",
            .least = 0, .most = 20, .field = [](O& o) -> F { return &o.listen.gather_ms; }},
    Setting{.key = "input.patience_s", .option = "--patience", .commands = C::kLive, .unit = "s", .help = "How long to wait for the sensor at the start (default: as long as it takes)",
            .least = 0.1, .most = kLongest_s, .field = [](O& o) -> F { return &o.patience_s; }},

    Setting{.key = "mount.setup", .option = "--setup", .commands = kMounted, .help = "Mount and ring distances found by `terracut calibrate`",
            .reads = "the setup", .field = [](O& o) -> F { return &o.mount.setup; }},
    Setting{.key = "mount.height_m", .option = "--mount-height", .commands = kMounted | C::kRelabel, .unit = "m", .help = "From the ground to the sensor's origin (default: the setup's, else found in the first frames; simulate, eval: 1.73)",
            .least = 0.2, .most = 6, .field = [](O& o) -> F { return &o.mount.height_m; }},
    Setting{.option = "--mount-height", .commands = C::kDetection, .unit = "m", .help = "From the ground to the sensor's origin (default: 1, 1.73 and 3)",
            .least = 0.2, .most = 6, .field = [](O& o) -> F { return &o.mount.height_m; }},
    Setting{.option = "--slope", .commands = C::kDetection, .unit = "m/m", .help = "Most slope of the ground against the mount's plane, errors of the mount included",
            .least = 0, .most = 0.3, .field = [](O& o) -> F { return &o.detection.slope; }},
    Setting{.option = "--roughness", .commands = C::kDetection, .unit = "m", .help = "Most height of a ground return above or below a plane",
            .least = 0, .most = 0.5, .field = [](O& o) -> F { return &o.detection.roughness_m; }},
    Setting{.key = "mount.roll_deg", .option = "--mount-roll", .commands = kMounted | C::kRelabel, .unit = "deg", .help = "Left side up, 180 for a sensor that hangs upside down (default: the setup's, else found; simulate, eval: 0)",
            .least = -180, .most = 180, .field = [](O& o) -> F { return &o.mount.roll_deg; }},
    Setting{.key = "mount.pitch_deg", .option = "--mount-pitch", .commands = kMounted | C::kRelabel, .unit = "deg", .help = "Looking down in front (default: the setup's, else found; simulate, eval: 0)",
            .least = -90, .most = 90, .field = [](O& o) -> F { return &o.mount.pitch_deg; }},
    Setting{.key = "mount.guess", .option = "--mount-guess", .commands = kGuessing, .help = "Go on as if the sensor stood level at 1.73 m where the ground does not show its mount, instead of ending with exit code 10",
            .bare = "yes", .field = [](O& o) -> F { return &o.mount.may_guess; }},
    Setting{.key = "mount.base_frame", .option = "--base-frame", .commands = C::kNode, .help = "Frame on the ground, above which /tf_static states figures of the mount that are not stated here; off: none (default: base_footprint, else base_link)",
            .field = [](O& o) -> F { return &o.mount.base_frame; }},

    Setting{.key = "method.profile", .option = "--profile", .commands = kMethods | C::kEval | C::kDetection, .help = "paper: the method as printed; terracut: what measured better",
            .excludes = "--method", .field = [](O& o) -> F { return choice(o.method.profile, kProfileWords); }},
    Setting{.key = "method.stages", .option = "--stages", .commands = kMethods, .help = "How far to refine: elevation map, + adjacent points, + random field (mrf)",
            .excludes = "--method", .field = [](O& o) -> F { return choice(o.method.last_stage, kStageWords); }},
    Setting{.option = "--set", .commands = kMethods | C::kEval | C::kDetection, .help = "Any parameter of the method (`terracut parameters` lists them); repeatable",
            .form = TextForm::kParameter, .field = [](O& o) -> F { return &o.method.settings; }},
    Setting{.option = "--method", .commands = kPlayed | C::kSegment | C::kPlan | C::kBench, .help = "Ours or a baseline by name, instead of --profile and --stages",
            .denied_to = C::kLive | C::kNode | C::kCalibrate | C::kRelabel, .denial = "it runs our own method, as --profile, --stages and --set choose it", .field = [](O& o) -> F { return method_choice(o.method.method); }},
    Setting{.option = "--keep-mount", .commands = C::kCalibrate, .help = "Take the mount as stated, 1.73 m and level where it is not; only measure the rings' ground distances",
            .bare = "yes", .field = [](O& o) -> F { return &o.keep_mount; }},

    Setting{.key = "motion.can", .option = "--can", .commands = C::kLive, .help = "CAN interface of the vehicle, whose motion is removed from every frame (default: none)",
            .form = TextForm::kName, .field = [](O& o) -> F { return &o.can; }},
    Setting{.option = "--can", .commands = kPlayed, .help = "Recording of the vehicle's CAN bus (candump log or capture) on the clock of the packets' stamps: its motion is removed from every frame",
            .reads = "the CAN recording", .field = [](O& o) -> F { return &o.can_recording; }},
    Setting{.key = "motion.dbc", .option = "--dbc", .commands = kDriven, .help = "DBC file that says what the vehicle's CAN frames mean",
            .needs = "--can", .reads = "the DBC file", .field = [](O& o) -> F { return &o.motion.dbc; }},
    Setting{.key = "motion.speed", .commands = kMoved, .help = "Speed: its signal in the DBC file, SIGNAL or MESSAGE.SIGNAL; several, with commas between: their mean",
            .field = [](O& o) -> F { return &o.motion.speed_signals; }},
    Setting{.key = "motion.speed_unit", .commands = kMoved, .help = "Unit of these signals; file: as the DBC file says",
            .field = [](O& o) -> F { return choice(o.motion.speed.unit, kSpeedUnitWords); }},
    Setting{.key = "motion.speed_scale", .commands = kMoved, .help = "Factor on top; -1 turns the sign round",
            .least = -1000, .most = 1000, .field = [](O& o) -> F { return &o.motion.speed.scale; }},
    Setting{.key = "motion.speed_sign", .commands = kMoved, .help = "Signal by which it is negative, when not 0 (default: none)",
            .field = [](O& o) -> F { return &o.motion.speed.sign; }},
    Setting{.key = "motion.speed_valid", .commands = kMoved, .help = "Signal that says whether it is valid (default: none, it always is)",
            .field = [](O& o) -> F { return &o.motion.speed.valid; }},
    Setting{.key = "motion.speed_valid_value", .commands = kMoved, .help = "What that signal has to be",
            .least = -1e9, .most = 1e9, .field = [](O& o) -> F { return &o.motion.speed.valid_value; }},
    Setting{.key = "motion.yaw_rate", .commands = kMoved, .help = "Yaw rate, to the left positive: its signal in the DBC file, SIGNAL or MESSAGE.SIGNAL; several, with commas between: their mean",
            .field = [](O& o) -> F { return &o.motion.yaw_rate_signals; }},
    Setting{.key = "motion.yaw_rate_unit", .commands = kMoved, .help = "Unit of these signals; file: as the DBC file says",
            .field = [](O& o) -> F { return choice(o.motion.yaw_rate.unit, kYawRateUnitWords); }},
    Setting{.key = "motion.yaw_rate_scale", .commands = kMoved, .help = "Factor on top; -1 turns the sign round",
            .least = -1000, .most = 1000, .field = [](O& o) -> F { return &o.motion.yaw_rate.scale; }},
    Setting{.key = "motion.yaw_rate_sign", .commands = kMoved, .help = "Signal by which it is negative, when not 0 (default: none)",
            .field = [](O& o) -> F { return &o.motion.yaw_rate.sign; }},
    Setting{.key = "motion.yaw_rate_valid", .commands = kMoved, .help = "Signal that says whether it is valid (default: none, it always is)",
            .field = [](O& o) -> F { return &o.motion.yaw_rate.valid; }},
    Setting{.key = "motion.yaw_rate_valid_value", .commands = kMoved, .help = "What that signal has to be",
            .least = -1e9, .most = 1e9, .field = [](O& o) -> F { return &o.motion.yaw_rate.valid_value; }},
    Setting{.key = "motion.max_age_ms", .commands = kMoved, .unit = "ms", .help = "Signals older than this are not used",
            .least = 1, .most = 1000, .field = [](O& o) -> F { return &o.motion.max_age_ms; }},
    Setting{.key = "motion.timeout_ms", .commands = kMoved, .unit = "ms", .help = "Without speed and yaw rate for so long, the motion is lost",
            .least = 1, .most = 60000, .field = [](O& o) -> F { return &o.motion.timeout_ms; }},
    Setting{.key = "motion.sensor_ahead_m", .commands = kMoved, .unit = "m", .help = "The sensor's place before the middle of the rear axle",
            .least = -20, .most = 20, .field = [](O& o) -> F { return &o.motion.sensor_ahead_m; }},
    Setting{.key = "motion.sensor_left_m", .commands = kMoved, .unit = "m", .help = "... and to the left of it",
            .least = -10, .most = 10, .field = [](O& o) -> F { return &o.motion.sensor_left_m; }},
    Setting{.key = "motion.deskew_to", .option = "--deskew-to", .commands = kMoved, .help = "Instant of the frame at which all its returns are to lie where they were",
            .needs = "--can", .field = [](O& o) -> F { return choice(o.motion.deskew_to, kInstantWords); }},

    Setting{.key = "output.labels", .option = "--labels", .commands = kFrames | C::kLive, .help = "Folder for NNNNNN.label, SemanticKITTI predictions",
            .writes = Kind::kFrames, .ending = ".label", .field = [](O& o) -> F { return &o.output.labels; }},
    Setting{.key = "output.pcd", .option = "--pcd", .commands = kFrames, .help = "Folder for NNNNNN.pcd: x y z intensity ring label, with --heights height_above_ground",
            .writes = Kind::kFrames, .ending = ".pcd", .field = [](O& o) -> F { return &o.output.pcd; }},
    Setting{.key = "output.heights", .option = "--heights", .commands = kPublished | C::kView | C::kNode | C::kBench, .help = "Each return's height above the ground, too, in metres, wherever its label goes but to label files (docs/reference/outputs.md)",
            .bare = "yes", .excludes = "--method", .field = [](O& o) -> F { return &o.method.heights; }},
    Setting{.key = "output.objects", .option = "--objects", .commands = kPublished | C::kView | C::kNode, .help = "The objects of each frame, too, with boxes and footprints, in messages, pictures and (but for live) label files; with --heights (docs/guide/objects.md)",
            .bare = "yes", .excludes = "--method", .field = [](O& o) -> F { return &o.method.scene.objects; }},
    Setting{.key = "output.free_way", .option = "--free-way", .commands = kPublished | C::kView | C::kNode, .help = "The free way of each frame, too: by direction the nearest obstacle, and up to where ground was seen, in messages and pictures; with --heights (docs/guide/free_way.md)",
            .bare = "yes", .excludes = "--method", .field = [](O& o) -> F { return &o.method.scene.free_way; }},
    Setting{.key = "output.sight", .option = "--sight", .commands = C::kReplay | C::kLive, .help = "How far the sensor sees in each direction, too, and what is in its way, in figures and messages; with --heights (docs/guide/how_far_it_sees.md)",
            .bare = "yes", .excludes = "--method", .field = [](O& o) -> F { return &o.method.scene.sight; }},
    Setting{.key = "output.png", .option = "--png", .commands = kFrames, .help = "Folder for pictures: from above and as the sensor sees it",
            .writes = Kind::kFrames, .ending = ".png", .field = [](O& o) -> F { return &o.output.png; }},
    Setting{.option = "--overwrite", .commands = kFrames | C::kLive | C::kCompare, .help = "In these folders, take away what was made of another input, too; of the same input it is always replaced",
            .bare = "yes", .field = [](O& o) -> F { return &o.output.overwrite; }},
    Setting{.option = "--metadata", .commands = kFrames, .help = "KEY=VALUE: what the recording of --mcap is to say of itself; repeatable",
            .form = TextForm::kKeyValue, .field = [](O& o) -> F { return &o.output.metadata; }},
    Setting{.key = "output.format", .option = "--format", .commands = C::kRelabel | C::kPlan, .help = "Of a drive: labels, a file a frame; mcap: one recording of its points",
            .field = [](O& o) -> F { return choice(o.fleet.format, kFormatWords); }},
    Setting{.key = "output.json", .option = "--json", .commands = kFrames | C::kLive | C::kNode, .help = "File for the report: returns, losses and times",
            .writes = Kind::kFile, .field = [](O& o) -> F { return &o.output.json; }},
    Setting{.option = "--json", .commands = kResults, .help = "The same as a file for programs",
            .writes = Kind::kFile, .field = [](O& o) -> F { return &o.output.json; }},
    Setting{.option = "--json", .commands = kSending, .help = "File for the summary: sent, lateness, what each fault did",
            .needs = "--udp", .writes = Kind::kFile, .field = [](O& o) -> F { return &o.output.json; }},
    Setting{.option = "--json", .commands = C::kEval, .help = "File for the results; FILE.journal beside it lets an interrupted run go on",
            .writes = Kind::kFile, .field = [](O& o) -> F { return &o.output.json; }},
    Setting{.key = "output.truth", .option = "--truth", .commands = kPlayed, .help = "Folder of NNNNNN.label: print IoU_g and Recall_o, draw mistakes",
            .reads = "the truth", .field = [](O& o) -> F { return &o.output.truth; }},
    Setting{.key = "output.stream", .option = "--stream", .commands = C::kLive, .help = "Where other programs get every frame's labelled points (docs/reference/labelled_stream.md); a port alone: this machine's programs (default: nowhere)",
            .form = TextForm::kStream, .field = [](O& o) -> F { return &o.stream; }},
    Setting{.key = "output.stream_mode", .option = "--stream-mode", .commands = C::kLive, .help = "Rights of that socket's path: 600 its owner may read, 660 its group too, 666 all",
            .field = [](O& o) -> F { return choice(o.stream_mode, kStreamModeWords); }},
    Setting{.key = "output.stream_sectors", .option = "--stream-sectors", .commands = C::kLive, .help = "Those that ask for it get sectors in place of frames, each as soon as its labels are known, some milliseconds after it was measured",
            .bare = "yes", .needs = "--stream", .field = [](O& o) -> F { return &o.stream_sectors; }},
    Setting{.key = "output.mcap", .option = "--mcap", .commands = kPublished, .help = "Recording for ROS 2, Foxglove, Lichtblick and Rerun: NAME.mcap is one file, else the folder of a bag for `ros2 bag` (docs/guide/mcap.md)",
            .field = [](O& o) -> F { return &o.output.mcap.path; }},
    Setting{.key = "output.mcap_clouds", .option = "--mcap-clouds", .commands = kPublished, .help = "Clouds in it: points, one a frame, whose labels tell ground from obstacles; all, these two apart as well, in twice the room",
            .field = [](O& o) -> F { return choice(o.output.mcap.clouds, kMcapCloudsWords); }},
    Setting{.key = "output.mcap_split_mb", .option = "--mcap-split-mb", .commands = kPublished, .unit = "MB", .help = "A bag's file ends when it is so large; 0: not for that",
            .least = 0, .most = 1e6, .field = [](O& o) -> F { return &o.output.mcap.split_mb; }},
    Setting{.key = "output.mcap_split_s", .option = "--mcap-split-s", .commands = kPublished, .unit = "s", .help = "A bag's file ends when it spans so much; 0: not for that",
            .least = 0, .most = kLongest_s, .field = [](O& o) -> F { return &o.output.mcap.split_s; }},
    Setting{.key = "output.foxglove", .option = "--foxglove", .commands = kPublished | C::kView, .help = "Where Foxglove and Lichtblick connect to look at the frames; a port alone: from this machine (docs/guide/foxglove.md)",
            .form = TextForm::kServing, .bare = "8765", .field = [](O& o) -> F { return &o.output.foxglove; }},
    Setting{.key = "output.foxglove_origins", .option = "--foxglove-origins", .commands = kPublished | C::kView, .help = "Web pages elsewhere that may connect, like https://app.foxglove.dev",
            .form = TextForm::kList, .needs = "--foxglove", .field = [](O& o) -> F { return &o.output.foxglove_origins; }},
    Setting{.key = "output.frame_id", .option = "--frame-id", .commands = kPublished | C::kView | C::kNode, .help = "ROS frame that points lie in: x forward, y left, z up from the ground below the sensor",
            .field = [](O& o) -> F { return &o.output.frame_id; }},
    Setting{.key = "output.sensor_frame_id", .option = "--sensor-frame-id", .commands = kPublished | C::kView, .help = "ROS frame of the sensor, below which the points' frame is told to lie; off: no transform is told",
            .field = [](O& o) -> F { return &o.output.sensor_frame_id; }},
    Setting{.key = "output.view", .option = "--view", .commands = kPublished, .help = "Where a browser sees the frames as they come (docs/guide/view.md); a port alone: of this machine; no address: 8480 (default: nowhere)",
            .form = TextForm::kServingOrOff, .bare = "8480", .field = [](O& o) -> F { return &o.output.view; }},
    Setting{.option = "--at", .commands = C::kView, .help = "Where a browser sees the frames; a port alone: of this machine",
            .form = TextForm::kServingOrOff, .field = [](O& o) -> F { return &o.view_at; }},
    Setting{.option = "--beside", .commands = C::kView, .help = "Configuration file whose section `method` labels the same frames a second time, to be seen side by side",
            .reads = "the configuration beside", .field = [](O& o) -> F { return &o.beside; }},
    Setting{.key = "output.trace", .option = "--trace", .commands = C::kLive, .help = "File for the last frames as a trace, for ui.perfetto.dev",
            .writes = Kind::kFile, .field = [](O& o) -> F { return &o.trace; }},

    Setting{.key = "dds.publishes", .option = "--dds", .commands = kFrames | C::kLive, .help = "Publish every frame as ROS 2 messages over DDS (docs/guide/ros2.md)",
            .bare = "yes", .field = [](O& o) -> F { return &o.output.dds.publishes; }},
    Setting{.key = "dds.raw", .option = "--raw", .commands = kFrames | C::kLive, .help = "Publish the sensor's points without labels instead, in its own frame, as a driver would and `terracut node` takes them; a topic, or /points_raw",
            .form = TextForm::kTopic, .bare = "/points_raw", .needs = "--dds", .field = [](O& o) -> F { return &o.output.dds.raw; }},
    Setting{.key = "dds.sectors", .option = "--sectors", .commands = C::kLive, .help = "Also publish each sector's labelled points as soon as they are known, some milliseconds after they were measured; a topic, or ~/sectors",
            .form = TextForm::kTopic, .bare = "~/sectors", .needs = "--dds", .field = [](O& o) -> F { return &o.output.dds.sectors; }},
    Setting{.key = "dds.in", .option = "--in", .commands = C::kNode, .help = "Topic of the clouds to label",
            .form = TextForm::kTopic, .field = [](O& o) -> F { return &o.output.dds.in; }},
    Setting{.key = "dds.in_reliable", .option = "--in-reliable", .commands = C::kNode, .help = "Ask for lost parts of them again; only writers that are reliable are heard then",
            .bare = "yes", .field = [](O& o) -> F { return &o.output.dds.in_reliable; }},
    Setting{.key = "dds.frame", .option = "--frame", .commands = C::kNode, .help = "Frame that answers are moved to, by /tf_static, like base_link (default: that of their cloud)",
            .field = [](O& o) -> F { return &o.output.dds.frame; }},
    Setting{.key = "dds.node", .option = "--dds-node", .commands = kDds, .help = "Name of the ROS 2 node, under which its topics \"~/...\" lie",
            .form = TextForm::kTopic, .field = [](O& o) -> F { return &o.output.dds.node; }},
    Setting{.key = "dds.preset", .option = "--dds-preset", .commands = kDds, .help = "Topics: ros, ~/points ~/ground ~/obstacles ~/road; autoware, /perception/obstacle_segmentation/pointcloud; nav2, /ground_points /nonground_points",
            .field = [](O& o) -> F { return choice(o.output.dds.preset, kDdsPresetWords); }},
    Setting{.key = "dds.points", .commands = kDds, .help = "Topic of all points, each with its label; off: none (default: the preset's)",
            .form = TextForm::kTopic, .field = [](O& o) -> F { return &o.output.dds.points; }},
    Setting{.key = "dds.ground", .commands = kDds, .help = "Topic of the ground; off: none (default: the preset's)",
            .form = TextForm::kTopic, .field = [](O& o) -> F { return &o.output.dds.ground; }},
    Setting{.key = "dds.obstacles", .commands = kDds, .help = "Topic of the obstacles; off: none (default: the preset's)",
            .form = TextForm::kTopic, .field = [](O& o) -> F { return &o.output.dds.obstacles; }},
    Setting{.key = "dds.road", .commands = kDds, .help = "Topic of the road surface, where road.enabled asks for it; off: none (default: the preset's)",
            .form = TextForm::kTopic, .field = [](O& o) -> F { return &o.output.dds.road; }},
    Setting{.key = "dds.diagnostics", .commands = kDds, .help = "Topic of how the run does, once a second; off: none",
            .form = TextForm::kTopic, .field = [](O& o) -> F { return &o.output.dds.diagnostics; }},
    Setting{.key = "dds.objects", .commands = kPublished | C::kNode, .help = "Topic of the objects, with --objects, as vision_msgs/Detection3DArray; below it /markers for viewers; off: none",
            .form = TextForm::kTopic, .field = [](O& o) -> F { return &o.output.dds.objects; }},
    Setting{.key = "dds.free_way", .commands = kPublished | C::kNode, .help = "Topic of the free way, with --free-way, as sensor_msgs/LaserScan; below it /polygon and /grid; off: none",
            .form = TextForm::kTopic, .field = [](O& o) -> F { return &o.output.dds.free_way; }},
    Setting{.key = "dds.reliable", .commands = kDds, .help = "Keep what readers have not acknowledged, and send it again; no: best effort",
            .field = [](O& o) -> F { return &o.output.dds.reliable; }},
    Setting{.key = "dds.depth", .commands = kDds, .unit = "messages", .help = "So many of them are kept",
            .least = 1, .most = 100, .field = [](O& o) -> F { return &o.output.dds.depth; }},
    Setting{.key = "dds.domain", .option = "--dds-domain", .commands = kDds, .help = "DDS domain (default: ROS_DOMAIN_ID, else 0)",
            .least = 0, .most = 232, .field = [](O& o) -> F { return &o.output.dds.domain; }},
    Setting{.key = "dds.interface", .option = "--dds-interface", .commands = kDds, .help = "Network interface of it; lo: this machine alone (default: what Cyclone chooses; with ROS_LOCALHOST_ONLY=1 lo)",
            .form = TextForm::kName, .field = [](O& o) -> F { return &o.output.dds.interface; }},
    Setting{.key = "dds.fragment_bytes", .commands = kDds, .unit = "bytes", .help = "Messages go in pieces of so many; large ones are lost less on one machine, 1344 are one Ethernet frame",
            .least = 1000, .most = 65000, .field = [](O& o) -> F { return &o.output.dds.fragment_bytes; }},
    Setting{.key = "dds.receive_buffer_kib", .commands = kDds, .unit = "KiB", .help = "Buffer asked of the system for what comes in; net.core.rmem_max bounds it",
            .least = 64, .most = 262144, .field = [](O& o) -> F { return &o.output.dds.receive_buffer_kib; }},

    Setting{.key = "deadline.limit_ms", .option = "--deadline", .commands = C::kLive | C::kNode, .unit = "ms", .help = "From a return's packet, or a cloud, to its label",
            .least = 1, .most = 10000, .field = [](O& o) -> F { return &o.deadline_ms; }},

    Setting{.key = "realtime.priority", .option = "--priority", .commands = C::kLive, .help = "SCHED_FIFO priority of the thread that labels; 0: none",
            .least = 0, .most = 99, .field = [](O& o) -> F { return &o.realtime.priority; }},
    Setting{.key = "realtime.core", .option = "--core", .commands = C::kLive | C::kDoctor, .help = "The only core that the labelling thread runs on (default: any)",
            .least = 0, .most = 4095, .field = [](O& o) -> F { return &o.realtime.core; }},
    Setting{.key = "realtime.can_priority", .option = "--can-priority", .commands = C::kLive, .help = "SCHED_FIFO priority of the thread that hears the vehicle's CAN bus; 0: none",
            .least = 0, .most = 99, .field = [](O& o) -> F { return &o.realtime.can_priority; }},
    Setting{.key = "realtime.lock_memory", .option = "--no-lock-memory", .commands = C::kLive, .help = "Keep all memory of the process present",
            .bare = "no", .field = [](O& o) -> F { return &o.realtime.lock_memory; }},

    Setting{.key = "recorder.seconds", .option = "--recorder-seconds", .commands = C::kLive, .unit = "s", .help = "Packets kept for a dump; 0: none",
            .least = 0, .most = 600, .field = [](O& o) -> F { return &o.recorder.seconds; }},
    Setting{.key = "recorder.folder", .option = "--recorder-folder", .commands = C::kLive, .help = "Folder for the last seconds of packets, written when a deadline is missed or `terracut dump` asks (default: none is written)",
            .writes = Kind::kSharedFolder, .field = [](O& o) -> F { return &o.recorder.folder; }},

    Setting{.key = "metrics.address", .option = "--metrics", .commands = C::kLive | C::kNode, .help = "Where Prometheus reads /metrics; a port alone: this machine's programs; off: nowhere",
            .form = TextForm::kServingOrOff, .field = [](O& o) -> F { return &o.watch.metrics; }},
    Setting{.key = "metrics.name", .option = "--name", .commands = C::kLive | C::kNode, .help = "Name under which `terracut top` and `dump` find the process",
            .form = TextForm::kName, .field = [](O& o) -> F { return &o.watch.name; }},
    Setting{.key = "metrics.health_can", .option = "--health-can", .commands = C::kLive, .help = "CAN interface on which terracut says how it is, terracut_health.dbc (default: none)",
            .form = TextForm::kName, .field = [](O& o) -> F { return &o.watch.health_can; }},

    Setting{.key = "replay.rate", .option = "--rate", .commands = C::kReplay, .help = "Pace by the capture's stamps: 1 as recorded, 0 flat out",
            .least = 0, .most = 1000, .field = [](O& o) -> F { return &o.replay.rate; }},
    Setting{.key = "replay.loop", .option = "--loop", .commands = C::kReplay, .unit = "passes", .help = "Passes over the capture; no number or 0: until interrupted",
            .least = 0, .most = kMostLoops, .bare = "0", .field = [](O& o) -> F { return &o.replay.loops; }},

    Setting{.key = "simulate.scene", .option = "--scene", .commands = C::kSimulate, .help = "What is driven through",
            .field = [](O& o) -> F { return name_choice(o.simulate.scene, {scenes::scene_names().begin(), scenes::scene_names().end()}); }},
    Setting{.option = "--pattern", .commands = C::kSimulate, .help = "Clouds of a sensor without rows instead of packets: a folder with scans and truth, as SemanticKITTI's",
            .needs = "--output", .excludes = "--sensor", .field = [](O& o) -> F { return pattern_choice(o.simulate.pattern); }},
    Setting{.key = "simulate.seed", .option = "--seed", .commands = kDrives, .help = "The same seed gives the same drive",
            .least = 0, .most = kMostSeed, .field = [](O& o) -> F { return &o.simulate.seed; }},
    Setting{.key = "simulate.duration_s", .option = "--duration", .commands = kDrives, .unit = "s", .help = "How long to drive",
            .least = 0.1, .most = 3600, .field = [](O& o) -> F { return &o.simulate.duration_s; }},
    Setting{.key = "simulate.spin_hz", .option = "--spin-hz", .commands = C::kSimulate, .unit = "Hz", .help = "Frames a second: 5, 10 and 20 are the sensors' own",
            .least = 5, .most = 20, .field = [](O& o) -> F { return &o.simulate.spin_hz; }},
    Setting{.key = "simulate.returns", .option = "--returns", .commands = kDrives, .help = "single: the strongest; dual: the strongest and the last",
            .field = [](O& o) -> F { return choice(o.simulate.returns, kReturnsWords); }},
    Setting{.key = "simulate.timestamp", .option = "--timestamp", .commands = C::kSimulate, .help = "Ruby128: how its stamps are encoded",
            .field = [](O& o) -> F { return choice(o.simulate.timestamp, kTimestampWords); }},
    Setting{.key = "simulate.product", .option = "--product", .commands = C::kSimulate, .help = "Ouster: whose beams, where no --calibration tells a unit's",
            .field = [](O& o) -> F { return choice(o.simulate.product, kProductWords); }},
    Setting{.key = "simulate.noise_m", .option = "--noise", .commands = C::kSimulate, .unit = "m", .help = "Standard deviation of the range noise",
            .least = 0, .most = 1, .field = [](O& o) -> F { return &o.simulate.noise_m; }},
    Setting{.option = "--speed", .commands = C::kSimulate, .unit = "m/s", .help = "Of the vehicle (default: what is usual there)",
            .least = 0, .most = 60, .field = [](O& o) -> F { return &o.simulate.speed_mps; }},
    Setting{.option = "--yaw-rate", .commands = C::kSimulate, .unit = "deg/s", .help = "To the left positive: drive on an arc instead of along the road",
            .least = -57, .most = 57, .field = [](O& o) -> F { return &o.simulate.yaw_rate_dps; }},
    Setting{.option = "--keep-compensation", .commands = C::kEncode, .help = "Take the points as they are recorded, poses or not",
            .bare = "yes", .field = [](O& o) -> F { return &o.encode.keep_compensation; }},
    Setting{.option = "--can-log", .commands = C::kSimulate, .help = "Write the vehicle's speed and yaw rate beside the capture: NAME.can.log, NAME.can.dbc",
            .bare = "yes", .needs = "--output", .field = [](O& o) -> F { return &o.can_log; }},
    Setting{.option = "--can-log", .commands = C::kEncode, .help = "Write that motion beside the capture, NAME.can.log and NAME.can.dbc; the sensor then looks backwards, for recorded frames begin behind",
            .bare = "yes", .excludes = "--keep-compensation", .field = [](O& o) -> F { return &o.can_log; }},

    // The destination of a drive
    Setting{.option = "--udp", .commands = C::kSimulate, .help = "ADDRESS[:PORT]: be the sensor, and send the drive in real time; until it is computed its beginning, over and over",
            .field = [](O& o) -> F { return &o.send.to; }},
    Setting{.option = "--to", .commands = C::kSend, .required_by = C::kSend, .help = "ADDRESS:PORT to send to; a multicast group and broadcast will do.\nADDRESS alone: every datagram to the port it was captured on",
            .field = [](O& o) -> F { return &o.send.to; }},
    Setting{.option = "--rate", .commands = C::kSend, .help = "Pace by the capture's stamps: 1 as recorded, 0 flat out",
            .least = 0, .most = 1000, .field = [](O& o) -> F { return &o.send.play.rate; }},
    Setting{.option = "--loop", .commands = kSending, .unit = "passes", .help = "Passes over the packets; no number or 0: until interrupted",
            .least = 0, .most = kMostLoops, .bare = "0", .needs = "--udp", .field = [](O& o) -> F { return &o.send.play.loops; }},
    Setting{.option = "--interface", .commands = kSending, .help = "Send by this interface (default: by the routes)",
            .form = TextForm::kName, .needs = "--udp", .field = [](O& o) -> F { return &o.send.interface; }},
    Setting{.option = "--faults", .commands = kSending, .help = "What goes wrong on the way, by seconds since the first packet:\nloss@2.5s:20packets reorder@4s:3 duplicate@4.5s:2 pause@5s:0.4s burst@6s:50ms\nforeign@7s:50 clock@8s:+2.0s truncate@9s:5",
            .needs = "--udp", .field = [](O& o) -> F { return &o.send.faults; }},
    Setting{.option = "--foreign-from", .commands = kSending, .help = "Address of this machine that foreign packets come from",
            .form = TextForm::kAddress, .needs = "--udp", .field = [](O& o) -> F { return &o.send.foreign_from; }},

    Setting{.key = "bench.repeat", .option = "--repeat", .commands = C::kBench, .unit = "passes", .help = "Passes over the capture",
            .least = 1, .most = 100000, .field = [](O& o) -> F { return &o.bench_repeat; }},
    Setting{.key = "bench.core", .option = "--core", .commands = C::kBench, .help = "Processor core to stay on; -1: the last one allowed",
            .least = -1, .most = 4095, .field = [](O& o) -> F { return &o.bench_core; }},

    // Labelled datasets
    Setting{.option = "--sequences", .commands = C::kEval, .help = "Only these, like 00,03 (default: all with labels)",
            .form = TextForm::kList, .field = [](O& o) -> F { return &o.eval.sequences; }},
    Setting{.option = "--frames", .commands = C::kEval, .help = "Only these of every sequence: FIRST, FIRST-LAST or FIRST-LAST:STEP, from 0",
            .field = [](O& o) -> F { return &o.eval.frames; }},
    Setting{.option = "--method", .commands = C::kEval, .help = "Methods to compare, like terracut,paper,ring_map (default: the profile)",
            .form = TextForm::kList, .field = [](O& o) -> F { return &o.eval.methods; }},
    Setting{.option = "--variant", .commands = C::kEval, .help = "NAME=METHOD,KEY=VALUE,...: one more, a method with other parameters; repeatable",
            .field = [](O& o) -> F { return &o.eval.variants; }},
    Setting{.option = "--kinds", .commands = C::kEval, .help = "hazards: only these, like lying_person,ghosts_1 (default: all)",
            .form = TextForm::kList, .field = [](O& o) -> F { return &o.eval.kinds; }},
    Setting{.option = "--trials", .commands = C::kEval, .help = "hazards: how many of a kind for each ground, range and frame; free: how\nmany boxes, and how many pits, for each range and frame",
            .least = 1, .most = 1000, .field = [](O& o) -> F { return &o.eval.trials; }},
    Setting{.option = "--write", .commands = C::kEval, .help = "hazards: folder for every scan they were put into, as SemanticKITTI's, and\nhazards.json, which says what each shows",
            .writes = Kind::kFolder, .field = [](O& o) -> F { return &o.eval.hazard_scans; }},
    Setting{.option = "--through", .commands = C::kEval, .help = "image: scans straight into the range image; packets: encoded and decoded first (default: image)",
            .field = [](O& o) -> F { return choice(o.eval.through_packets, kThroughWords); }},
    Setting{.option = "--find-mount", .commands = C::kEval, .help = "Label by the mount that each sequence or drive shows, as runs do (default: the stated one, 1.73 m and level)",
            .bare = "yes", .field = [](O& o) -> F { return &o.eval.find_mount; }},
    Setting{.option = "--jobs", .commands = C::kEval, .help = "Threads, each on a core of its own; 0: one a core",
            .least = 0, .most = 1024, .field = [](O& o) -> F { return &o.eval.jobs; }},
    Setting{.option = "--classes", .commands = C::kEval, .help = "YAML file: what classes count as, and how files lie on disk (own: needed)",
            .reads = "the table of classes", .field = [](O& o) -> F { return &o.eval.classes; }},
    Setting{.option = "--predictions", .commands = C::kEval, .help = "Folder for METHOD/sequences/NN/predictions/NNNNNN.label",
            .writes = Kind::kFolder, .field = [](O& o) -> F { return &o.eval.predictions; }},
    Setting{.option = "--report", .commands = C::kEval, .help = "Folder for what ./tools/report draws its page from: evaluation.json, pictures",
            .writes = Kind::kFolder, .field = [](O& o) -> F { return &o.eval.report; }},
    Setting{.option = "--changes", .commands = C::kEval, .help = "Folder for pictures: of every method but the first the frame it labels most\ndifferently from the first, METHOD.png, and what they show, changes.json;\nevery frame is labelled, so there is no journal",
            .writes = Kind::kFolder, .field = [](O& o) -> F { return &o.eval.changes; }},

    // Recordings of a fleet
    Setting{.option = "BEFORE", .commands = C::kCompare, .required_by = C::kCompare, .help = "Folder of label files, or of relabel (its newest job), or FOLDER/.relabel/JOB",
            .reads = "the labels before", .field = [](O& o) -> F { return &o.compare.before; }},
    Setting{.option = "AFTER", .commands = C::kCompare, .required_by = C::kCompare, .help = "The same, to be compared with it",
            .reads = "the labels after", .field = [](O& o) -> F { return &o.compare.after; }},
    Setting{.option = "--most", .commands = C::kCompare, .help = "How many of the most changed drives and frames to name and to draw",
            .least = 1, .most = 10000, .field = [](O& o) -> F { return &o.compare.most; }},
    Setting{.option = "--trust-sums", .commands = C::kCompare, .help = "Do not read files whose sums in both SHA256SUMS are the same and that were not written to since; finds no rotten ones",
            .bare = "yes", .field = [](O& o) -> F { return &o.compare.trust_sums; }},
    Setting{.option = "--png", .commands = C::kCompare, .help = "Folder for pictures of the most changed frames, from above; of relabel's folders",
            .writes = Kind::kFrames, .ending = ".png", .field = [](O& o) -> F { return &o.output.png; }},
    Setting{.option = "--json", .commands = C::kCompare, .help = "The same as a file for programs",
            .writes = Kind::kFile, .field = [](O& o) -> F { return &o.output.json; }},
    Setting{.option = "--shard", .commands = C::kRelabel, .help = "I/N: the I-th of N parts of about the same size",
            .field = [](O& o) -> F { return &o.fleet.shard; }},
    Setting{.option = "--status", .commands = C::kRelabel, .help = "Folder: say what is done there, missing and failed, and when it will end",
            .field = [](O& o) -> F { return &o.fleet.status; }},

    // Watched runs, and what is printed
    Setting{.option = "--wait", .commands = C::kDump, .unit = "s", .help = "For its answer",
            .least = 0, .most = 3600, .field = [](O& o) -> F { return &o.wait_s; }},
    Setting{.option = "--once", .commands = C::kTop, .help = "Print once and exit",
            .bare = "yes", .field = [](O& o) -> F { return &o.once; }},
    Setting{.option = "--interval", .commands = C::kTop, .unit = "s", .help = "Between two looks",
            .least = 0.1, .most = 3600, .field = [](O& o) -> F { return &o.interval_s; }},
    Setting{.option = "--print-json", .commands = C::kTop | C::kDoctor, .help = "Print the figures or findings once, for programs",
            .bare = "yes", .field = [](O& o) -> F { return &o.print_json; }},
    Setting{.option = "--print-default", .commands = C::kConfig, .help = "Print a file with every key, its range and default (else: the one in force)",
            .bare = "yes", .field = [](O& o) -> F { return &o.print_default; }},
    Setting{.option = "--print-table", .commands = C::kConfig, .help = "Print the table of docs/reference/configuration.md",
            .bare = "yes", .field = [](O& o) -> F { return &o.print_table; }},
};
// clang-format on

}  // namespace

std::span<const Setting> settings() noexcept {
  return kSettings;
}

const Setting* find_setting(std::string_view key) noexcept {
  const auto found = std::ranges::find(kSettings, key, &Setting::key);
  return key.empty() || found == kSettings.end() ? nullptr : &*found;
}

const Setting* find_option(Command command, std::string_view option) noexcept {
  const auto found = std::ranges::find_if(kSettings, [&](const Setting& setting) {
    const bool is_its =
        setting.name() == option || setting.option.substr(0, setting.option.find(',')) == option;
    return is_its && setting.commands.contains(command);
  });
  return option.empty() || found == kSettings.end() ? nullptr : &*found;
}

}  // namespace terracut::cli
