// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <pybind11/pybind11.h>

#include <nlohmann/json.hpp>

#include "tools/cli/json_text.hpp"

namespace terracut::python {

/// Converts JSON to Python's dictionaries and lists, as Python's own parser would.
[[nodiscard]] inline pybind11::object json_object(const nlohmann::ordered_json& json) {
  return pybind11::module_::import("json").attr("loads")(cli::json_text(json));
}

}  // namespace terracut::python
