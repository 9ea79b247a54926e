// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/view/view_sink.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <httplib.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <atomic>
#include <chrono>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace terracut::cli {
namespace {

using nlohmann::json;
using testing::HasSubstr;

constexpr std::chrono::seconds kPatience{60};
constexpr std::size_t kMany = 400'000;  ///< 8 MB: more than any socket keeps.

publish::LabelledFrame frame_of(std::uint32_t number, std::size_t points = 1000) {
  publish::LabelledFrame frame;
  frame.record.info.number = number;
  frame.record.info.last_packet_ns = 1'000'000'000;
  frame.record.labels_ns = 1'004'000'000;
  frame.points.assign(points, {.x_m = 1, .label = 40});
  return frame;
}

/// A capture that only notes what it is told.
class NotedCapture : public ViewedCapture {
 public:
  void obey(const PlayerCommand& command) override { told.push_back(command); }
  [[nodiscard]] PlayerState state() const override { return {.position_s = 2, .duration_s = 9}; }
  std::vector<PlayerCommand> told;
};

class Page : public testing::Test {
 protected:
  explicit Page(ViewedCapture* capture = nullptr) {
    auto opened = ViewSink::open(
        "127.0.0.1:0",
        {.sensor = "a made sensor", .rows = 64, .mount = {}, .deadline_ns = 50'000'000}, capture);
    if (!opened) throw std::runtime_error(opened.error().message);
    sink_ = *std::move(opened);
    const std::string& url = sink_->url();
    port_ = std::stoi(url.substr(url.rfind(':') + 1));
  }

  [[nodiscard]] httplib::Client client() const { return httplib::Client("127.0.0.1", port_); }
  [[nodiscard]] json figures() const { return json::parse(client().Get("/figures")->body); }
  [[nodiscard]] int status_of(const char* path, const httplib::Headers& headers) const {
    const auto answer = client().Get(path, headers);
    return answer ? answer->status : 0;
  }

