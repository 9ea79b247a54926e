// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/view/view_sink.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "page_fixture.hpp"
#include "pipeline/status/loss_causes.hpp"
#include "rt/measure/thread_cpu_clock.hpp"
#include "tests/support/http_client.hpp"
#include "tools/cli/view/view_page.hpp"

namespace terracut::cli {
namespace {

using nlohmann::json;
using testing::HasSubstr;

constexpr std::chrono::seconds kPatience{60};
constexpr std::size_t kMany = 400'000;  ///< 8 MB: more than any socket keeps.

publish::LabelledSector sector_of(std::uint32_t frame, std::uint32_t first,
                                  std::size_t points = 100) {
  publish::LabelledSector sector;
  sector.record = {.frame = frame, .first_return = first, .first_packet_ns = 1, .labels_ns = 2};
  sector.points.assign(points, {.x_m = 1, .label = frame::Label::kGround});
  return sector;
}

/// A capture that only notes what it is told.
class NotedCapture : public ViewedCapture {
 public:
  void obey(const PlayerCommand& command) override { told.push_back(command); }
  [[nodiscard]] PlayerState state() const override {
    return {.frame = 20, .position_s = 2, .duration_s = 9};
  }
  std::vector<PlayerCommand> told;
};

class PageBySectors : public Page {
 protected:
  PageBySectors() : Page(nullptr, true) {}
};

class PageWithObjects : public Page {
 protected:
  PageWithObjects() : Page(nullptr, false, {.objects = true}) {}
};

class PageWithFreeWay : public Page {
 protected:
  PageWithFreeWay() : Page(nullptr, false, {.free_way = true}) {}
};

class PageOfACapture : public Page {
 protected:
  PageOfACapture() : Page(&capture_) {}
  [[nodiscard]] test::HttpResponse tell(std::string_view body,
                                        std::string_view headers = {}) const {
    return test::ask(port_, "POST", "/control", headers, body);
  }
  inline static NotedCapture capture_;
};

TEST_F(Page, IsCompleteInItself) {
  const auto page = get("/");
  EXPECT_EQ(page.status, 200);
  EXPECT_THAT(page.body, HasSubstr("<canvas id=\"scene\""));
  EXPECT_THAT(page.head, HasSubstr("Content-Security-Policy: default-src 'self'"));
  for (const PageFile& file : view_page()) {
    const auto served = get(std::string(file.path).c_str());
    EXPECT_EQ(served.status, 200) << file.path;
    EXPECT_THAT(served.head, HasSubstr("Content-Type: " + std::string(file.type))) << file.path;
    for (const char* elsewhere : {"http://", "https://"}) {
      EXPECT_EQ(served.body.find(elsewhere), std::string::npos) << file.path;
    }
  }
  EXPECT_THAT(get("/view.js").head, HasSubstr("Content-Type: text/javascript"));
  EXPECT_EQ(get("/../../etc/passwd").status, 404);
}

TEST_F(Page, SaysHowFarTheSensorSeesWhereThatIsWatched) {
  status::MonitorSnapshot run;
  EXPECT_TRUE(sink_->put_figures(run));
  EXPECT_FALSE(figures().contains("sight"));
  run.sight.is_watched = 1;
  EXPECT_TRUE(sink_->put_figures(run));
  EXPECT_EQ(figures().at("sight").at("state"), "learning");
  run.sight.has_learnt = 1;
  for (auto& sector : run.sight.sectors) sector = {{}, 1, 38.254F};
  run.sight.sectors[33].condition = {visibility::State::kBlocked, visibility::Cause::kCovered};
  run.sight.sectors[20].has_view = 0;
  EXPECT_TRUE(sink_->put_figures(run));
  const json sight = figures().at("sight");
  EXPECT_EQ(sight.at("state"), "blocked");
  EXPECT_EQ(sight.at("text"), "blocked, covered: 1 sector, ahead left");
  ASSERT_EQ(sight.at("sectors").size(), 36U);
  EXPECT_EQ(sight.at("sectors").at(0), json::array({"clear", 38.25}));
  EXPECT_EQ(sight.at("sectors").at(33).at(0), "blocked");
  EXPECT_EQ(sight.at("sectors").at(20).at(0), "unknown");
}

TEST_F(Page, AnswersBrowsersThatAskThisMachineForItsOwnPageAlone) {
  const std::string here = "127.0.0.1:" + std::to_string(port_);
  const std::string host = "Host: " + here + "\r\n";
  EXPECT_EQ(get("/figures", host).status, 200);
  EXPECT_EQ(get("/figures", host + "Origin: http://" + here + "\r\n").status, 200);
  EXPECT_EQ(get("/figures", "Host: evil.example\r\n").status, 403);
  EXPECT_EQ(get("/figures", host + "Origin: http://evil.example\r\n").status, 403);
  EXPECT_EQ(get("/figures", host + "Origin: null\r\n").status, 403);
  EXPECT_EQ(get("/figures", host + "Origin: http://127.0.0.1:1\r\n").status, 403);
  EXPECT_EQ(get("/frames", host + "Origin: https://" + here + "\r\n").status, 403);
  EXPECT_EQ(get("/", "Host: localhost.evil.example\r\n").status, 403);
}

TEST_F(Page, GivesAPlaceAmongThoseThatLookToNoForeignPage) {
  const std::string browser = "User-Agent: Mozilla/5.0 (X11) Firefox/140.0\r\n";
  const std::string foreign = browser + "Sec-Fetch-Site: cross-site\r\n";
  EXPECT_EQ(get("/frames", foreign + "Sec-Fetch-Mode: no-cors\r\n").status, 403);
  EXPECT_EQ(get("/frames", foreign + "Sec-Fetch-Mode: navigate\r\n").status, 403);
  EXPECT_EQ(get("/frames", browser).status, 403) << "an address the browser does not trust";
  EXPECT_EQ(get("/", foreign + "Sec-Fetch-Mode: navigate\r\n").status, 200) << "a link leads here";
  EXPECT_EQ(sink_->losses()[1].name.view(), "view_requests_refused");
  EXPECT_EQ(sink_->losses()[1].count, 3U);
  ASSERT_TRUE(sink_->put(frame_of(7)));
  test::HttpClient own(port_);
  own.send("GET /frames HTTP/1.1\r\nHost: 127.0.0.1\r\n" + browser +
           "Sec-Fetch-Site: same-origin\r\nX-Terracut-Page: 1\r\n\r\n");
  EXPECT_THAT(own.read_until("\r\n\r\n"), HasSubstr("HTTP/1.1 200"));
  EXPECT_EQ(next_frame(own).number, 7U);
}

TEST_F(Page, SendsFramesAsTheLabelledStreamHasThem) {
  ASSERT_TRUE(sink_->put(frame_of(7)));
  const auto looking = browser();
  const stream::FrameWireHeader header = next_header(*looking);
  EXPECT_EQ(header.magic, stream::kFrameMagic);
  EXPECT_EQ(header.number, 7U);
  ASSERT_EQ(header.points, 1000U);
  const std::string bytes = looking->read(1000 * sizeof(stream::WirePoint));
  stream::WirePoint point;
  ASSERT_EQ(bytes.size(), 1000 * sizeof(point));
  std::memcpy(&point, bytes.data() + 999 * sizeof(point), sizeof(point));
  EXPECT_EQ(point.x_m, 1);
  EXPECT_EQ(point.label, 40);
}

TEST_F(Page, SendsHeightsAboveTheGroundWhereFramesHaveThem) {
  publish::LabelledFrame frame = frame_of(7, 2);
  frame.heights_m = {0.25F, -0.5F};
  ASSERT_TRUE(sink_->put(frame));
  const auto looking = browser();
  const stream::FrameWireHeader header = next_header(*looking);
  ASSERT_EQ(header.point_bytes, stream::kPointBytesWithHeight);
  const std::string bytes = looking->read(std::size_t{2} * stream::kPointBytesWithHeight);
  float second_m = 0;
  std::memcpy(&second_m, bytes.data() + bytes.size() - sizeof second_m, sizeof second_m);
  EXPECT_EQ(second_m, -0.5F);
}

TEST_F(Page, ABrowserThatStopsDelaysNoFrameAndMissesThem) {
  const auto stopped = browser(4096);
  const auto other = browser();
  // It sees frame after frame meanwhile, each before the next is made.
  for (std::uint32_t number = 1; number <= 5; ++number) {
    ASSERT_TRUE(sink_->put(frame_of(number, kMany)));
    const stream::FrameWireHeader header = next_frame(*other);
    EXPECT_EQ(header.number, number);
    EXPECT_EQ(header.missed, 0U);
  }
  EXPECT_EQ(figures().at("browsers").at("looking"), 2);
  EXPECT_EQ(figures().at("frames").size(), 5U);
}

TEST_F(Page, SlowBrowsersLeaveFramesOutWhichAreCounted) {
  ASSERT_TRUE(sink_->put(frame_of(1, kMany)));
  const auto slow = browser(4096);
  EXPECT_EQ(next_header(*slow).number, 1U);
  // It is busy, while five more come: of the first it has a part, the last it gets.
  for (std::uint32_t number = 2; number <= 6; ++number) {
    ASSERT_TRUE(sink_->put(frame_of(number, kMany)));
  }
  (void)slow->read(kMany * sizeof(stream::WirePoint));
  const stream::FrameWireHeader newest = next_frame(*slow);
  EXPECT_EQ(newest.number, 6U);
  EXPECT_EQ(newest.missed, 4U);
  EXPECT_EQ(sink_->losses().front().count, 4U);
}

TEST_F(PageBySectors, SendsSectorsAsTheyComeAndThenTheHeadOfTheirFrame) {
  EXPECT_TRUE(sink_->wants_sectors());
  const auto looking = browser(0, "/sectors");
  for (const std::uint32_t first : {0U, 100U}) {
    ASSERT_TRUE(sink_->put_sector(sector_of(7, first)));
    const stream::FrameWireHeader sector = next_frame(*looking);
    EXPECT_EQ(sector.number, 7U);
    EXPECT_EQ(sector.flags, stream::kFrameSector);
    EXPECT_EQ(sector.first_return, first);
    EXPECT_EQ(sector.points, 100U);
  }
  ASSERT_TRUE(sink_->put(frame_of(7, 200)));
  const stream::FrameWireHeader head = next_frame(*looking);
  EXPECT_EQ(head.flags & stream::kFrameSector, 0U);
  EXPECT_EQ(head.first_return, 200U);
  EXPECT_EQ(head.points, 0U);
  const auto of_frames = browser();
  EXPECT_EQ(next_frame(*of_frames).points, 200U) << "/frames has whole frames";
}

TEST_F(PageBySectors, ABrowserThatComesLateGetsTheLastTurnAtOnce) {
  for (std::uint32_t first = 0; first < 90'000; first += 100) {
    ASSERT_TRUE(sink_->put_sector(sector_of(1, first)));
  }
  const auto looking = browser(0, "/sectors");
  const std::uint32_t kept = ViewFrames::kSectorsKept;
  EXPECT_EQ(next_frame(*looking).first_return, 90'000 - 100 * kept);
  EXPECT_EQ(next_frame(*looking).first_return, 90'000 - 100 * (kept - 1));
}

TEST_F(PageBySectors, ABrowserThatIsTooSlowGoesOnWithTheLastTurnsAndTheRestIsCounted) {
  ASSERT_TRUE(sink_->put_sector(sector_of(1, 0, kMany)));
  const auto slow = browser(4096, "/sectors");
  EXPECT_EQ(next_header(*slow).first_return, 0U);
  for (std::uint32_t first = 1; first <= 1000; ++first) {
    ASSERT_TRUE(sink_->put_sector(sector_of(1, first)));
  }
  (void)slow->read(kMany * sizeof(stream::WirePoint));
  const stream::FrameWireHeader next = next_frame(*slow);
  constexpr std::uint32_t kSkipped = 1000 - ViewFrames::kSectorsKept;
  EXPECT_EQ(next.first_return, kSkipped + 1);
  EXPECT_EQ(next.missed, kSkipped);
  EXPECT_EQ(figures().at("browsers").at("sectors_skipped"), kSkipped);
  EXPECT_EQ(sink_->losses().back().count, kSkipped);
}

TEST_F(Page, WithoutSectorsSendsWholeFramesInTheirPlace) {
  EXPECT_FALSE(sink_->wants_sectors());
  ASSERT_TRUE(sink_->put(frame_of(7)));
  EXPECT_EQ(next_frame(*browser(0, "/sectors")).points, 1000U);
}

TEST_F(Page, ABrowserThatLeavesIsNoticedThoughNoFrameComes) {
  ASSERT_TRUE(sink_->put(frame_of(1)));
  EXPECT_EQ(next_frame(*browser()).number, 1U);
  const auto until = std::chrono::steady_clock::now() + kPatience;
  while (figures().at("browsers").at("looking") != 0 && std::chrono::steady_clock::now() < until) {
    std::this_thread::yield();
  }
  EXPECT_EQ(figures().at("browsers").at("looking"), 0);
}

TEST_F(Page, ShowsLatencyAndWhatMissedTheDeadline) {
  ASSERT_TRUE(sink_->put(frame_of(1)));
  publish::LabelledFrame late = frame_of(2);
  late.record.labels_ns = late.record.info.last_packet_ns + 60'000'000;
  late.record.level = status::Level::kCutStopped;
  ASSERT_TRUE(sink_->put(late));
  const json shown = figures();
  EXPECT_EQ(shown.at("deadline_ms"), 50);
  EXPECT_EQ(shown.at("rows"), 64);
  EXPECT_EQ(shown.at("sensor_height_m"), 1.73);
  EXPECT_EQ(shown.at("frames"), json::parse("[[4.0, 0, false], [60.0, 1, true]]"));
  EXPECT_EQ(shown.at("capture"), nullptr);
  EXPECT_EQ(shown.at("objects"), false);
  EXPECT_EQ(get("/found/1").status, 404);
  for (std::uint32_t number = 3; number < 400; ++number) {
    ASSERT_TRUE(sink_->put(frame_of(number)));
  }
  EXPECT_EQ(figures().at("frames").size(), ViewFrames::kFramesShown);
}

TEST_F(PageWithObjects, GivesTheBoxesOfTheFrameThatIsAskedFor) {
  EXPECT_EQ(figures().at("objects"), true);
  for (std::uint32_t number = 0; number < 100; ++number) {
    publish::LabelledFrame frame = frame_of(number);
    objects::Object object;
    object.bottom_m = 0.25F;
    object.top_m = 1.5F;
    object.ground_z_m = -1;
    object.box = {{static_cast<float>(number), 2}, {0, 1}, 4, 2};
    frame.objects = {object};
    ASSERT_TRUE(sink_->put(frame));
  }
  const json of_70 = json::parse(get("/found/70").body);
  EXPECT_EQ(of_70, json::parse(R"({"boxes": [{"corners": [[69, 4], [69, 0], [71, 0], [71, 4]],
                                              "bottom_m": -0.75, "top_m": 0.5}],
                                    "free_way": []})"));
  EXPECT_EQ(json::parse(get("/found/10").body), json::parse(R"({"boxes": [], "free_way": []})"))
      << "it is forgotten";
  for (const char* none : {"/found/", "/found/x", "/found/7x", "/found/-1"}) {
    EXPECT_EQ(get(none).status, 404) << none;
  }
}

TEST_F(PageWithFreeWay, GivesTheCornersOfTheFreeAreaOfTheFrameThatIsAskedFor) {
  EXPECT_EQ(figures().at("free_way"), true);
  EXPECT_EQ(figures().at("objects"), false);
  publish::LabelledFrame frame = frame_of(7);
  frame.free_way = {{-1.5707963F, 8, 5}, {1.5707963F, 3, 9}};  // to the right, to the left
  ASSERT_TRUE(sink_->put(frame));
  const json found = json::parse(get("/found/7").body);
  EXPECT_TRUE(found.at("boxes").empty());
  ASSERT_EQ(found.at("free_way").size(), 4U);
  EXPECT_NEAR(found.at("free_way")[0][0], 3, 0.01);
  EXPECT_NEAR(found.at("free_way")[1][0], -3, 0.01);
  EXPECT_NEAR(found.at("free_way")[2][0], -5, 0.01);
}

TEST_F(Page, KeepsTheLastFrameOfASensorThatIsSilentAndSaysSinceWhen) {
  ASSERT_TRUE(sink_->put(frame_of(7)));
  status::MonitorSnapshot run;
  run.link = status::LinkState::kReceiving;
  run.last_packet_ns = measure::realtime_ns() - 9'000'000'000;
  ASSERT_TRUE(sink_->put_figures(run));
  EXPECT_FALSE(figures().contains("silent_s"));
  run.link = status::LinkState::kSilent;
  ASSERT_TRUE(sink_->put_figures(run));
  EXPECT_NEAR(figures().at("silent_s").get<double>(), 9, 5);
  (void)browser();  // which comes only now, and gets the frame
}

TEST_F(Page, TellsWhatThoseWhoLookOnDidNotGetFromLosses) {
  status::MonitorSnapshot run;
  status::show_losses(
      std::vector<status::NamedCount>{
          {"kernel_drops", 3}, {"view_frames_skipped_by_browsers", 55}, {"unviewed_frames", 35}},
      run);
  ASSERT_TRUE(sink_->put_figures(run));
  EXPECT_EQ(figures().at("losses"), json::parse(R"([["kernel_drops", 3]])"));
  EXPECT_EQ(figures().at("onlookers"),
            json::parse(R"([["view_frames_skipped_by_browsers", 55], ["unviewed_frames", 35]])"));
}

TEST_F(Page, OfALiveRunHasNobodyPlayIt) {
  EXPECT_EQ(test::ask(port_, "POST", "/control", {}, "{\"playing\":false}").status, 409);
}

TEST_F(Page, MoreBrowsersThanItServesAreTurnedAway) {
  std::vector<std::unique_ptr<test::HttpClient>> browsers;
  for (std::size_t i = 0; i < HttpBounds{}.guests; ++i) browsers.push_back(browser());
  EXPECT_EQ(get("/frames").status, 503);
  EXPECT_EQ(get("/").status, 200);
}

TEST_F(Page, APortThatIsTakenIsSaid) {
  const auto second = ViewSink::open("127.0.0.1:" + std::to_string(port_), {}, nullptr);
  ASSERT_FALSE(second);
  EXPECT_THAT(second.error().message, HasSubstr("cannot serve the page on 127.0.0.1:"));
  EXPECT_THAT(second.error().message, HasSubstr("choose another address or port"));
}

TEST_F(PageOfACapture, TellsItsPlayer) {
  capture_.told.clear();
  const auto answer = tell(R"({"playing": false, "seek_s": 2.5, "rate": 0.5})");
  EXPECT_EQ(answer.status, 200);
  ASSERT_EQ(capture_.told.size(), 1U);
  EXPECT_EQ(capture_.told[0].playing, false);
  EXPECT_EQ(capture_.told[0].seek_s, 2.5);
  EXPECT_EQ(capture_.told[0].rate, 0.5);
  const json state = json::parse(answer.body).at("capture");
  EXPECT_EQ(state.at("duration_s"), 9);
  EXPECT_EQ(state.at("loop"), true);
  EXPECT_EQ(state.at("frame"), 20);
}

TEST_F(PageOfACapture, RefusesWhatIsNoCommand) {
  capture_.told.clear();
  for (const char* body :
       {"", "[]", "{", "{\"seek_s\": -1}", "{\"seek_s\": \"now\"}", "{\"rate\": 1e300}",
        "{\"playing\": 1}", "{\"delete\": true}", "\xff\xfe", "{\"rate\": 0}"}) {
    const auto answer = tell(body);
    EXPECT_EQ(answer.status, 400) << body;
    EXPECT_THAT(answer.body, HasSubstr("expected")) << body;
  }
  EXPECT_TRUE(capture_.told.empty());
  EXPECT_EQ(tell("{\"playing\":false}", "Origin: http://evil.example\r\n").status, 403);
  EXPECT_EQ(tell("{\"playing\":false}", "Sec-Fetch-Site: cross-site\r\n").status, 403);
  EXPECT_TRUE(capture_.told.empty());
}

}  // namespace
}  // namespace terracut::cli
