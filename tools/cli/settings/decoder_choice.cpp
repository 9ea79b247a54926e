// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "decoder_choice.hpp"

namespace terracut::cli {

decode::Decoder::Config decoder_config_of(const Options& options, int columns,
                                          vehicle::EgoMotion* motion) {
  const CaptureOptions& capture = options.capture;
  decode::Decoder::Config config;
  config.columns = columns;
  config.reorder_packets = capture.reorder_packets.value_or(config.reorder_packets);
  config.dual_owner = capture.cell_owner;
  config.hdl64e.geometry = capture.geometry;
  config.ruby128.timestamp = capture.timestamp;
  config.velodyne.is_named = capture.sensor.has_value();
  config.motion = motion;
  config.deskew_at = options.motion.deskew_to;
  return config;
}

}  // namespace terracut::cli
