// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/mount/sensor_setup_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <iterator>
#include <string_view>

#include "calib/beams/angle.hpp"
#include "calib/text/bounded_file.hpp"
#include "calib/text/number_text.hpp"
#include "calib/text/yaml_document.hpp"
#include "rt/files/whole_file.hpp"

namespace terracut::mount {
namespace {

constexpr std::size_t kMaxRings = 1024;
/// Tolerance so that rounding keeps the ends of a range in it.
constexpr double kRounding_deg = 1e-6;

tl::unexpected<Error> malformed(std::string message) {
  return fail(ErrorCode::kMalformed, std::move(message));
}

/// A key of a map, and what to do with its value. The function's message says where the value
/// stands.
struct Key {
  std::string_view name;
  std::function<Status(const YAML::Node&, const std::string& where)> read;
};

/// Reads `map`; each of its keys must be one of `keys` and occur once.
Status read_map(const YAML::Node& map, const std::string& file, std::span<const Key> keys) {
  if (!map.IsMap())
    return malformed(text::where_is(map, file) + ": expected a map of keys and values");
  std::vector<std::string> seen;
  for (const auto& entry : map) {
    const std::string where = text::where_is(entry.first, file);
    const std::string name = entry.first.IsScalar() ? entry.first.Scalar() : std::string("(list)");
    const Key* key = nullptr;
    std::string known;
    for (const Key& candidate : keys) {
      if (candidate.name == name) key = &candidate;
      known += known.empty() ? "" : ", ";
      known += candidate.name;
    }
    if (key == nullptr) {
      return malformed(fmt::format("{}: unknown key \"{:.40}\", expected {}", where, name, known));
    }
    for (const std::string& earlier : seen) {
      if (earlier == name) return malformed(fmt::format("{}: {} is there twice", where, name));
    }
    seen.push_back(name);
    if (Status status = key->read(entry.second, fmt::format("{}: {}", where, name)); !status) {
      return status;
    }
  }
  return {};
}

/// Returns `node` as a number, which must lie inside (low, high); infinity is accepted in (0, inf].
Expected<double> number_within(const YAML::Node& node, const std::string& where, double low,
                               double high) {
  const auto value = node.IsScalar() ? text::number_from(node.Scalar()) : std::nullopt;
  const bool inside = value && *value > low && (*value < high || (std::isinf(high) && *value > 0));
  if (!inside) {
    return malformed(fmt::format("{} is \"{:.40}\", expected a number between {:g} and {:g}", where,
                                 node.IsScalar() ? node.Scalar() : std::string("(not a number)"),
                                 low, high));
  }
  return *value;
}

Status read_mount(const YAML::Node& node, const std::string& file, Mount& mount) {
  bool has_height = false;
  const auto angle = [](double& target_rad, double most_deg) {
    return [&target_rad, most_deg](const YAML::Node& value, const std::string& where) -> Status {
      const double limit_deg = most_deg + kRounding_deg;
      const auto deg = number_within(value, where, -limit_deg, limit_deg);
      if (!deg) return tl::unexpected(deg.error());
      target_rad = beams::deg_to_rad(*deg);
      return {};
    };
  };
  const Key keys[] = {
      {"height_m",
       [&](const YAML::Node& value, const std::string& where) -> Status {
         const auto height_m = number_within(value, where, 0.2, 6.0);
         if (!height_m) return tl::unexpected(height_m.error());
         mount.height_m = *height_m;
         has_height = true;
         return {};
       }},
      {"roll_deg", angle(mount.roll_rad, 180)},
      {"pitch_deg", angle(mount.pitch_rad, 90)},
  };
  if (Status status = read_map(node, file, keys); !status) return status;
  if (!has_height) return malformed(text::where_is(node, file) + ": mount has no height_m");
  return {};
}

Status read_rings(const YAML::Node& node, const std::string& file, std::vector<double>& distances) {
  const Key keys[] = {
      {"ground_distance_m", [&](const YAML::Node& list, const std::string& where) -> Status {
         if (!list.IsSequence() || list.size() == 0 || list.size() > kMaxRings) {
           return malformed(
               fmt::format("{}: expected a list of 1 to {} distances", where, kMaxRings));
         }
         for (const YAML::Node& item : list) {
           const auto distance_m = number_within(
               item, fmt::format("{}: entry {}", where, distances.size()), 0.0, HUGE_VAL);
           if (!distance_m) return tl::unexpected(distance_m.error());
           distances.push_back(*distance_m);
         }
         return {};
       }}};
  return read_map(node, file, keys);
}

}  // namespace

Expected<SensorSetup> parse_sensor_setup(std::span<const char> text, const std::string& name) {
  const auto root = text::load_yaml_document({text.data(), text.size()}, name);
  if (!root) return tl::unexpected(root.error());
  SensorSetup setup;
  bool has_mount = false;
  const Key keys[] = {
      {"mount",
       [&](const YAML::Node& node, const std::string&) {
         has_mount = true;
         return read_mount(node, name, setup.mount);
       }},
      {"rings",
       [&](const YAML::Node& node, const std::string&) {
         return read_rings(node, name, setup.ring_ground_distance_m);
       }},
  };
  try {
    if (Status status = read_map(*root, name, keys); !status) {
      return tl::unexpected(status.error());
    }
  } catch (const YAML::Exception& error) {
    return malformed(fmt::format("{}: line {}: {}", name, error.mark.line + 1, error.msg));
  }
  if (!has_mount) return malformed(name + ": expected a sensor setup with \"mount:\", found none");
  return setup;
}

Expected<SensorSetup> read_sensor_setup(const std::filesystem::path& path) {
  const auto text = text::read_bounded_file(path, "a terracut sensor setup");
  if (!text) return tl::unexpected(text.error());
  return parse_sensor_setup(*text, path.string());
}

Status write_sensor_setup(const std::filesystem::path& path, const SensorSetup& setup) {
  std::string text = fmt::format(
      "# terracut sensor setup: how the sensor stands on the vehicle (docs/reference/sensors.md)\n"
      "mount: {{height_m: {:.4f}, roll_deg: {:.4f}, pitch_deg: {:.4f}}}\n",
      setup.mount.height_m, beams::rad_to_deg(setup.mount.roll_rad),
      beams::rad_to_deg(setup.mount.pitch_rad));
  if (!setup.ring_ground_distance_m.empty()) {
    text +=
        "# mean horizontal distance of each ring on the ground, lowest beam first\n"
        "rings:\n  ground_distance_m:\n";
    for (const double distance_m : setup.ring_ground_distance_m) {
      text += std::isinf(distance_m) ? std::string("    - .inf\n")
                                     : fmt::format("    - {:.4f}\n", distance_m);
    }
  }
  if (const auto readable = parse_sensor_setup(text, "sensor setup"); !readable) {
    return fail(ErrorCode::kInvalidArgument, readable.error().message);
  }
  return files::write_whole_file(path, text);
}

Status apply_setup(const SensorSetup& setup, RingProfile& profile) {
  const auto& distances = setup.ring_ground_distance_m;
  if (!distances.empty() && distances.size() != profile.rings.size()) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("sensor setup: expected ground distances of {} rings, found {}",
                            profile.rings.size(), distances.size()));
  }
  profile.mount = setup.mount;
  for (std::size_t row = 0; row < distances.size(); ++row) {
    profile.rings[row].ground_distance_m = distances[row];
  }
  return {};
}

}  // namespace terracut::mount
