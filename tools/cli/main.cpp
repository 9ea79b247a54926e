// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <exception>
#include <new>
#include <variant>

#include "arguments.hpp"
#include "command_files.hpp"
#include "commands.hpp"
#include "console.hpp"

int main(int argc, char** argv) {
  using namespace terracut::cli;
  try {
    const Arguments arguments = parse_arguments(argc, argv);
    if (!arguments.command) return arguments.exit_code;
    const auto claims = claim_outputs(files_of(*arguments.command, arguments.configuration));
    if (!claims) return refuse(claims.error());
    return std::visit([](const auto& options) { return run(options); }, *arguments.command);
  } catch (const std::bad_alloc&) {
    return refuse(kInternal, "out of memory; `terracut plan` prints what is needed");
  } catch (const std::exception& error) {
    return refuse(kInternal, error.what());
  }
}
