// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <fmt/format.h>

#include <memory>

#include "pipeline/publish/labelled_frame.hpp"
#include "pipeline/stream/labelled_points.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/export/output_sinks.hpp"
#include "tools/cli/input/labelled_capture.hpp"
#include "tools/cli/stop_signal.hpp"
#include "tools/cli/view/capture_player.hpp"
#include "tools/cli/view/view_sink.hpp"

namespace terracut::cli {

ExitCode run_view(const Options& options) {
  auto capture = LabelledCapture::open(options, FramesAreFor::kPoints);
  if (!capture) return refuse_work(capture.error());
  catch_stop_signals();
  CapturePlayer player(**capture, options.capture);
  const publish::Stream stream{.sensor = (*capture)->capture().sensor_line,
                               .rows = (*capture)->decoder().shape().rows,
                               .mount = (*capture)->sensor_mount()};
  auto page = ViewSink::open(options.view_at, stream, &player);
  if (!page) return refuse(page.error());
  say("look at it in a browser: " + (*page)->url() + " (Ctrl-C ends it)");
  std::unique_ptr<publish::FrameSink> foxglove;
  if (!options.output.foxglove.empty()) {
    auto opened = open_foxglove(options.output, stream, &player);
    if (!opened) return refuse(opened.error());
    foxglove = *std::move(opened);
  }

  publish::LabelledFrame labelled;
  const Status played =
      player.run([&](const run::Frame& frame, std::span<const frame::Label> labels) -> Status {
        labelled.record = frame.record;
        labelled.points.resize(frame.image->returns());
        (void)stream::pack_labelled_points(*frame.image, labels, labelled.points,
                                           (*capture)->timing(frame));
        if (foxglove != nullptr) (void)foxglove->put(labelled);  // nothing of it can fail
        return (*page)->put(labelled);
      });
  return done_or_refused(played);
}

}  // namespace terracut::cli
