// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "blind_text.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace terracut::cli {

std::string blind_text(const firmware_io::BlindAzimuths& blind) {
  if (blind.is_none()) return {};
  return fmt::format("from {:.1f} to {:.1f} deg of the head", blind.from_cdeg * 0.01,
                     blind.to_cdeg * 0.01);
}

nlohmann::ordered_json blind_json(const firmware_io::BlindAzimuths& blind) {
  if (blind.is_none()) return nullptr;
  return {{"from_deg", blind.from_cdeg / 100.0}, {"to_deg", blind.to_cdeg / 100.0}};
}

}  // namespace terracut::cli
