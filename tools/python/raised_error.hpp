// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <pybind11/pybind11.h>

#include <utility>

#include "rt/error.hpp"
#include "tools/cli/console.hpp"

/// Passes errors and messages of C++ to Python.
namespace terracut::python {

/// Raises the exception of terracut/errors.py that belongs to the error.
[[noreturn]] void raise(const Error& error);

template <class T>
[[nodiscard]] T or_raise(Expected<T> expected) {
  if (!expected) raise(expected.error());
  return *std::move(expected);
}

/// Raises warnings as Python's, and logs other lines to the logger "terracut". Throws a pending
/// exception: that of a signal, or of a warning that Python was told to raise.
void tell(const cli::HeardLines& lines);

/// Runs `work` without the interpreter's lock, so that other threads can run.
template <class Work>
auto without_the_lock(Work&& work) {
  cli::HeardLines lines;
  auto result = [&] {
    const pybind11::gil_scoped_release released;
    return work();
  }();
  tell(lines);
  return result;
}

}  // namespace terracut::python
