// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "arguments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "command_line.hpp"
#include "option_names.hpp"
#include "tools/cli/settings/configuration_file.hpp"
#include "tools/cli/settings/setting_text.hpp"
#include "tools/cli/settings/setup_choice.hpp"

namespace terracut::cli {
namespace {

/// Assembles the options of a command: those of the configuration file, then those typed.
class Assembly {
 public:
  Assembly(Command command, const std::vector<TypedOption>& typed)
      : command_(command), typed_(typed) {
    for (const TypedOption& option : typed) options_.given.emplace_back(option.setting->name());
  }

  Expected<Options> assemble(const Options& of_file) && {
    Status status = take(of_file);
    if (status) status = check_given();
    if (status) status = apply_typed();
    if (status) status = check_needs();
    if (!status) {
      return fail(status.error().code,
                  fmt::format("{}: {}", name_of(command_), status.error().message));
    }
    return std::move(options_);
  }

 private:
  [[nodiscard]] bool is_given(std::string_view name) const {
    return std::ranges::find(options_.given, name) != options_.given.end();
  }
  static tl::unexpected<Error> wrong(std::string message) {
    return fail(ErrorCode::kInvalidArgument, std::move(message));
  }

  /// Takes the file's options for this command. The file's mount does not change a typed --setup.
  Status take(const Options& of_file) {
    for (const Setting& setting : settings()) {
      const bool is_its = command_ == Command::kConfig || setting.commands.contains(command_);
      if (setting.key.empty() || !is_its) continue;
      if (setting.key.starts_with("mount.") && is_given("--setup")) continue;
      const std::string text = value_text(setting, of_file);
      if (text.empty()) continue;
      if (Status taken = apply_text(setting, text, {}, options_); !taken) return taken;
    }
    if (command_ == Command::kConfig || find_option(command_, "--set") != nullptr) {
      options_.method.settings = of_file.method.settings;
    }
    return {};
  }

  Status check_given() const {
    for (const TypedOption& option : typed_) {
      const Setting& setting = *option.setting;
      if (!setting.excludes.empty() && is_given(setting.excludes)) {
        return wrong(fmt::format("{} and {} exclude each other", setting.name(), setting.excludes));
      }
    }
    return {};
  }

  Status apply_typed() {
    const std::size_t of_file = options_.method.settings.size();
    for (const TypedOption& option : typed_) {
      for (const std::string& text : option.texts) {
        if (Status set = apply_text(*option.setting, text, {}, options_); !set) {
          return wrong(fmt::format("{}: {}", option.setting->name(), set.error().message));
        }
      }
    }
    // The configuration file may hold parameters of methods that do not run; a typed parameter must
    // belong to a method that runs.
    const std::span<const std::string> settings = options_.method.settings;
    if (const Status used = check_used(settings.subspan(of_file), kinds()); !used) {
      return wrong("--set: " + used.error().message);
    }
    return {};
  }

  /// Returns the kinds of method that these options run; unknown names, which are refused
  /// elsewhere, are left out.
  [[nodiscard]] std::vector<baselines::MethodKind> kinds() const {
    std::vector<baselines::MethodKind> kinds;
    for (const std::string& name : options_.eval.methods) {
      if (const auto method = baselines::method_named(name)) kinds.push_back(method->kind);
    }
    if (options_.eval.methods.empty()) kinds.push_back(method_config_of(options_.method).kind);
    return kinds;
  }

  Status check_needs() const {
    for (const TypedOption& option : typed_) {
      const Setting& setting = *option.setting;
      const Setting* const needed = find_option(command_, setting.needs);
      if (needed != nullptr && value_text(*needed, options_).empty()) {
        return wrong(fmt::format("{} needs {}: {}", setting.name(), setting.needs, needed->help));
      }
    }
    return {};
  }

  Command command_;
  const std::vector<TypedOption>& typed_;
  Options options_;
};

}  // namespace

Expected<Arguments> parse_arguments(const std::vector<std::string>& words) {
  Arguments arguments;
  if (const Status known = check_names(words); !known) return tl::unexpected(known.error());
  arguments.configuration = configuration_named_in(words);
  Options of_file;
  if (!arguments.configuration.empty()) {
    Expected<Options> read = read_configuration(arguments.configuration);
    if (!read) return tl::unexpected(read.error());
    of_file = *std::move(read);
  }
  Expected<CommandLine> line = read_command_line(words, of_file);
  if (!line) return tl::unexpected(line.error());
  arguments.command = line->command;
  arguments.text = std::move(line->text);
  if (!arguments.command) return arguments;
  Expected<Options> options = Assembly(*line->command, line->typed).assemble(of_file);
  if (!options) return tl::unexpected(options.error());
  arguments.options = *std::move(options);
  return arguments;
}

}  // namespace terracut::cli
