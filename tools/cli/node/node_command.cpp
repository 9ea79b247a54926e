// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <fmt/format.h>

#include <chrono>
#include <optional>
#include <thread>
#include <utility>

#include "cloud_node.hpp"
#include "node_watch.hpp"
#include "pipeline/dds/diagnostics_writer.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/figures/dashboard.hpp"
#include "tools/cli/figures/figures_json.hpp"
#include "tools/cli/input/input_check.hpp"
#include "tools/cli/json_text.hpp"
#include "tools/cli/output/dds_output.hpp"
#include "tools/cli/output/dds_participant.hpp"
#include "tools/cli/stop_signal.hpp"

namespace terracut::cli {

ExitCode run_node(const Options& options) {
  if (const Status ready = check_inputs(options); !ready) return refuse(ready.error());
  catch_stop_signals();
  write_in_background();
  const DdsOptions& topics = options.output.dds;
  const auto participant = dds::Participant::open(participant_config_of(topics));
  if (!participant) return refuse(participant.error());
  auto reader =
      dds::CloudReader::open(*participant, dds_topic_of(topics.in, topics), topics.in_reliable);
  if (!reader) return refuse(reader.error());
  auto transforms = dds::TransformReader::open(*participant, dds_topic_of("/tf_static", topics));
  if (!transforms) return refuse(transforms.error());
  auto answers = NodeAnswers::open(*participant, options);
  if (!answers) return refuse(answers.error());
  auto diagnostics =
      open_writer(*participant, dds_topics_of(topics).diagnostics, dds::kDiagnosticArray, topics);
  if (!diagnostics) return refuse(diagnostics.error());
  say(fmt::format("node {} on DDS domain {}: clouds of {} are answered on {}", topics.node,
                  participant->domain(), topics.in, topic_list(topics)));

  NodeNews news;
  NodeWatch watch(options, fmt::format("{} (DDS domain {})", topics.in, participant->domain()),
                  news);
  {
    const CloudNode node(options, *std::move(reader), *std::move(transforms), *std::move(answers),
                         news);
    const auto started = std::chrono::steady_clock::now();
    const auto is_over = [&] {
      return options.capture.duration_s &&
             std::chrono::steady_clock::now() - started >
                 std::chrono::duration<double>(*options.capture.duration_s);
    };
    constexpr int kRoundsASecond = 20;
    std::optional<dds::DiagnosticsWriter> health;
    if (*diagnostics) health.emplace(std::move(**diagnostics));
    for (int round = 1; !stop_wanted() && !is_over(); ++round) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1000 / kRoundsASecond));
      watch.work_round(node.lost_clouds());
      if (!health || round % kRoundsASecond != 0) continue;
      if (const Status told = health->write(watch.figures()); !told) warn(told.error().message);
    }
    if (options.capture.duration_s && !is_over()) watch.note_interruption();
  }
  watch.last_round();

  const status::MonitorSnapshot& figures = watch.figures();
  print_text(closing_lines(figures));
  if (const Status written = write_json(options.output.json, live_summary(figures)); !written) {
    return refuse(written.error());
  }
  if (figures.interrupted != 0) return kInterrupted;
  if (figures.frames == 0) return refuse(kNothingCameOut, watch.why_no_frames());
  return figures.all_misses() > 0 ? kDeadlinesMissed : kOk;
}

}  // namespace terracut::cli
