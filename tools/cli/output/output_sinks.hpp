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

/// True if an output is requested that needs every frame with its points, not only labels.
[[nodiscard]] bool wants_sinks(const OutputOptions& options);
/// True if an output takes the sectors of each frame.
[[nodiscard]] bool wants_sectors(const OutputOptions& options);
/// True if an output takes the objects that are complete with each sector.
[[nodiscard]] bool wants_sector_objects(const OutputOptions& options);

/// Opens the requested outputs: creates files, binds ports, and prints both. Returns the first
/// error. `facts` gets its names of coordinate frames from `options`.
[[nodiscard]] Expected<publish::Publisher::Sinks> open_sinks(const OutputOptions& options,
                                                             publish::RunFacts facts);

/// Makes outputs for a run that goes on without those that fail: each is opened on its own thread,
/// and again after a failure, with a message (publish::RetriedSink).
[[nodiscard]] publish::Publisher::Sinks retried_sinks(const OutputOptions& options,
                                                      publish::RunFacts facts);
/// Checks the options of outputs, but no ports or disks. Fails with kInvalidArgument or
/// kUnsupported.
[[nodiscard]] Status check_sinks(const OutputOptions& options);

/// Opens only Foxglove's output. `capture` is the capture that viewers may play; null if they may
/// not. Fails as open_sinks() does.
[[nodiscard]] Expected<std::unique_ptr<publish::FrameSink>> open_foxglove(
    const OutputOptions& options, publish::RunFacts facts, ViewedCapture* capture);

/// Warns that a failed output gets no more frames.
void warn_of_failure(std::string_view sink, const Error& error);

}  // namespace terracut::cli
