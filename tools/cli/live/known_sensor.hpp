// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <optional>
#include <string>

#include "firmware_io/net/ipv4_endpoint.hpp"

namespace terracut::cli {

/// The sensor that runs of a name heard last, so that another one at the port does not keep the
/// next run from starting: the file NAME.terracut-sensor, with its address in numbers, in systemd's
/// state folder of the service ($STATE_DIRECTORY), which outlives the machine's power, else beside
/// the status page, which does not. A file that others could have written is not believed
/// (files::check_trusted).
class KnownSensor {
 public:
  explicit KnownSensor(std::string name);

  /// Its port is known where there was another sensor at its address; none: none is known.
  [[nodiscard]] std::optional<net::Sender> sender() const;
  /// Writes only where it was another one. Warns where it cannot.
  void remember(const net::Sender& sender) const;

 private:
  std::string path_;
};

}  // namespace terracut::cli
