// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "decoder_choice.hpp"

#include "tools/cli/settings/setup_choice.hpp"
#include "tools/research/baselines/method_config.hpp"

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

run::PacketPipeline::Makes frames_with(run::PacketPipeline::Makes wanted, const Options& options) {
  const bool needs_points = baselines::needs_all_points(method_config_of(options.method));
  return needs_points ? run::PacketPipeline::Makes::kPoints : wanted;
}

}  // namespace terracut::cli
