// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "tests/pipeline/status/watched_run.hpp"
#include "tests/support/http_client.hpp"
#include "tests/support/places.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tools/cli/export/metrics_server.hpp"
#include "tools/cli/export/metrics_text.hpp"

namespace terracut::cli {
namespace {

using test::get;
using testing::AllOf;
using testing::HasSubstr;

/// Every sample of an exposition: name with labels -> value.
std::map<std::string, double> samples_of(const std::string& text) {
  std::map<std::string, double> samples;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line.front() == '#') continue;
    const std::size_t space = line.rfind(' ');
    samples[line.substr(0, space)] = std::strtod(line.c_str() + space + 1, nullptr);
  }
  return samples;
}

TEST(MetricsText, HoldsEveryCount) {
  status::WatchedRun run;
  auto samples = samples_of(metrics_text(run.figures()));
  EXPECT_EQ(samples["terracut_frames_total{level=\"full\"}"], 98);
  EXPECT_EQ(samples["terracut_frames_total{level=\"skipped\"}"], 1);
  EXPECT_EQ(samples["terracut_deadline_misses_total{cause=\"waiting_for_core\"}"], 1);
  EXPECT_EQ(samples["terracut_losses_total{cause=\"network_gap_packets\"}"], 12);
  EXPECT_EQ(samples["terracut_page_faults_total{thread=\"segment\",kind=\"minor\"}"], 5);
  EXPECT_EQ(samples["terracut_packets_total"], 34'800);
  EXPECT_EQ(samples["terracut_link_state{state=\"receiving\"}"], 1);
  EXPECT_EQ(samples["terracut_link_state{state=\"silent\"}"], 0);
  EXPECT_EQ(samples.count("terracut_motion_samples_total"), 0U) << "none was asked for";
  EXPECT_DOUBLE_EQ(samples["terracut_deadline_seconds"], 0.05);
  EXPECT_DOUBLE_EQ(samples["terracut_start_time_seconds"], 1.7e9);
}

TEST(MetricsText, TellsOfSilencesAndOfAHeadThatStands) {
  status::WatchedRun run;
  run.figures().silences = 3;
  run.figures().silent_ns = 4'500'000'000;
  run.figures().head_stands = true;
  auto samples = samples_of(metrics_text(run.figures()));
  EXPECT_EQ(samples["terracut_silences_total"], 3);
  EXPECT_DOUBLE_EQ(samples["terracut_silent_seconds_total"], 4.5);
  EXPECT_EQ(samples["terracut_head_stands"], 1);
}

TEST(MetricsText, TellsHowWideTheBlindSectorIsAndWhereWhileItIsKnown) {
  status::WatchedRun run;
  auto samples = samples_of(metrics_text(run.figures()));
  EXPECT_EQ(samples.at("terracut_blind_degrees"), 0);
  EXPECT_FALSE(samples.contains("terracut_blind_azimuth_degrees{edge=\"from\"}"));
  run.narrow_view();
  samples = samples_of(metrics_text(run.figures()));
  EXPECT_DOUBLE_EQ(samples.at("terracut_blind_degrees"), 179.78) << "across 0";
  EXPECT_DOUBLE_EQ(samples.at("terracut_blind_azimuth_degrees{edge=\"from\"}"), 270.12);
  EXPECT_DOUBLE_EQ(samples.at("terracut_blind_azimuth_degrees{edge=\"to\"}"), 89.9);
}

TEST(MetricsText, HasHistogramsWhoseBucketsAddUp) {
  status::WatchedRun run;
  auto samples = samples_of(metrics_text(run.figures()));
  EXPECT_EQ(samples["terracut_latency_seconds_bucket{le=\"0.01\"}"], 0);
  EXPECT_EQ(samples["terracut_latency_seconds_bucket{le=\"0.015\"}"], 98);
  EXPECT_EQ(samples["terracut_latency_seconds_bucket{le=\"0.075\"}"], 98);
  EXPECT_EQ(samples["terracut_latency_seconds_bucket{le=\"0.1\"}"], 99);
  EXPECT_EQ(samples["terracut_latency_seconds_bucket{le=\"+Inf\"}"], 99);
  EXPECT_EQ(samples["terracut_latency_seconds_count"], 99);
  EXPECT_NEAR(samples["terracut_latency_seconds_sum"], 98 * 0.011 + 0.081, 1e-9);
  EXPECT_EQ(samples["terracut_stage_cpu_seconds_count{stage=\"min_cut\"}"], 98);
  EXPECT_EQ(samples["terracut_stage_cpu_seconds_bucket{stage=\"min_cut\",le=\"0.003\"}"], 0);
  EXPECT_EQ(samples["terracut_stage_cpu_seconds_bucket{stage=\"min_cut\",le=\"0.0075\"}"], 98);
}

TEST(MetricsText, EscapesWhatWouldEndALabel) {
  status::WatchedRun run;
  run.figures().input = "a\"b\\c\nd";
  EXPECT_THAT(metrics_text(run.figures()), HasSubstr("input=\"a\\\"b\\\\c\\nd\""));
}

/// Whatever in `text` looks like the name of a metric.
std::set<std::string> metrics_named(const std::string& text) {
  const std::regex name("terracut_[a-z_]+");
  return {std::sregex_token_iterator(text.begin(), text.end(), name), {}};
}

TEST(MetricsText, IsWhatTheGuideSays) {
  status::WatchedRun run;
  run.hear_vehicle();
  run.narrow_view();
  run.figures().mount.contradicted = 1;
  run.figures().mount.found_in_frames = 10;
  run.figures().sight.is_watched = 1;
  run.figures().sight.sectors[0].has_view = 1;
  run.figures().last_return_to_object.record(1);
  std::set<std::string> emitted;
  std::istringstream lines(metrics_text(run.figures()));
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("# TYPE ")) emitted.merge(metrics_named(line));
  }
  EXPECT_EQ(metrics_named(test::content_of(test::source_folder() / "docs/guide/monitoring.md")),
            emitted);
}

