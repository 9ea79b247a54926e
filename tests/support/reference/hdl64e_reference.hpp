// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>

#include "calib/hdl64e/hdl64e_calibration.hpp"
#include "reference_return.hpp"

namespace terracut::reference {

/// How the offsets enter the coordinates: the maker's sample code, or as ROS drivers do.
enum class Hdl64eOffsets : std::uint8_t { kManual, kRosLike };

/// A plain, slow decoder of HDL-64E data packets, single and dual return, written from the layout,
/// the firing times and the geometry of the maker's manuals, byte by byte and in double. It shares
/// nothing with the product's decoder but the calibration's struct, so that a mistake would have to
/// be made twice. Keeps no state from packet to packet.
///
/// What no manual says is as terracut fixes it: the step from firing to firing is the packet's own,
/// (last - first) / firings between, dual return is told by azimuths that come in pairs, and the
/// near correction ends at 25.04 m per axis.
class Hdl64eReference {
 public:
  explicit Hdl64eReference(const hdl64e::Hdl64eCalibration& calibration,
                           Hdl64eOffsets offsets = Hdl64eOffsets::kManual)
      : calibration_(calibration), offsets_(offsets) {}

  /// `column` of a return counts pairs of blocks; in dual return the two of a firing follow each
  /// other.
  [[nodiscard]] Packet decode(std::span<const std::uint8_t> payload) const;

 private:
  void locate(Return& beam) const;

  hdl64e::Hdl64eCalibration calibration_;
  Hdl64eOffsets offsets_;
};

}  // namespace terracut::reference
