// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// All public headers in one file.
#include <terracut/calibration.hpp>
#include <terracut/decoder.hpp>
#include <terracut/error.hpp>
#include <terracut/frame.hpp>
#include <terracut/free_way.hpp>
#include <terracut/ground_grid.hpp>
#include <terracut/live_run.hpp>
#include <terracut/object.hpp>
#include <terracut/outputs.hpp>
#include <terracut/packet_pipeline.hpp>
#include <terracut/segmenter.hpp>
#include <terracut/sensor.hpp>
