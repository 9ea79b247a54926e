// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "live/live_options.hpp"
#include "options.hpp"
#include "rt/error.hpp"

namespace terracut::cli {

/// What a configuration file can say, for every command at once; as constructed, the defaults. The
/// commands' options start from it and the command line is read over them (arguments.cpp).
struct Configuration {
  LiveOptions live;          ///< Also the capture, mount, method and motion of other commands.
  OutputOptions output;      ///< Of live too, whose own `labels` and `json` are not used here.
  ReplayOptions replay;      ///< `rate` and `loops`.
  SimulateOptions simulate;  ///< All but the calibration, mount and output.
  BenchOptions bench;        ///< `repeat` and `core`.
};

/// Where a setting's value lives.
using SettingField = std::variant<double*, std::optional<double>*, int*, std::optional<int>*,
                                  std::uint64_t*, std::uint16_t*, std::optional<std::uint16_t>*,
                                  bool*, std::string*, std::filesystem::path*>;

/// What a setting that is text has to look like.
enum class TextForm { kAny, kAddress, kEndpoint, kEndpointOrOff, kStream, kName };

/// One key of the configuration file (docs/configuration.md is printed from the table of them).
/// The parameters of the method are further keys, "method." before their name in
/// pipeline/parameter_table.hpp.
struct Setting {
  std::string_view key;     ///< "section.name_unit"
  std::string_view option;  ///< Of the command line, "--mount-height"; empty: only in the file.
  std::string_view unit;    ///< "m", "ms", ... or empty
  std::string_view help;
  double least = 0, most = 0;                   ///< Valid range of a number, ends included.
  std::span<const std::string_view> choices{};  ///< The words allowed; empty: see the field's type.
  TextForm form = TextForm::kAny;
  SettingField (*field)(Configuration&) noexcept = nullptr;
};

/// Every setting, by section in the file's order.
[[nodiscard]] std::span<const Setting> settings() noexcept;

/// The setting of that key; null: there is none.
[[nodiscard]] const Setting* find_setting(std::string_view key) noexcept;

}  // namespace terracut::cli
