// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <fmt/format.h>

#include "pipeline/publish/labelled_frame.hpp"
#include "pipeline/stream/labelled_points.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/console.hpp"
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
  auto sink = ViewSink::open(options.view_at,
                             {.sensor = (*capture)->capture().sensor_line,
                              .rows = (*capture)->decoder().shape().rows,
                              .mount = (*capture)->sensor_mount()},
                             &player);
  if (!sink) return refuse(sink.error());
  say("look at it in a browser: " + (*sink)->url() + " (Ctrl-C ends it)");

  publish::LabelledFrame labelled;
  const Status played =
      player.run([&](const run::Frame& frame, std::span<const frame::Label> labels) -> Status {
        labelled.record = frame.record;
        labelled.points.resize(frame.image->returns());
        (void)stream::pack_labelled_points(*frame.image, labels, labelled.points,
                                           (*capture)->timing(frame));
        return (*sink)->put(labelled);
      });
  return done_or_refused(played);
}

}  // namespace terracut::cli