TEST(MetricsText, PassesPromtoolsCheck) {
  if (std::system("command -v promtool >/dev/null 2>&1") != 0) {
    GTEST_SKIP() << "promtool is not installed (Debian package prometheus)";
  }
  status::WatchedRun run;
  const test::ScratchFolder folder;
  const auto check = [&](const std::string& text) {
    std::ofstream(folder / "metrics.txt") << text;
    const std::string command = "promtool check metrics <'" + (folder / "metrics.txt").string() +
                                "' >'" + (folder / "said.txt").string() + "' 2>&1";
    const int status = std::system(command.c_str());
    return status == 0 ? "" : test::content_of(folder / "said.txt") + "refused";
  };
  EXPECT_EQ(check(metrics_text(run.figures())), "");
  run.hear_vehicle();
  EXPECT_EQ(check(metrics_text(run.figures())), "");
  EXPECT_EQ(check(metrics_text(*std::make_unique<status::MonitorSnapshot>())), "");
  EXPECT_NE(check("terracut_frames_total{level=full} 1\n"), "") << "promtool checks nothing";
}

class MetricsServerOf : public testing::Test {
 protected:
  [[nodiscard]] Expected<HttpServer> start(std::uint16_t port = 0) {
    return serve_metrics({INADDR_LOOPBACK, port},
                         [this](status::MonitorSnapshot& into) { into = run_.figures(); });
  }
  status::WatchedRun run_;
};

TEST_F(MetricsServerOf, AnswersWithTheFigures) {
  const auto server = start();
  ASSERT_TRUE(server) << server.error().message;
  for (int scrape = 0; scrape < 3; ++scrape) {
    const auto answer = get(server->port(), "/metrics");
    EXPECT_EQ(answer.status, 200);
    EXPECT_THAT(answer.head, HasSubstr("text/plain; version=0.0.4"));
    EXPECT_EQ(answer.body, metrics_text(run_.figures()));
  }
}

TEST_F(MetricsServerOf, SaysWhatThereIsAndWhatIsNot) {
  const auto server = start();
  ASSERT_TRUE(server);
  EXPECT_THAT(get(server->port(), "/").body, HasSubstr("/metrics"));
  EXPECT_EQ(get(server->port(), "/nothing").status, 404);
  EXPECT_EQ(get(server->port(), "/metrics?collect=all").status, 200);
  EXPECT_EQ(test::ask(server->port(), "POST", "/metrics").status, 405);
}

TEST_F(MetricsServerOf, TellsNothingToAWebPageWhoseNameWasMadeToLeadHere) {
  const auto server = start();
  ASSERT_TRUE(server);
  for (const char* path : {"/metrics", "/"}) {
    const auto refused = get(server->port(), path, "Host: rebound.example:9464\r\n");
    EXPECT_EQ(refused.status, 403) << path;
    EXPECT_THAT(refused.body, testing::Not(HasSubstr("terracut_"))) << path;
    EXPECT_EQ(get(server->port(), path, "Host: 127.0.0.1:9464\r\n").status, 200) << path;
    EXPECT_EQ(get(server->port(), path, "Sec-Fetch-Site: cross-site\r\n").status, 403) << path;
  }
}

TEST_F(MetricsServerOf, RefusesAPortInUse) {
  const auto first = start();
  ASSERT_TRUE(first);
  const auto second = start(first->port());
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, ErrorCode::kInvalidArgument);
  EXPECT_THAT(second.error().message,
              AllOf(HasSubstr("127.0.0.1:" + std::to_string(first->port())), HasSubstr("in use")));
}

TEST_F(MetricsServerOf, RefusesAnAddressThatIsNotOfThisMachine) {
  const auto server = serve_metrics({0xC0'00'02'01, 0}, [](status::MonitorSnapshot&) {});
  ASSERT_FALSE(server);
  EXPECT_THAT(server.error().message, HasSubstr("192.0.2.1"));
}

TEST_F(MetricsServerOf, ServesOthersAfterAClientThatSendsNonsenseOrNothing) {
  const auto server = start();
  ASSERT_TRUE(server);
  {
    test::HttpClient silent(server->port()), nonsense(server->port());
    ASSERT_TRUE(silent.is_connected() && nonsense.is_connected());
    nonsense.send("\x01\x02 nonsense\r\n\r\n");
    EXPECT_EQ(get(server->port(), "/metrics").status, 200);
  }
  test::HttpClient gone(server->port());
  gone.send("GET /metr");
  EXPECT_EQ(get(server->port(), "/metrics").status, 200);
}

}  // namespace
}  // namespace terracut::cli
