// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/publish/frame_sink.hpp"
#include "pipeline/publish/stream.hpp"
#include "rt/error.hpp"
#include "view_server.hpp"

namespace terracut::cli {

/// The page that shows frames in a browser, as an output of a run. What browsers do never shows
/// here but in losses(): frames that one of them left out.
class ViewSink : public publish::FrameSink {
 public:
  /// `endpoint`: "127.0.0.1:8480". `capture`: its player, which outlives this; null where nobody
  /// plays. The errors of ViewServer::start().
  [[nodiscard]] static Expected<std::unique_ptr<ViewSink>> open(const std::string& endpoint,
                                                                const publish::Stream& stream,
                                                                ViewedCapture* capture);

  [[nodiscard]] std::string_view name() const noexcept override { return "view"; }
  [[nodiscard]] Status put(const publish::LabelledFrame& frame) override;
  [[nodiscard]] Status put_figures(const status::MonitorSnapshot& figures) override;
  [[nodiscard]] std::vector<status::NamedCount> losses() const override;

  [[nodiscard]] const std::string& url() const noexcept { return server_->url(); }

 private:
  ViewSink(const publish::Stream& stream, ViewedCapture* capture);

  ViewFrames frames_;
  ViewSource source_;
  std::unique_ptr<ViewServer> server_;
};

}  // namespace terracut::cli
