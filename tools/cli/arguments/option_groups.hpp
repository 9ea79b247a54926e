// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>
#include <vector>

#include "tools/cli/options.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace terracut::cli {

// Options that several commands share. Each takes the values there are for its defaults.

/// What a capture and a live stream have in common.
void add_decoding(CLI::App& app, CaptureOptions& capture);
/// A capture, and how it is decoded.
void add_capture(CLI::App& app, CaptureOptions& capture);
void add_mount(CLI::App& app, MountOptions& mount);
/// What the vehicle's CAN frames mean, and what for; they need `can`, which says where from. Null
/// where that is known without.
void add_motion(CLI::App& app, CLI::Option* can, MotionOptions& motion);
/// --set.
void add_settings(CLI::App& app, std::vector<std::string>& settings);
/// --profile, --stages and --set.
void add_method(CLI::App& app, MethodOptions& method);
/// --method. After add_method(): --profile and --stages choose among ours only.
void add_rivals(CLI::App& app, MethodOptions& method);
/// Where only ours can run: whoever looks for --method learns why.
void refuse_rivals(CLI::App& app, const std::string& why);
void add_outputs(CLI::App& app, OutputOptions& output);
/// --sensor, where there is none to be found out.
void add_sensor(CLI::App& app, std::string& sensor);
/// --loop.
CLI::Option* add_loop(CLI::App& app, int& loops);
/// How datagrams are sent, whatever they are of.
std::vector<CLI::Option*> add_sending(CLI::App& app, SendOptions& options);

}  // namespace terracut::cli
