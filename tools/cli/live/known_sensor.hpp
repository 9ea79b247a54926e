// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <optional>
#include <string>

#include "firmware_io/net/ipv4_endpoint.hpp"

namespace terracut::cli {

/// Remembers the sensor that the last run of a name heard, so that another sensor at the port does
/// not keep the next run from starting. The file NAME.terracut-sensor has the sensor's numeric
/// address. It lies in the state folder of the systemd service ($STATE_DIRECTORY), which survives a
/// restart of the machine; without a service, beside the status page, which does not. Files that
/// others could have written are ignored (files::check_trusted).
class KnownSensor {
 public:
  explicit KnownSensor(std::string name);

  /// Returns the remembered sensor, with a port if several were at its address; none if unknown.
  [[nodiscard]] std::optional<net::Sender> sender() const;
  /// Writes the file if the sensor has changed. Warns if the file cannot be written.
  void remember(const net::Sender& sender) const;

 private:
  std::string path_;
};

}  // namespace terracut::cli
