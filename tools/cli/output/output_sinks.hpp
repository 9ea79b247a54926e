// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <memory>

#include "pipeline/publish/frame_sink.hpp"
#include "pipeline/publish/publisher.hpp"
#include "pipeline/publish/run_facts.hpp"
#include "rt/error.hpp"
#include "tools/cli/options.hpp"
#include "tools/cli/view/viewed_capture.hpp"

namespace terracut::cli {

/// Whether an output is asked for that gets every frame with its points, labels alone are not
/// enough for.
[[nodiscard]] bool wants_sinks(const OutputOptions& options);

/// These outputs, open: files created, ports bound, which is said. The first one's error where one
/// cannot be. `facts` gets its names of coordinate frames from `options`.
[[nodiscard]] Expected<publish::Publisher::Sinks> open_sinks(const OutputOptions& options,
                                                             publish::RunFacts facts);

/// The same for a run that goes on without them: each is opened on its own thread, and again where
/// that fails, which is said (publish::RetriedSink).
[[nodiscard]] publish::Publisher::Sinks retried_sinks(const OutputOptions& options,
                                                      publish::RunFacts facts);
/// What is wrong with them whatever becomes of ports and disks: kInvalidArgument, kUnsupported.
[[nodiscard]] Status check_sinks(const OutputOptions& options);

/// Foxglove's alone, of a capture that its viewers may play (null: nobody plays); the same errors.
[[nodiscard]] Expected<std::unique_ptr<publish::FrameSink>> open_foxglove(
    const OutputOptions& options, publish::RunFacts facts, ViewedCapture* capture);

/// Warns that an output gets nothing more.
void warn_of_failure(std::string_view sink, const Error& error);

}  // namespace terracut::cli
