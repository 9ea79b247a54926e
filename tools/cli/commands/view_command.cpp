// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors

#include <memory>

#include "pipeline/publish/labelled_frame.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/input/cloud_input.hpp"
#include "tools/cli/input/labelled_capture.hpp"
#include "tools/cli/input/mount_choice.hpp"
#include "tools/cli/output/output_sinks.hpp"
#include "tools/cli/stop_signal.hpp"
#include "tools/cli/view/capture_player.hpp"
#include "tools/cli/view/played_capture.hpp"
#include "tools/cli/view/played_clouds.hpp"
#include "tools/cli/view/view_sink.hpp"

namespace terracut::cli {

namespace {

ExitCode show(PlayedRecording& recording, const publish::RunFacts& stream, const Options& options) {
  CapturePlayer player(recording);
  auto page = ViewSink::open(options.view_at, stream, &player);
  if (!page) return refuse(page.error());
  say("look at it in a browser: " + (*page)->url() + " (Ctrl-C ends it)");
  std::unique_ptr<publish::FrameSink> foxglove;
  if (!options.output.foxglove.empty()) {
    auto opened = open_foxglove(options.output, stream, &player);
    if (!opened) return refuse(opened.error());
    foxglove = *std::move(opened);
  }
  return done_or_refused(player.run([&](const publish::LabelledFrame& frame) -> Status {
    if (foxglove != nullptr) (void)foxglove->put(frame);  // cannot fail
    return (*page)->put(frame);
  }));
}

}  // namespace

ExitCode run_view(const Options& as_said) {
  Options options = as_said;
  options.mount = guessing(options.mount);
  options.method.heights = options.method.heights || options.method.method.empty();
  catch_stop_signals();
  const auto is_clouds = holds_clouds(options.capture);
  if (!is_clouds) return refuse(is_clouds.error());
  if (*is_clouds) {
    if (options.capture.start_s > 0 || options.capture.duration_s) {
      return refuse(kUsage, "--start and --duration are of captures; name the clouds to be seen");
    }
    auto clouds = PlayedClouds::open(options.capture.file, options);
    if (!clouds) return refuse_work(clouds.error());
    return show(**clouds,
                {.sensor = (*clouds)->sensor_line(),
                 .rows = (*clouds)->rows(),
                 .mount = (*clouds)->sensor_mount(),
                 .found = options.method.scene},
                options);
  }
  auto capture = LabelledCapture::open(options, LabelledCapture::Makes::kPoints);
  if (!capture) return refuse_work(capture.error());
  say_what_is_read((*capture)->capture());
  PlayedCapture played(**capture, options);
  return show(played,
              {.sensor = (*capture)->capture().sensor_line,
               .rows = (*capture)->decoder().shape().rows,
               .mount = (*capture)->sensor_mount(),
               .found = options.method.scene},
              options);
}

}  // namespace terracut::cli
