// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

namespace terracut {

/// A sensor model whose packets are decoded.
enum class Sensor : std::uint8_t {
  kHdl64e,  ///< HDL-64E of any generation.
  kRuby128,
  kVlp16,
  kHdl32e,
  kVlp32c,
  kVls128,
  kPandar40p,
  kPandar64,
  kPandarQt64,
  kPandarQt128,
  kPandarXt16,
  kPandarXt32,
  kPandarXt32m,
  kOt128,
  kPandar128,  ///< Pandar128E3X; a Pandar128E4X is an OT128.
  kOuster32,   ///< An OS0, OS1 or OS2 with 32 rows.
  kOuster64,
  kOuster128,
  kRs32,   ///< RS-LiDAR-32.
  kHelios  ///< An RS-Helios with 32 lasers.
};

}  // namespace terracut
