// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "rt/error.hpp"
#include "rt/monitor_snapshot.hpp"

namespace terracut::cli {

/// The figures of a live run for programs, as written at its end and by `terracut top --json`:
///
///   terracut, sensor, input       the program's version, the sensor, where packets come from
///   started_ns, taken_ns          time of day, nanoseconds since 1970
///   deadline_ms
///   link                          state, packets, last_packet_ns
///   blind                         the sector in which the sensor sends nothing, degrees of its
///                                 head: from_deg, to_deg; null where none is known
///   frames                        count, per_second, returns, unjudged, rungs{rung: count}
///   misses                        total, consecutive, longest_run, causes{cause: count}
///   losses{cause: count}
///   mount                         height_m, roll_deg, pitch_deg as given; turns looked at,
///                                 contradicted; where it is, seen{the same three}
///   motion                        where asked for: bus, state, samples, spare_samples,
///                                 last_sample_ns, taken_out_frames, no_ego_motion_frames,
///                                 newest_sample_after_turn_ms{newest, min, mean, max},
///                                 faults{cause: count}
///   health                        where asked for, in CAN frames: bus, sent, queue_full,
///                                 link_down, failed
///   threads[]                     name, scheduling, minor_faults, major_faults
///   ms                            latency, wall, cpu_total, cpu_decode, cpu_segment and
///                                 stages{stage}: each {count, mean, p50, p90, p99, p99.9, max}
[[nodiscard]] nlohmann::ordered_json live_summary(const rt::MonitorSnapshot& figures);

/// The same as a file, whole or not at all.
[[nodiscard]] Status write_live_summary(const std::filesystem::path& path,
                                        const rt::MonitorSnapshot& figures);

}  // namespace terracut::cli
