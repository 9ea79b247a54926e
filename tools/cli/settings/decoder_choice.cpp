// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "decoder_choice.hpp"

namespace terracut::cli {

sensor::SensorDecoder::Config decoder_config_of(const CaptureOptions& options, int columns) {
  sensor::SensorDecoder::Config config;
  config.columns = columns;
  config.reorder_packets = options.reorder_packets.value_or(config.reorder_packets);
  config.dual_owner = options.cell_owner;
  config.hdl64e.geometry = options.geometry;
  config.ruby128.timestamp = options.timestamp;
  return config;
}

}  // namespace terracut::cli
