// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "pipeline/publish/labelled_frame.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/input/cloud_input.hpp"
#include "tools/cli/input/frame_truth.hpp"
#include "tools/cli/input/labelled_capture.hpp"
#include "tools/cli/input/mount_choice.hpp"
#include "tools/cli/output/output_sinks.hpp"
#include "tools/cli/settings/configuration_file.hpp"
#include "tools/cli/settings/words.hpp"
#include "tools/cli/stop_signal.hpp"
#include "tools/cli/view/capture_player.hpp"
#include "tools/cli/view/played_capture.hpp"
#include "tools/cli/view/played_clouds.hpp"
#include "tools/cli/view/view_sink.hpp"

namespace terracut::cli {

namespace {

/// Returns a name for the parameters of a method: "paper, seeds.rows=3".
std::string name_of(const MethodOptions& method) {
  constexpr std::size_t kFew = 2;
  std::string name = method.method;
  if (name.empty()) name = word_of(kProfileWords, method.profile);
  if (method.settings.size() > kFew) {
    return fmt::format("{}, {} parameters", name, method.settings.size());
  }
  for (const std::string& setting : method.settings) name += ", " + setting;
  return name;
}

/// Returns the method of the configuration that --beside names; nothing without one.
Expected<std::optional<MethodOptions>> method_beside(const Options& options) {
  if (options.beside.empty()) return std::nullopt;
  auto read = read_configuration(options.beside);
  if (!read) return tl::unexpected(read.error());
  read->method.heights = false;
  read->method.scene = {};
  return std::move(read->method);
}

ExitCode show(PlayedRecording& recording, const publish::RunFacts& stream, bool has_truth,
              const Options& options) {
  CapturePlayer player(recording);
  auto page = ViewSink::open(options.view_at, stream, &player, {},
                             {.truth = has_truth,
                              .name = name_of(options.method),
                              .beside = options.beside.filename().string()});
  if (!page) return refuse(page.error());
  say("look at it in a browser: " + (*page)->url() + " (Ctrl-C ends it)");
  std::unique_ptr<publish::FrameSink> foxglove;
  if (!options.output.foxglove.empty()) {
    auto opened = open_foxglove(options.output, stream, &player);
    if (!opened) return refuse(opened.error());
    foxglove = *std::move(opened);
  }
  return done_or_refused(player.run([&](const PlayedFrame& frame) -> Status {
    if (foxglove != nullptr) (void)foxglove->put(frame);  // cannot fail
    (*page)->put_compared(frame, frame.comparison);
    return {};
  }));
}

}  // namespace

ExitCode run_view(const Options& as_said) {
  Options options = as_said;
  options.mount = guessing(options.mount);
  options.method.heights = options.method.heights || options.method.method.empty();
  catch_stop_signals();
  auto truth = FrameTruth::open(options.output.truth);
  if (!truth) return refuse(truth.error());
  const auto beside = method_beside(options);
  if (!beside) return refuse(beside.error());
  const auto is_clouds = holds_clouds(options.capture);
  if (!is_clouds) return refuse(is_clouds.error());
  if (*is_clouds) {
    if (options.capture.start_s > 0 || options.capture.duration_s) {
      return refuse(kUsage, "--start and --duration are of captures; name the clouds to be seen");
    }
    auto clouds = PlayedClouds::open(options.capture.file, options, *std::move(truth),
                                     *beside ? &**beside : nullptr);
    if (!clouds) return refuse_work(clouds.error());
    return show(**clouds,
                {.sensor = (*clouds)->sensor_line(),
                 .rows = (*clouds)->rows(),
                 .mount = (*clouds)->sensor_mount(),
                 .found = options.method.scene},
                (*clouds)->has_truth(), options);
  }
  auto capture = LabelledCapture::open(options, LabelledCapture::Makes::kPoints);
  if (!capture) return refuse_work(capture.error());
  say_what_is_read((*capture)->capture());
  std::unique_ptr<CaptureLabels> labels_beside;
  if (*beside) {
    auto opened = CaptureLabels::open(**capture, options, **beside);
    if (!opened) return refuse_work(opened.error());
    labels_beside = *std::move(opened);
  }
  const bool has_truth = truth->exists();
  PlayedCapture played(**capture, options, *std::move(truth), std::move(labels_beside));
  return show(played,
              {.sensor = (*capture)->capture().sensor_line,
               .rows = (*capture)->decoder().shape().rows,
               .mount = (*capture)->sensor_mount(),
               .found = options.method.scene},
              has_truth, options);
}

}  // namespace terracut::cli
