// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "raised_error.hpp"

#include <string>

namespace terracut::python {
namespace py = pybind11;

void raise(const Error& error) {
  const py::object made = py::module_::import("terracut.errors")
                              .attr("of")(std::string(to_string(error.code)), error.message);
  PyErr_SetObject(py::type::handle_of(made).ptr(), made.ptr());
  throw py::error_already_set();
}

void tell(const cli::HeardLines& lines) {
  if (PyErr_Occurred() != nullptr) throw py::error_already_set();
  if (lines.said.empty() && lines.warned.empty()) return;
  const py::module_ errors = py::module_::import("terracut.errors");
  for (const std::string& line : lines.said) errors.attr("say")(line);
  for (const std::string& line : lines.warned) errors.attr("warn")(line);
}

}  // namespace terracut::python
