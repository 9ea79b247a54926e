// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>

#include "cloud_labelling.hpp"
#include "frame_arrays.hpp"
#include "ground_cells.hpp"
#include "live_frames.hpp"
#include "pipeline/ground/parameter_table.hpp"
#include "pipeline/ground/profile.hpp"
#include "replayed_frames.hpp"

namespace py = pybind11;

namespace terracut::python {
namespace {

/// Returns the rows of `terracut parameters`, with the defaults of the terracut profile.
py::list parameters() {
  const ground::SegmenterConfig defaults = ground::terracut_profile();
  py::list all;
  for (const ground::Parameter& parameter : ground::parameters()) {
    py::dict entry;
    entry["key"] = std::string(parameter.key);
    entry["unit"] = std::string(parameter.unit);
    entry["help"] = std::string(parameter.help);
    entry["default"] = parameter.text(defaults);
    if (parameter.choices.empty()) {
      entry["range"] = py::make_tuple(parameter.least, parameter.most);
    } else {
      py::list choices;
      for (const std::string_view choice : parameter.choices) choices.append(std::string(choice));
      entry["choices"] = choices;
    }
    all.append(entry);
  }
  return all;
}

}  // namespace
}  // namespace terracut::python

PYBIND11_MODULE(_terracut, module) {
  using namespace terracut::python;
  module.doc() = "What is compiled of terracut's Python module; use `import terracut`.";
  module.attr("__version__") = TERRACUT_VERSION;
  module.def("parameters", &parameters);
  bind_frame(module);
  bind_replay(module);
  bind_live(module);
  bind_segmenter(module);
  bind_ground_grid(module);
}
