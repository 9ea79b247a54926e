// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace terracut::evaluation::report {

using Json = nlohmann::ordered_json;

/// Where a number lies in the evaluation: the keys, or places in a list, from its root on.
using Path = std::vector<std::string>;

/// The number there; none where it is null or there is no such place.
[[nodiscard]] std::optional<double> number_at(const Json& evaluation, const Path& path);

/// Table cells of numbers. One that comes from the evaluation says in its attribute `data-path`
/// where it lies there, as a JSON pointer, so that anybody can check the page against the JSON. A
/// number that is not there is a dash.
class MeasuredCells {
 public:
  explicit MeasuredCells(const Json& evaluation) : evaluation_(evaluation) {}

  /// A share in [0, 1] as per cent, two decimals.
  [[nodiscard]] std::string percent(const Path& path) const;
  /// Milliseconds, two decimals.
  [[nodiscard]] std::string ms(const Path& path) const;
  /// A count, whole.
  [[nodiscard]] std::string count(const Path& path) const;

 private:
  const Json& evaluation_;
};

/// A number the paper prints, as it prints it, but with two decimals.
[[nodiscard]] std::string paper_cell(double value);
[[nodiscard]] std::string empty_cell();

}  // namespace terracut::evaluation::report
