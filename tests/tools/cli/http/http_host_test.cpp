// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/http/http_host.hpp"

#include <gtest/gtest.h>

namespace terracut::cli {
namespace {

TEST(HttpHost, IsThisMachineByAddressAsLocalhostOrByItsOwnName) {
  for (const char* host :
       {"127.0.0.1", "127.0.0.1:9464", "192.168.3.5:9464", "[::1]", "[fe80::1]:80", "localhost",
        "LOCALHOST:9464", "vehicle7", "Vehicle7:9464", ""}) {
    EXPECT_TRUE(names_this_machine(host, "vehicle7")) << host;
  }
  for (const char* host : {"rebound.example", "rebound.example:9464", "127.0.0.1.rebound.example",
                           "localhost.rebound.example", "vehicle7.rebound.example", "vehicle",
                           ":80", "[rebound]", "127.0.0.1:80.rebound.example"}) {
    EXPECT_FALSE(names_this_machine(host, "vehicle7")) << host;
  }
  EXPECT_FALSE(names_this_machine("vehicle7", ""));
}

TEST(HttpHost, KnowsWhatAForeignPageHasABrowserAsk) {
  const auto is_foreign = [](std::string_view origin, std::string_view site, std::string_view mode,
                             std::string_view method = "GET") {
    return is_asked_by_foreign_page({.method = method,
                                     .host = "127.0.0.1:8480",
                                     .origin = origin,
                                     .fetch_site = site,
                                     .fetch_mode = mode});
  };
  EXPECT_FALSE(is_foreign("", "", ""));
  EXPECT_FALSE(is_foreign("http://127.0.0.1:8480", "same-origin", "cors", "POST"));
  EXPECT_FALSE(is_foreign("", "same-origin", "no-cors"));
  EXPECT_FALSE(is_foreign("", "none", "navigate")) << "typed";
  EXPECT_FALSE(is_foreign("", "cross-site", "navigate")) << "a link was followed";
  EXPECT_TRUE(is_foreign("", "cross-site", "no-cors")) << "a picture's address";
  EXPECT_TRUE(is_foreign("", "same-site", "no-cors")) << "another port of this machine's";
  EXPECT_TRUE(is_foreign("http://evil.example", "cross-site", "navigate", "POST")) << "a form";
  EXPECT_TRUE(is_foreign("", "cross-site", "navigate", "POST"));
  EXPECT_TRUE(is_foreign("null", "", ""));
}

}  // namespace
}  // namespace terracut::cli
