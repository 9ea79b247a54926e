// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "output_sinks.hpp"

#include <fmt/format.h>

#include "tools/cli/console.hpp"

namespace terracut::cli {

bool wants_sinks(const OutputOptions& /*options*/) {
  return false;
}

Expected<publish::Publisher::Sinks> open_sinks(const OutputOptions& /*options*/,
                                               const publish::Stream& /*stream*/) {
  return publish::Publisher::Sinks{};
}

void warn_of_failure(std::string_view sink, const Error& error) {
  warn(fmt::format("no more frames for {}: {}", sink, error.message));
}

}  // namespace terracut::cli
