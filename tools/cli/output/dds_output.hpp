// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <memory>
#include <string>

#include "pipeline/publish/frame_sink.hpp"
#include "pipeline/publish/run_facts.hpp"
#include "rt/error.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// Names of the topics, as stated or by the preset; a topic with an empty name is not published.
struct DdsTopics {
  std::string points{}, sectors{}, ground{}, obstacles{}, road{}, diagnostics{}, raw{}, objects{},
      free_way{};
};
[[nodiscard]] DdsTopics dds_topics_of(const DdsOptions& options);

/// Fails with kUnsupported if the program was built without DDS; the message says what to install.
[[nodiscard]] Status check_dds();
/// Opens the output of --dds and prints its topics. Fails with the errors of check_dds() and of
/// dds::DdsSink::open().
[[nodiscard]] Expected<std::unique_ptr<publish::FrameSink>> open_dds_sink(
    const DdsOptions& options, const publish::RunFacts& facts);

}  // namespace terracut::cli