  std::unique_ptr<ViewSink> sink_;
  int port_ = 0;
};

class PageOfACapture : public Page {
 protected:
  PageOfACapture() : Page(&capture_) {}
  [[nodiscard]] httplib::Result tell(const std::string& body) const {
    return client().Post("/control", body, "application/json");
  }
  inline static NotedCapture capture_;
};

TEST_F(Page, IsCompleteInItself) {
  const auto page = client().Get("/");
  ASSERT_TRUE(page);
  EXPECT_EQ(page->status, 200);
  EXPECT_THAT(page->body, HasSubstr("<canvas id=\"scene\""));
  EXPECT_THAT(page->get_header_value("Content-Security-Policy"), HasSubstr("default-src 'self'"));
  for (const char* file :
       {"/view.js", "/scene.js", "/camera.js", "/colours.js", "/frames.js", "/strip.js"}) {
    const auto module = client().Get(file);
    ASSERT_TRUE(module) << file;
    EXPECT_EQ(module->status, 200) << file;
    EXPECT_THAT(module->get_header_value("Content-Type"), HasSubstr("javascript")) << file;
    EXPECT_EQ(module->body.find("http://"), std::string::npos) << file << " fetches from elsewhere";
    EXPECT_EQ(module->body.find("https://"), std::string::npos) << file;
  }
  EXPECT_EQ(client().Get("/../../etc/passwd")->status, 404);
}

TEST_F(Page, AnswersBrowsersThatAskThisMachineForItsOwnPageAlone) {
  const std::string here = "127.0.0.1:" + std::to_string(port_);
  EXPECT_EQ(status_of("/figures", {{"Host", here}}), 200);
  EXPECT_EQ(status_of("/figures", {{"Host", here}, {"Origin", "http://" + here}}), 200);
  EXPECT_EQ(status_of("/figures", {{"Host", "evil.example"}}), 403);
  EXPECT_EQ(status_of("/figures", {{"Host", here}, {"Origin", "http://evil.example"}}), 403);
  EXPECT_EQ(status_of("/figures", {{"Host", here}, {"Origin", "null"}}), 403);
  EXPECT_EQ(status_of("/figures", {{"Host", here}, {"Origin", "http://127.0.0.1:1"}}), 403);
  EXPECT_EQ(status_of("/frames", {{"Host", here}, {"Origin", "https://" + here}}), 403);
  EXPECT_EQ(status_of("/", {{"Host", "localhost.evil.example"}}), 403);
}

TEST_F(Page, SendsFramesAsTheLabelledStreamHasThem) {
  ASSERT_TRUE(sink_->put(frame_of(7)));
  std::string bytes;
  const std::size_t wanted = sizeof(stream::FrameWireHeader) + 1000 * sizeof(stream::LabelledPoint);
  client().Get("/frames", [&](const char* data, std::size_t size) {
    bytes.append(data, size);
    return bytes.size() < wanted;
  });
  ASSERT_GE(bytes.size(), wanted);
  stream::FrameWireHeader header;
  std::memcpy(&header, bytes.data(), sizeof(header));
  EXPECT_EQ(header.magic, stream::kFrameMagic);
  EXPECT_EQ(header.number, 7U);
  EXPECT_EQ(header.points, 1000U);
  stream::LabelledPoint point;
  std::memcpy(&point, bytes.data() + wanted - sizeof(point), sizeof(point));
  EXPECT_EQ(point.x_m, 1);
  EXPECT_EQ(point.label, 40);
}

TEST_F(Page, ABrowserThatStopsDelaysNoFrameAndMissesThem) {
  // Takes nothing beyond what the kernel keeps for it.
  const int stopped = ::socket(AF_INET, SOCK_STREAM, 0);
  const int small = 4096;
  ::setsockopt(stopped, SOL_SOCKET, SO_RCVBUF, &small, sizeof(small));
  ::sockaddr_in at{};
  at.sin_family = AF_INET;
  at.sin_port = htons(static_cast<std::uint16_t>(port_));
  at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  ASSERT_EQ(::connect(stopped, reinterpret_cast<::sockaddr*>(&at), sizeof(at)), 0);
  const std::string request = "GET /frames HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n";
  ASSERT_EQ(::send(stopped, request.data(), request.size(), 0),
            static_cast<ssize_t>(request.size()));
  while (figures().at("browsers").at("looking") == 0) std::this_thread::yield();

  // Another one sees frame after frame meanwhile, each before the next is made.
  std::atomic<std::uint32_t> seen{0};
  std::atomic<bool> enough{false};
  std::thread reader([&] {
    std::string bytes;
    client().Get("/frames", [&](const char* data, std::size_t size) {
      bytes.append(data, size);
      stream::FrameWireHeader header;
      while (bytes.size() >= sizeof(header)) {
        std::memcpy(&header, bytes.data(), sizeof(header));
        const std::size_t whole = sizeof(header) + header.points * sizeof(stream::LabelledPoint);
        if (bytes.size() < whole) break;
        EXPECT_EQ(header.missed, 0U);
        seen = header.number;
        bytes.erase(0, whole);
      }
      return !enough;
    });
  });
  while (figures().at("browsers").at("looking") != 2) std::this_thread::yield();
  for (std::uint32_t number = 1; number <= 5; ++number) {
    ASSERT_TRUE(sink_->put(frame_of(number, kMany)));
    const auto until = std::chrono::steady_clock::now() + kPatience;
    while (seen < number && std::chrono::steady_clock::now() < until) std::this_thread::yield();
    ASSERT_EQ(seen, number);
  }
  enough = true;
  ASSERT_TRUE(sink_->put(frame_of(6)));
  reader.join();
  ::close(stopped);
  EXPECT_EQ(figures().at("frames").size(), 6U);
}

TEST_F(Page, SlowBrowsersLeaveFramesOutWhichAreCounted) {
  ASSERT_TRUE(sink_->put(frame_of(1, kMany)));
  std::string bytes;
  std::vector<stream::FrameWireHeader> got;
  client().Get("/frames", [&](const char* data, std::size_t size) {
    bytes.append(data, size);
    const std::size_t whole =
        sizeof(stream::FrameWireHeader) + kMany * sizeof(stream::LabelledPoint);
    if (bytes.size() < whole) return true;
    std::memcpy(&got.emplace_back(), bytes.data(), sizeof(stream::FrameWireHeader));
    bytes.erase(0, whole);
    // It is busy, while five more come: of the first it may have a part already, the last it gets.
    for (std::uint32_t number = 2; got.size() == 1 && number <= 6; ++number) {
      (void)sink_->put(frame_of(number, kMany));
    }
    return got.back().number != 6;
  });
  ASSERT_LE(got.size(), 3U);
  EXPECT_EQ(got.back().missed, 6 - got.size());
  EXPECT_EQ(sink_->losses().front().count, got.back().missed);
}

TEST_F(Page, ABrowserThatLeavesIsNoticedThoughNoFrameComes) {
  ASSERT_TRUE(sink_->put(frame_of(1)));
  client().Get("/frames", [](const char*, std::size_t) { return false; });
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
  EXPECT_EQ(shown.at("frames"), json::parse("[[4.0, 0, false], [60.0, 1, true]]"));
  EXPECT_EQ(shown.at("capture"), nullptr);
  for (std::uint32_t number = 3; number < 400; ++number) {
    ASSERT_TRUE(sink_->put(frame_of(number)));
  }
  EXPECT_EQ(figures().at("frames").size(), ViewFrames::kFramesShown);
}

TEST_F(Page, OfALiveRunHasNobodyPlayIt) {
  const auto answer = client().Post("/control", "{\"playing\":false}", "application/json");
  EXPECT_EQ(answer->status, 409);
}

TEST_F(Page, MoreBrowsersThanItServesAreTurnedAway) {
  std::vector<std::thread> browsers;
  std::atomic<bool> enough{false};
  for (int i = 0; i < kMostViewers; ++i) {
    browsers.emplace_back(
        [&] { client().Get("/frames", [&](const char*, std::size_t) { return !enough; }); });
  }
  while (figures().at("browsers").at("looking") != kMostViewers) std::this_thread::yield();
  EXPECT_EQ(status_of("/frames", {}), 503);
  enough = true;
  ASSERT_TRUE(sink_->put(frame_of(1)));
  for (std::thread& browser : browsers) browser.join();
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
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 200);
  ASSERT_EQ(capture_.told.size(), 1U);
  EXPECT_EQ(capture_.told[0].playing, false);
  EXPECT_EQ(capture_.told[0].seek_s, 2.5);
  EXPECT_EQ(capture_.told[0].rate, 0.5);
  EXPECT_EQ(json::parse(answer->body).at("capture").at("duration_s"), 9);
}

TEST_F(PageOfACapture, RefusesWhatIsNoCommand) {
  capture_.told.clear();
  for (const char* body :
       {"", "[]", "{", "{\"seek_s\": -1}", "{\"seek_s\": \"now\"}", "{\"rate\": 1e300}",
        "{\"playing\": 1}", "{\"delete\": true}", "\xff\xfe", "{\"rate\": 0}"}) {
    const auto answer = tell(body);
    ASSERT_TRUE(answer) << body;
    EXPECT_EQ(answer->status, 400) << body;
    EXPECT_THAT(answer->body, HasSubstr("expected")) << body;
  }
  EXPECT_TRUE(capture_.told.empty());
  const std::string here = "127.0.0.1:" + std::to_string(port_);
  const auto foreign =
      client().Post("/control", {{"Host", here}, {"Origin", "http://evil.example"}},
                    "{\"playing\":false}", "text/plain");
  EXPECT_EQ(foreign->status, 403);
  EXPECT_TRUE(capture_.told.empty());
}

}  // namespace
}  // namespace terracut::cli
