// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Replaces the DDS parts in a program built without DDS.
#include "tools/cli/commands.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/output/dds_output.hpp"

namespace terracut::cli {
namespace {

Error dds_absence() {
  return {
      ErrorCode::kUnsupported,
      "this terracut was built without DDS; install Cyclone DDS (apt-get install cyclonedds-dev "
      "cyclonedds-tools, or ./tools/setup --dds), configure anew and build again"};
}

}  // namespace

Status check_dds() {
  return tl::unexpected(dds_absence());
}

ExitCode run_node(const Options& /*options*/) {
  return refuse(dds_absence());
}

Expected<std::unique_ptr<publish::FrameSink>> open_dds_sink(const DdsOptions& /*options*/,
                                                            const publish::RunFacts& /*facts*/) {
  return tl::unexpected(dds_absence());
}

}  // namespace terracut::cli
