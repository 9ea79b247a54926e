// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>

#include "tests/support/http_client.hpp"
#include "tools/cli/view/view_sink.hpp"

namespace terracut::cli {

inline publish::LabelledFrame frame_of(std::uint32_t number, std::size_t points = 1000) {
  publish::LabelledFrame frame;
  frame.record.info.number = number;
  frame.record.info.last_packet_ns = 1'000'000'000;
  frame.record.labels_ns = 1'004'000'000;
  frame.points.assign(points, {.x_m = 1, .label = frame::Label::kGround});
  return frame;
}

/// The page, served, without a browser.
class Page : public testing::Test {
 protected:
  explicit Page(ViewedCapture* capture = nullptr, bool gives_sectors = false,
                scene::Wanted found = {}, ComparedWith compared = {}) {
    auto opened = ViewSink::open("127.0.0.1:0",
                                 {.sensor = "a made sensor",
                                  .rows = 64,
                                  .mount = {},
                                  .deadline_ns = 50'000'000,
                                  .gives_sectors = gives_sectors,
                                  .found = found},
                                 capture, {}, std::move(compared));
    if (!opened) throw std::runtime_error(opened.error().message);
    sink_ = *std::move(opened);
    const std::string& url = sink_->url();
    port_ = static_cast<std::uint16_t>(std::stoi(url.substr(url.rfind(':') + 1)));
  }

  [[nodiscard]] test::HttpResponse get(const char* path, std::string_view headers = {}) const {
    return test::get(port_, path, headers);
  }
  [[nodiscard]] nlohmann::json figures() const {
    return nlohmann::json::parse(get("/figures").body);
  }
  /// Its next bytes are those of the first frame.
  [[nodiscard]] std::unique_ptr<test::HttpClient> browser(
      int receive_buffer_bytes = 0, const std::string& path = "/frames") const {
    auto client = std::make_unique<test::HttpClient>(port_, receive_buffer_bytes);
    client->send("GET " + path + " HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n");
    EXPECT_THAT(client->read_until("\r\n\r\n"), testing::HasSubstr("HTTP/1.1 200"));
    return client;
  }

  std::unique_ptr<ViewSink> sink_;
  std::uint16_t port_ = 0;
};

inline stream::FrameWireHeader next_header(test::HttpClient& browser) {
  stream::FrameWireHeader header;
  const std::string bytes = browser.read(sizeof(header));
  if (bytes.size() == sizeof(header)) std::memcpy(&header, bytes.data(), sizeof(header));
  return header;
}
/// The header of a frame that was read whole.
inline stream::FrameWireHeader next_frame(test::HttpClient& browser) {
  const stream::FrameWireHeader header = next_header(browser);
  const std::size_t wanted = header.points * sizeof(stream::WirePoint);
  EXPECT_EQ(browser.read(wanted).size(), wanted);
  return header;
}

}  // namespace terracut::cli
