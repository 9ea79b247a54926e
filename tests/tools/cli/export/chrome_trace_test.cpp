// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/export/chrome_trace.hpp"

#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/pipeline/status/watched_run.hpp"

namespace terracut::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kReceive = 1, kSegment = 2;

std::vector<Json> events_of(const Json& trace, const std::string& phase, int track) {
  std::vector<Json> events;
  for (const Json& event : trace["traceEvents"]) {
    if (event["ph"] == phase && event["tid"] == track) events.push_back(event);
  }
  return events;
}

Json event_named(const std::vector<Json>& events, const std::string& name) {
  for (const Json& event : events) {
    if (event["name"] == name) return event;
  }
  return {};
}

double end_of(const Json& slice) {
  return slice["ts"].get<double>() + slice["dur"].get<double>();
}

TEST(ChromeTrace, NamesItsTracks) {
  status::WatchedRun run;
  const Json trace = chrome_trace(run.figures(), run.frames());
  std::map<int, std::string> names;
  for (const Json& event : trace["traceEvents"]) {
    if (event["name"] == "thread_name") names[event["tid"]] = event["args"]["name"];
  }
  EXPECT_EQ(names, (std::map<int, std::string>{{kReceive, "receive"}, {kSegment, "segment"}}));
  EXPECT_EQ(trace["otherData"]["origin_ns"], status::WatchedRun::kStart_ns);
}

TEST(ChromeTrace, ShowsAFrameOnEveryTrackWhereItWas) {
  status::WatchedRun run;
  const Json trace = chrome_trace(run.figures(), run.frames());
  const Json received = event_named(events_of(trace, "X", kReceive), "frame 7");
  EXPECT_DOUBLE_EQ(end_of(received), 806'000.0);
  EXPECT_EQ(received["args"]["returns"], 100'000);
  const Json frame = event_named(events_of(trace, "X", kSegment), "frame 7");
  EXPECT_DOUBLE_EQ(frame["ts"], 806'000.0);
  EXPECT_DOUBLE_EQ(frame["dur"], 10'000.0);
  EXPECT_EQ(frame["args"]["level"], "full");
  EXPECT_DOUBLE_EQ(frame["args"]["latency_ms"], 11.0);
  EXPECT_EQ(frame["args"]["cut_operations"], 1000);
}

TEST(ChromeTrace, SaysWhatEachStageOfAFrameCost) {
  status::WatchedRun run;
  const Json trace = chrome_trace(run.figures(), run.frames());
  const Json stages =
      event_named(events_of(trace, "X", kSegment), "frame 7")["args"]["stages_cpu_ms"];
  const auto frame = run.frames()[7];
  ASSERT_EQ(stages.size(), run.figures().stages());
  std::size_t i = 0;
  for (const auto& [name, ms] : stages.items()) {
    EXPECT_EQ(name, run.figures().stage_names[i].view());
    EXPECT_DOUBLE_EQ(ms, static_cast<double>(frame.stages.stage_ns[i++]) / 1e6);
  }
}

TEST(ChromeTrace, NeverLetsTheSlicesOfATrackOverlap) {
  status::WatchedRun run;
  const Json trace = chrome_trace(run.figures(), run.frames());
  const auto frames = events_of(trace, "X", kReceive);
  ASSERT_EQ(frames.size(), status::WatchedRun::kFrames);
  for (std::size_t i = 1; i < frames.size(); ++i) {
    EXPECT_GE(frames[i]["ts"].get<double>(), end_of(frames[i - 1]));
  }
}

TEST(ChromeTrace, MarksEveryMissedDeadlineWithItsCause) {
  status::WatchedRun run;
  const Json trace = chrome_trace(run.figures(), run.frames());
  const auto misses = events_of(trace, "i", kSegment);
  ASSERT_EQ(misses.size(), 2U);
  EXPECT_EQ(misses[0]["name"], "missed: waiting_for_core");
  EXPECT_EQ(misses[0]["args"]["frame"], 40);
  EXPECT_DOUBLE_EQ(misses[0]["ts"], 4'155'000.0);  // 50 ms after its last packet
  EXPECT_EQ(misses[1]["args"]["level"], "skipped");
  EXPECT_DOUBLE_EQ(misses[1]["ts"], 4'206'000.0);  // given up before its deadline
  EXPECT_TRUE(event_named(events_of(trace, "X", kSegment), "frame 41").is_null());
}

TEST(ChromeTrace, LeavesOutWhatIsNotKnown) {
  status::WatchedRun run;
  const std::vector<status::FrameRecord> nothing_known(1);
  const Json trace = chrome_trace(run.figures(), nothing_known);
  for (const Json& event : trace["traceEvents"]) EXPECT_EQ(event["ph"], "M");
  EXPECT_TRUE(chrome_trace(run.figures(), {})["traceEvents"].is_array());
}

}  // namespace
}  // namespace terracut::cli
