// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "rt/error.hpp"
#include "view_routes.hpp"

namespace terracut::cli {

/// Serves the page that shows labelled frames (view_routes.hpp), on threads of its own without a
/// deadline: one accepts, one each answers. There is neither encryption nor a password, so listen
/// on loopback unless the network is trusted.
class ViewServer {
 public:
  /// Listens on `address` (numeric) : `port`, 0 for any free one. `source` must outlive it.
  /// kInvalidArgument with the system's reason, such as a port in use.
  [[nodiscard]] static Expected<ViewServer> start(const std::string& address, std::uint16_t port,
                                                  ViewSource& source);

  ViewServer(ViewServer&&) noexcept;
  /// Ends all streams and waits for what is being answered: a second or two, or as long as a
  /// browser that stopped is waited for.
  ~ViewServer();

  /// "http://127.0.0.1:8480/"
  [[nodiscard]] const std::string& url() const noexcept;

 private:
  struct State;
  explicit ViewServer(std::unique_ptr<State> state);

  std::unique_ptr<State> state_;
};

}  // namespace terracut::cli
