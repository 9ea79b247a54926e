// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <span>
#include <string>
#include <vector>

#include "firmware_io/capture/pcap_source.hpp"
#include "firmware_io/streams/sensor_stream.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// The name of one of several sensors, and the options that choose it.
struct StreamName {
  std::string name;     ///< "Velodyne VLP-16 at 192.168.1.201 to port 2369"
  std::string options;  ///< "--port 2369"
};
/// Names each sensor by as few marks as distinguish them all.
[[nodiscard]] std::vector<StreamName> names_of(std::span<const streams::SensorStream> sensors);

/// Returns "A, B; choose one with --port 2368 or --port 2369" for several sensors.
[[nodiscard]] std::string choice_text(std::span<const streams::SensorStream> sensors);

/// Returns the filter for --from, --port, --to, --vlan and --mac.
[[nodiscard]] capture::PcapFilter filter_of(const CaptureOptions& options);

}  // namespace terracut::cli
