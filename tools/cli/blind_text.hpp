// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "firmware_io/frame_info.hpp"
#include "rt/monitor_snapshot.hpp"

namespace terracut::cli {

[[nodiscard]] inline firmware_io::BlindAzimuths blind_of(
    const rt::MonitorSnapshot& figures) noexcept {
  return {figures.blind_from_cdeg, figures.blind_to_cdeg};
}

/// "from 90.0 to 270.0 deg of the head"; empty where no blind sector is known.
[[nodiscard]] std::string blind_text(const firmware_io::BlindAzimuths& blind);

/// from_deg, to_deg; null where no blind sector is known.
[[nodiscard]] nlohmann::ordered_json blind_json(const firmware_io::BlindAzimuths& blind);

}  // namespace terracut::cli
