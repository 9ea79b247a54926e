// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "calib/mount/ring_profile.hpp"
#include "calib/sensor_calibration.hpp"
#include "firmware_io/decode/decoder.hpp"
#include "firmware_io/sensor/unit_calibration.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/json_text.hpp"
#include "tools/cli/settings/made_calibration.hpp"
#include "tools/cli/settings/setup_choice.hpp"
#include "tools/research/detection/detection_bound.hpp"

namespace terracut::cli {
namespace {

using detection::Assumptions, detection::DetectionBound, detection::Ranges;
using sensor::SensorModel;
using Json = nlohmann::ordered_json;

constexpr std::array kHeights_m{1.0, 1.73, 3.0};  // a delivery robot's, a car's, a truck's
constexpr std::array kWidths_m{0.2, 0.5, 1.0, 2.0};
constexpr std::array kRanges{Ranges{5, 10},  Ranges{10, 15}, Ranges{15, 20}, Ranges{20, 25},
                             Ranges{25, 30}, Ranges{30, 40}, Ranges{40, 50}, Ranges{50, 60}};

/// Returns the unit of --calibration, else the model's.
Expected<calib::SensorCalibration> unit_of(const CaptureOptions& options, SensorModel model) {
  Expected<calib::SensorCalibration> unit = calib::nominal(model);
  if (sensor::is_ouster(model)) {
    const auto no_packets = []() -> Expected<calib::SensorCalibration> {
      return sensor::fail_for_ouster("detection");
    };
    return sensor::unit_calibration({.file = options.calibration}, model, no_packets);
  }
  if (options.calibration.empty()) return unit;
  packets::with_encoder_traits(model, [&](auto traits) {
    unit = made_calibration(options, traits).map([](auto made) {
      return calib::SensorCalibration(std::move(made));
    });
  });
  return unit;
}

/// Prints the rows of one mount height and adds their entries to `json`.
void print_rows(SensorModel model, double height_m, const DetectionBound& bound, Json& json) {
  std::vector<std::vector<std::optional<double>>> least_m;
  for (const Ranges& ranges : kRanges) least_m.push_back(bound.least_heights_m(ranges, kWidths_m));
  for (std::size_t width = 0; width < kWidths_m.size(); ++width) {
    std::string row = fmt::format("| {:.2f} m | {} m |", height_m, kWidths_m[width]);
    for (std::size_t i = 0; i < kRanges.size(); ++i) {
      const std::optional<double> least = least_m[i][width];
      row += least ? fmt::format(" {:.2f} |", *least) : " - |";
      json.push_back({{"sensor", to_string(model)},
                      {"mount_height_m", height_m},
                      {"width_m", kWidths_m[width]},
                      {"from_m", kRanges[i].from_m},
                      {"to_m", kRanges[i].to_m},
                      {"least_height_m", least ? Json(*least) : Json()}});
    }
    print_out("{}\n", row);
  }
}

}  // namespace

/// Prints the tables of docs/reference/detection.md in Markdown; without options all of them.
ExitCode run_detection(const Options& options) {
  const ground::SegmenterConfig config = method_config_of(options.method).segmenter;
  const Assumptions assumptions{.slope = options.detection.slope,
                                .roughness_m = options.detection.roughness_m};
  std::vector<SensorModel> models(sensor::kDecodedModels.begin(), sensor::kDecodedModels.end());
  std::erase(models, SensorModel::kHdl64eS1);  // the S2's table stands for all generations
  std::erase_if(models, sensor::is_ouster);    // each unit has its own angles
  if (!options.capture.calibration.empty()) models = {SensorModel::kHdl64e};
  if (options.capture.sensor) models = {*options.capture.sensor};
  std::vector<double> heights_m(kHeights_m.begin(), kHeights_m.end());
  if (options.mount.height_m) heights_m = {*options.mount.height_m};

  Json json{{"terracut", TERRACUT_VERSION},   {"command", "detection"},
            {"slope", assumptions.slope},     {"roughness_m", assumptions.roughness_m},
            {"noise_m", assumptions.noise_m}, {"depth_m", assumptions.depth_m},
            {"boxes", Json::array()}};
  for (const SensorModel model : models) {
    const auto unit = unit_of(options.capture, model);
    if (!unit) return refuse(unit.error());
    print_out("{}### {}\n\n| mount | width |", model == models.front() ? "" : "\n",
              to_string(model));
    std::string line = "\n|---|---|";
    for (const Ranges& ranges : kRanges) {
      print_out(" {}-{} m |", ranges.from_m, ranges.to_m);
      line += "---|";
    }
    print_out("{}\n", line);
    for (const double height_m : heights_m) {
      const mount::RingProfile profile = calib::ring_profile(*unit, {.height_m = height_m});
      memory::FixedMemory memory;
      const decode::Decoder decoder(*unit, profile.mount, {}, memory);
      print_rows(model, height_m, DetectionBound(config, profile, decoder.shape(), assumptions),
                 json["boxes"]);
    }
  }
  return done_or_refused(write_json(options.output.json, json));
}

}  // namespace terracut::cli
