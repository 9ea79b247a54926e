// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "tools/cli/live/live_options.hpp"
#include "tools/cli/options.hpp"

namespace CLI {
class App;
}  // namespace CLI

namespace terracut::cli {

// The options of each command, by what it is for. `o` holds their defaults and gets their values.

// Of captures and recorded scans, without a sensor. capture_commands.cpp
void add_replay(CLI::App& sub, ReplayOptions& o);
void add_segment(CLI::App& sub, SegmentOptions& o);
void add_encode(CLI::App& sub, EncodeOptions& o);
void add_calibrate(CLI::App& sub, CalibrateOptions& o);
void add_info(CLI::App& sub, InfoOptions& o);
void add_plan(CLI::App& sub, PlanOptions& o);
void add_bench(CLI::App& sub, BenchOptions& o);

// Of a sensor that sends now or what plays one, and what belongs to a live run. sensor_commands.cpp
void add_live(CLI::App& sub, LiveOptions& o);
void add_dump(CLI::App& sub, DumpOptions& o);
void add_top(CLI::App& sub, TopOptions& o);
void add_doctor(CLI::App& sub, DoctorOptions& o);
void add_send(CLI::App& sub, SendOptions& o);
void add_simulate(CLI::App& sub, SimulateOptions& o);
void add_config(CLI::App& sub, ConfigOptions& o);

// Of labelled datasets. evaluation_commands.cpp
void add_eval(CLI::App& sub, EvalOptions& o);
void add_compare(CLI::App& sub, CompareOptions& o);

}  // namespace terracut::cli
