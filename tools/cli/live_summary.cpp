// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "live_summary.hpp"

#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "blind_text.hpp"
#include "json_text.hpp"
#include "mount_text.hpp"
#include "rt/whole_file.hpp"

namespace terracut::cli {
namespace {

using Json = nlohmann::ordered_json;

/// Milliseconds to the microsecond: more digits would only be noise.
double milliseconds(double ns) {
  return static_cast<double>(static_cast<std::int64_t>(ns / 1000)) / 1000.0;
}

double milliseconds(std::int64_t ns) {
  return static_cast<double>(ns / 1000) / 1000.0;
}

Json times_json(const rt::LogLinearHistogram& histogram) {
  return {{"count", histogram.count()},
          {"mean", milliseconds(histogram.mean_ns())},
          {"p50", milliseconds(histogram.percentile_ns(50))},
          {"p90", milliseconds(histogram.percentile_ns(90))},
          {"p99", milliseconds(histogram.percentile_ns(99))},
          {"p99.9", milliseconds(histogram.percentile_ns(99.9))},
          {"max", milliseconds(histogram.max_ns())}};
}

Json frames_json(const rt::MonitorSnapshot& figures) {
  Json json{{"count", figures.frames},
            {"per_second", figures.frames_per_s},
            {"returns", figures.returns},
            {"unjudged", figures.unjudged}};
  for (std::size_t i = 0; i < rt::kRungs; ++i) {
    json["rungs"][std::string(to_string(static_cast<rt::Rung>(i)))] = figures.rungs[i];
  }
  return json;
}

Json misses_json(const rt::MonitorSnapshot& figures) {
  Json json{{"total", figures.all_misses()},
            {"consecutive", figures.consecutive_misses},
            {"longest_run", figures.longest_run_of_misses}};
  for (std::size_t i = 0; i < rt::kMissCauses; ++i) {
    json["causes"][std::string(to_string(static_cast<rt::FrameMissCause>(i)))] = figures.misses[i];
  }
  return json;
}

Json counts_json(std::span<const rt::NamedCount> counts) {
  Json json = Json::object();
  for (const rt::NamedCount& counted : counts) {
    json[std::string(counted.name.view())] = counted.count;
  }
  return json;
}

/// Where it is asked for.
Json motion_json(const rt::MotionFigures& motion) {
  Json json{{"bus", motion.bus.view()},
            {"state", to_string(motion.state)},
            {"samples", motion.samples},
            {"spare_samples", motion.spare_samples},
            {"last_sample_ns", motion.last_sample_ns},
            {"taken_out_frames", motion.taken_out},
            {"no_ego_motion_frames", motion.no_ego_motion},
            {"newest_sample_after_turn_ms",
             {{"newest", milliseconds(motion.newest_sample_after_turn_ns)},
              {"min", milliseconds(motion.least_sample_after_turn_ns)},
              {"mean", milliseconds(motion.mean_sample_after_turn_ns())},
              {"max", milliseconds(motion.most_sample_after_turn_ns)}}}};
  json["faults"] = counts_json(motion.faults_in_use());
  return json;
}

Json health_json(const rt::HealthFigures& health) {
  return {{"bus", health.bus.view()},
          {"sent", health.sent},
          {"queue_full", health.queue_full},
          {"link_down", health.link_down},
          {"failed", health.failed}};
}

Json threads_json(const rt::MonitorSnapshot& figures) {
  Json json = Json::array();
  for (const rt::ThreadStatus& thread : figures.threads_in_use()) {
    json.push_back({{"name", thread.name.view()},
                    {"scheduling", thread.scheduling.view()},
                    {"minor_faults", thread.minor_faults},
                    {"major_faults", thread.major_faults}});
  }
  return json;
}

Json all_times_json(const rt::MonitorSnapshot& figures) {
  Json json{{"latency", times_json(figures.latency)},
            {"wall", times_json(figures.wall)},
            {"cpu_total", times_json(figures.total_cpu)},
            {"cpu_decode", times_json(figures.decode_cpu)},
            {"cpu_segment", times_json(figures.segment_cpu)}};
  Json& stages = json["stages"] = Json::object();
  for (std::size_t i = 0; i < figures.stages(); ++i) {
    stages[std::string(figures.stage_names[i].view())] = times_json(figures.stage_cpu[i]);
  }
  return json;
}

}  // namespace

Json live_summary(const rt::MonitorSnapshot& figures) {
  Json json;
  json["terracut"] = figures.version.view();
  json["sensor"] = figures.sensor.view();
  json["input"] = figures.input.view();
  json["started_ns"] = figures.started_ns;
  json["taken_ns"] = figures.taken_ns;
  json["deadline_ms"] = milliseconds(figures.deadline_ns);
  json["link"] = {{"state", to_string(figures.link)},
                  {"packets", figures.packets},
                  {"last_packet_ns", figures.last_packet_ns},
                  {"head_stands", figures.head_stands},
                  {"silences", figures.silences},
                  {"silent_ms", milliseconds(figures.silent_ns)}};
  json["blind"] = blind_json(blind_of(figures));
  json["datagrams"] = {{"received", figures.received},
                       {"in_doubt", figures.in_doubt},
                       {"outcomes", counts_json(figures.outcomes_in_use())}};
  json["frames"] = frames_json(figures);
  json["misses"] = misses_json(figures);
  json["losses"] = counts_json(figures.losses_in_use());
  json["mount"] = mount_json(figures.mount);
  if (!figures.motion.bus.empty()) json["motion"] = motion_json(figures.motion);
  if (!figures.health.bus.empty()) json["health"] = health_json(figures.health);
  json["threads"] = threads_json(figures);
  json["ms"] = all_times_json(figures);
  return json;
}

Status write_live_summary(const std::filesystem::path& path, const rt::MonitorSnapshot& figures) {
  return rt::write_whole_file(path, json_text(live_summary(figures)));
}

}  // namespace terracut::cli
