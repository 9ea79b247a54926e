// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "tools/cli/command.hpp"
#include "tools/cli/files/run_files.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// A value that is one of several, by their words.
struct ChoiceField {
  std::vector<std::string_view> words;
  std::string_view chosen;  ///< Empty: none.
  std::function<void(std::size_t)> choose;
};

/// Where a setting's value lives.
using SettingField =
    std::variant<double*, std::optional<double>*, int*, std::optional<int>*, std::uint64_t*,
                 std::uint16_t*, std::optional<std::uint16_t>*, bool*, std::string*,
                 std::filesystem::path*, std::vector<std::string>*, ChoiceField>;

/// What a text has to look like; setting_text.cpp says how.
enum class TextForm : std::uint8_t {
  kAny,
  kAddress,
  kSender,  ///< An address, or one with a port.
  kVlan,
  kMac,
  kEndpoint,      ///< To listen at; a port alone: at any address.
  kServing,       ///< To serve others at; a port alone: this machine's programs.
  kServingOrOff,  ///< The same, or off.
  kStream,        ///< The same, or a socket's path.
  kName,
  kList,       ///< Texts with commas between.
  kParameter,  ///< KEY=VALUE, of the method.
  kKeyValue,   ///< KEY=VALUE, of anything.
  kTopic,      ///< Of ROS, or "off".
};

/// One thing that a command can be told. From the table of them come the command line's options,
/// the keys of the configuration file, what is said of wrong ones, and
/// docs/reference/configuration.md. The parameters of the method are further keys, "method." before
/// their name in pipeline/ground/parameter_table.hpp.
struct Setting {
  std::string_view key{};     ///< Of the file, "section.name_unit"; empty: not in the file.
  std::string_view option{};  ///< "--mount-height", "-o,--output", "FILE"; empty: only in the file.
  CommandSet commands{};      ///< That look at it.
  CommandSet required_by{};
  std::string_view unit{};  ///< "m", "ms", ... or empty
  std::string_view help{};
  double least = 0, most = 0;  ///< Valid range of a number, ends included.
  TextForm form = TextForm::kAny;
  std::string_view bare{};      ///< What the option alone means; empty: it needs a value.
  std::string_view needs{};     ///< Option that has to have a value, where the command has it.
  std::string_view excludes{};  ///< Option that is not given together with this one.
  std::string_view reads{};     ///< Of a path: that it is read, and as what, "the calibration".
  std::optional<RunFiles::Kind> writes{};  ///< Of a path: that it is written.
  std::string_view ending{};               ///< Of the files in a folder of frames.
  CommandSet denied_to{};                  ///< Where it is looked for, and is not to be had.
  std::string_view denial{};               ///< Why, and what there is instead.
  SettingField (*field)(Options&) = nullptr;

  /// Its option, as people name it: "--output", "FILE".
  [[nodiscard]] std::string_view name() const noexcept {
    return option.substr(option.find(',') + 1);
  }
};

/// Every setting; those of the file by section in the file's order.
[[nodiscard]] std::span<const Setting> settings() noexcept;

/// The setting of that key; null: there is none.
[[nodiscard]] const Setting* find_setting(std::string_view key) noexcept;

/// The setting of that option, "--output" or "-o", of a command; null: it has none.
[[nodiscard]] const Setting* find_option(Command command, std::string_view option) noexcept;

}  // namespace terracut::cli
