// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rt/error.hpp"

namespace terracut::datasets {

/// The points of a PCD file (the Point Cloud Library's format: a header that names the fields, then
/// `DATA ascii`, `binary` or `binary_compressed`, little-endian), by field.
class PcdCloud {
 public:
  /// kNotFound, kUnreadable, kMalformed, kUnsupported; the message names the file, the line of the
  /// header or the point, what was found and what expected.
  [[nodiscard]] static Expected<PcdCloud> read(const std::filesystem::path& path);
  /// The same from memory; `name` stands for the path in messages.
  [[nodiscard]] static Expected<PcdCloud> parse(std::string_view content, const std::string& name);

  [[nodiscard]] std::size_t points() const noexcept { return points_; }
  [[nodiscard]] const std::vector<std::string>& fields() const noexcept { return names_; }
  /// A value a point, whatever its type in the file; nothing for a field that is not there or has
  /// several values a point.
  [[nodiscard]] std::optional<std::span<const double>> field(std::string_view name) const;

 private:
  friend class PcdReader;
  std::size_t points_ = 0;
  std::vector<std::string> names_;           ///< Of the fields with one value a point.
  std::vector<std::vector<double>> values_;  ///< By the same index.
};

}  // namespace terracut::datasets
