// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace terracut::cli {

/// The sensor that runs of a name heard last, so that another one at the port does not keep the
/// next run from starting: the file NAME.terracut-sensor, with its address in numbers, in systemd's
/// state folder of the service ($STATE_DIRECTORY), which outlives the machine's power, else beside
/// the status page, which does not. A file that others could have written is not believed
/// (files::check_trusted).
class KnownSensor {
 public:
  explicit KnownSensor(std::string name);

  /// IPv4, as in Datagram; none: none is known.
  [[nodiscard]] std::optional<std::uint32_t> address() const;
  /// Writes only where it was another one. Warns where it cannot.
  void remember(std::uint32_t address) const;

 private:
  std::string path_;
};

}  // namespace terracut::cli
