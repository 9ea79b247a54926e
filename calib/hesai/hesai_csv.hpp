// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "calib/beams/beam_table.hpp"
#include "rt/error.hpp"

/// The angle table that comes with a Hesai unit: a line of column names, then
/// "channel,elevation,azimuth offset" in degrees for channels 1, 2, ...
namespace terracut::hesai {

/// Returns the table in `text`, of the model with as many channels whose nominal elevations are
/// nearest; `name` says where it comes from. Fails with kMalformed, naming the line: other columns,
/// channels out of order, angles that are no finite numbers, a number of channels that no model
/// has, or elevations more than 3 degrees from every such model's.
[[nodiscard]] Expected<beams::BeamTable> parse_hesai_csv(std::span<const char> text,
                                                         const std::string& name);
/// Reads a file of up to text::kMaxFileBytes; fails with kNotFound or kUnreadable, too. If a model
/// is `wanted`, fails with kUnsupported for the table of another.
[[nodiscard]] Expected<beams::BeamTable> read_hesai_csv(
    const std::filesystem::path& path, std::optional<sensor::SensorModel> wanted = std::nullopt);

/// True if a text looks like this table and not like another maker's: its second line has three
/// fields.
[[nodiscard]] bool is_like_hesai_csv(std::span<const char> text);

/// Returns the table as text, in thousandths of a degree, which parse_hesai_csv() reads back.
[[nodiscard]] std::string hesai_csv_text(const beams::BeamTable& table);
/// Writes the file whole or not at all.
[[nodiscard]] Status write_hesai_csv(const std::filesystem::path& path,
                                     const beams::BeamTable& table);

}  // namespace terracut::hesai
