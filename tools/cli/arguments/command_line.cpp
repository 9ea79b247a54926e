// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "command_line.hpp"

#include <CLI/CLI.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <sstream>

#include "tools/cli/settings/setting_text.hpp"
#include "tools/research/baselines/method_config.hpp"

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
    "6 deadlines were missed; 7 doctor found a problem;\n"
    "9 interrupted (Ctrl-C, SIGTERM) before the work was done;\n"
    "10 the ground does not show how the sensor stands: state it, or --mount-guess.\n"
    "`--config FILE` goes with every command (`terracut config --print-default` prints one).\n"
    "`terracut COMMAND --help` lists a command's options.";

template <class Field>
bool is_a(const Setting& setting) {
  Options scratch;
  return std::holds_alternative<Field>(setting.field(scratch));
}
using List = std::vector<std::string>*;
using Switch = bool*;

/// Returns the placeholder that help shows for the value: "m", "auto|hdl64e|ruby128", "PATH".
std::string value_name(const Setting& setting) {
  Options scratch;
  const SettingField field = setting.field(scratch);
  if (const auto* choice = std::get_if<ChoiceField>(&field)) {
    return fmt::format("{}", fmt::join(choice->words, "|"));
  }
  if (std::holds_alternative<std::filesystem::path*>(field)) return "PATH";
  if (!setting.bare.empty()) {
    return fmt::format("[{}]", setting.unit.empty() ? form_name(setting) : setting.unit);
  }
  if (!setting.unit.empty()) return std::string(setting.unit);
  return std::string(setting.least < setting.most ? "NUMBER" : form_name(setting));
}

/// Returns the help of a setting: what it is, its range, and its default.
std::string help_of(const Setting& setting, Command command, const Options& in_force) {
  std::string text(setting.help);
  if (setting.bare == "no") {
    text = fmt::format("Do not {}{}", static_cast<char>(std::tolower(text[0])), text.substr(1));
  }
  if (setting.least < setting.most) text += fmt::format(" [{}]", allowed_text(setting));
  const std::string value = value_text(setting, in_force);
  const bool says_default = text.find("default:") != std::string::npos;
  if (!value.empty() && !is_a<Switch>(setting) && !says_default) {
    text += fmt::format(" (default: {})", value);
  }
  if (find_option(command, setting.needs) != nullptr) {
    text += fmt::format("; needs {}", setting.needs);
  }
  if (find_option(command, setting.excludes) != nullptr) {
    text += fmt::format("; not with {}", setting.excludes);
  }
  return text;
}

std::string method_list() {
  std::string text = ":";
  for (const baselines::MethodName& known : baselines::method_names()) {
    text += fmt::format("\n  {}: {}", known.name, known.about);
  }
  return text;
}

void add_option(CLI::App& sub, const Setting& setting, Command command, const Options& in_force,
                CommandLine& line) {
  const std::string name(setting.option);
  std::string help = help_of(setting, command, in_force);
  if (is_a<Switch>(setting)) {
    sub.add_flag_callback(
        name, [&] { line.typed.push_back({&setting, {std::string(setting.bare)}}); }, help);
    return;
  }
  if (setting.name() == "--method" && is_a<ChoiceField>(setting)) help += method_list();
  CLI::Option* option = sub.add_option(
      name,
      [&](CLI::results_t texts) {
        if (texts.front().empty()) texts.front() = setting.bare;
        line.typed.push_back({&setting, std::move(texts)});
        return true;
      },
      help);
  option->type_name(value_name(setting))->required(setting.required_by.contains(command));
  if (is_a<List>(setting)) option->expected(1, -1)->allow_extra_args(false);
  if (!setting.bare.empty()) option->expected(0, 1);
}

/// Returns the first required argument or option that was not given; empty if none is missing.
std::string what_is_missing(const CommandLine& line) {
  for (const Setting& setting : settings()) {
    const bool is_required = line.command && setting.required_by.contains(*line.command);
    if (!is_required || std::ranges::count(line.typed, &setting, &TypedOption::setting)) continue;
    return fmt::format("{} is missing: {}", setting.name(),
                       setting.help.substr(0, setting.help.find('\n')));
  }
  return "a command is missing";
}

tl::unexpected<Error> wrong(const CommandLine& line, std::string_view what) {
  return fail(ErrorCode::kInvalidArgument,
              fmt::format("{}: {}", line.command ? name_of(*line.command) : "terracut", what));
}

/// Adds --config only for help and checks: the file that it names was read before, by
/// configuration_named_in().
void add_config_option(CLI::App& app) {
  app.add_option_function<std::string>(
         "--config", [](const std::string&) {},
         "Configuration file; the command line wins over it (docs/reference/configuration.md)")
      ->type_name("PATH");
}

}  // namespace

Expected<CommandLine> read_command_line(const std::vector<std::string>& words,
                                        const Options& in_force) {
  CommandLine line;
  CLI::App app{kAbout, "terracut"};
  app.footer(kExitCodes);
  app.set_version_flag("--version", "terracut " TERRACUT_VERSION);
  app.require_subcommand(1);  // exactly one: after a command, a word such as `live` may be a name
  add_config_option(app);
  for (std::size_t i = 0; i < kCommands.size(); ++i) {
    const auto command = static_cast<Command>(i);
    CLI::App* sub =
        app.add_subcommand(std::string(kCommands[i].name), std::string(kCommands[i].about));
    for (const Setting& setting : settings()) {
      if (setting.option.empty() || !setting.commands.contains(command)) continue;
      add_option(*sub, setting, command, in_force, line);
    }
    add_config_option(*sub);
    sub->preparse_callback([&line, command](std::size_t) { line.command = command; });
  }
  try {
    app.parse(std::vector<std::string>(words.rbegin(), words.rend()));
  } catch (const CLI::Success& wanted) {
    std::ostringstream out, none;
    app.exit(wanted, out, none);
    line.text = out.str();
    line.command.reset();
  } catch (const CLI::RequiredError&) {
    return wrong(line, what_is_missing(line));
  } catch (const CLI::ParseError& error) {
    return wrong(line, error.what());
  }
  return line;
}

}  // namespace terracut::cli
