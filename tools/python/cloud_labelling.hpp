// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <pybind11/numpy.h>

#include <mutex>

#include "pipeline/terracut/segmenter.hpp"

namespace terracut::python {

/// A Segmenter for numpy arrays. Any thread of the interpreter, one at a time.
class CloudLabelling {
 public:
  explicit CloudLabelling(const Segmenter::Config& config);

  /// `points` are (N, 3 or more) or, organised, (rows, columns, 3 or more) of float32 or float64, x
  /// y z first; or an array of records with fields x, y, z and optionally ring. `laser` is None, or
  /// a number 0..255 per point. Returns one label per point, a class of SemanticKITTI, and with
  /// Segmenter::Config::heights one height per point, else None, in arrays of their own.
  [[nodiscard]] pybind11::tuple label(const pybind11::object& points,
                                      const pybind11::object& laser);
  /// Returns the objects of the points labelled last; None unless asked for.
  [[nodiscard]] pybind11::object objects();
  /// Returns the number of the object of each of these points; None unless asked for.
  [[nodiscard]] pybind11::object object_numbers();
  /// Returns the free way of these points; None unless asked for.
  [[nodiscard]] pybind11::object free_way();
  /// Returns height_m, roll_deg, pitch_deg, their uncertainty and found_in_frames; None if no mount
  /// was looked for or found.
  [[nodiscard]] pybind11::object found_mount();

 private:
  bool gives_heights_, gives_objects_, gives_free_way_;
  std::mutex mutex_;
  Segmenter segmenter_;
};

void bind_segmenter(pybind11::module_& module);

}  // namespace terracut::python
