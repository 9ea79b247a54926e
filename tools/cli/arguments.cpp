// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "arguments.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "arguments/command_options.hpp"
#include "command_defaults.hpp"
#include "configuration_file.hpp"
#include "console.hpp"
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
    "6 deadlines were missed; 7 doctor found a problem; 8 a measure got worse;\n"
    "9 interrupted (Ctrl-C, SIGTERM) before the work was done.\n"
    "`--config FILE` goes with every command (`terracut config --print-default` prints one).\n"
    "`terracut COMMAND --help` lists a command's options.";

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

/// The kinds of method that these options let run; a name that is none is refused elsewhere.
std::vector<pipeline::MethodKind> kinds_of(const MethodOptions& method) {
  return {method_config_of(method).kind};
}
std::vector<pipeline::MethodKind> kinds_of(const EvalOptions& options) {
  std::vector<pipeline::MethodKind> kinds;
  for (const std::string& name : options.methods) {
    if (const auto method = pipeline::method_named(name)) kinds.push_back(method->kind);
  }
  return kinds;
}

/// Of the command line's settings alone: the file's are for all commands, whatever runs in them.
template <class Options>
void refuse_unheeded(const std::vector<std::string>& settings, const Options& options) {
  const auto kinds = kinds_of(options);
  if (kinds.empty()) return;
  if (const Status heeded = check_heeded(settings, kinds); !heeded) {
    throw CLI::ValidationError("--set", heeded.error().message);
  }
}

/// An empty value is a mistake, of a script mostly; it would count as none.
void refuse_empty_values(const CLI::App& sub) {
  for (const CLI::Option* option : sub.get_options()) {
    const std::vector<std::string>& values = option->results();
    if (option->get_expected_max() == 0 || std::ranges::find(values, "") == values.end()) continue;
    throw CLI::ValidationError(option->get_name(), "expected a value, found an empty one");
  }
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
    refuse_empty_values(*sub);
    if constexpr (requires { options->mount; }) drop_overruled(*sub, options->mount);
    [[maybe_unused]] const std::vector<std::string>& of_file =
        reading.configuration.live.method.settings;
    if constexpr (requires { options->method.settings; }) {
      refuse_unheeded(options->method.settings, options->method);
      put_before(options->method.settings, of_file);
    }
    if constexpr (requires { options->settings; }) {
      refuse_unheeded(options->settings, *options);
      put_before(options->settings, of_file);
    }
    reading.command = *options;
  });
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
  result.configuration = configuration_file_of(argc, argv);
  if (!result.configuration.empty()) {
    Expected<Configuration> read = read_configuration(result.configuration);
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
