// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/publish/frame_sink.hpp"
#include "pipeline/publish/run_facts.hpp"
#include "rt/error.hpp"
#include "tools/cli/http/http_server.hpp"
#include "view_routes.hpp"

namespace terracut::cli {

/// An output of a run that shows frames in a browser (view_routes.hpp), within HttpBounds: each
/// slow browser holds a frame of its own. All that a run notices of browsers is the count of frames
/// and sectors that they skipped, in losses(). Listen on loopback unless the network is trusted.
class ViewSink : public publish::FrameSink {
 public:
  /// `endpoint` is like "127.0.0.1:8480". `capture` is its player, which outlives this object; null
  /// in live runs. `compared` is what its frames are compared with. Fails with the errors of
  /// HttpServer::start().
  [[nodiscard]] static Expected<std::unique_ptr<ViewSink>> open(const std::string& endpoint,
                                                                const publish::RunFacts& facts,
                                                                ViewedCapture* capture,
                                                                const HttpBounds& bounds = {},
                                                                ComparedWith compared = {});

  [[nodiscard]] std::string_view name() const noexcept override { return "view"; }
  [[nodiscard]] bool wants_sectors() const noexcept override { return frames_.gives_sectors(); }
  [[nodiscard]] Status put(const publish::LabelledFrame& frame) override;
  void put_compared(const publish::LabelledFrame& frame, const FrameComparison& comparison);
  [[nodiscard]] Status put_sector(const publish::LabelledSector& sector) override;
  [[nodiscard]] Status put_figures(const status::MonitorSnapshot& figures) override;
  [[nodiscard]] std::vector<status::NamedCount> losses() const override;

  /// Returns "http://127.0.0.1:8480/".
  [[nodiscard]] const std::string& url() const noexcept { return url_; }

 private:
  ViewSink(const publish::RunFacts& facts, ViewedCapture* capture, ComparedWith compared);
  void send_next();

  ViewFrames frames_;
  ViewSource source_;
  std::string url_;
  std::optional<HttpServer> server_;  ///< Declared last: uses all members above.
};

}  // namespace terracut::cli
