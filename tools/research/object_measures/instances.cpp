// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "instances.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "firmware_io/scan/label_file.hpp"
#include "overlaps.hpp"

namespace terracut::object_measures {
namespace {

constexpr std::uint32_t kFewestOfAnInstance = 10;

bool has_instances(std::uint16_t semantic_class) {
  return (semantic_class >= 10 && semantic_class <= 32) || semantic_class >= 252;
}

/// The instance of each return, its entry in the label file; 0: no instance.
struct TrueInstances {
  std::vector<std::uint32_t> of_return;
  std::vector<std::uint8_t> is_known;  ///< By return: false where the truth does not say.
};

TrueInstances true_instances(std::span<const std::uint32_t> labels) {
  std::map<std::uint32_t, std::uint32_t> sizes;
  for (const std::uint32_t label : labels) ++sizes[label];
  TrueInstances truth{std::vector<std::uint32_t>(labels.size()),
                      std::vector<std::uint8_t>(labels.size())};
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const std::uint16_t of_class = scan::semantic_class(labels[i]);
    const bool is_numbered = has_instances(of_class) && labels[i] >> 16 != 0;
    const bool is_instance = is_numbered && sizes[labels[i]] >= kFewestOfAnInstance;
    if (is_instance) truth.of_return[i] = labels[i];
    truth.is_known[i] = is_instance || (of_class > 1 && !has_instances(of_class)) ? 1 : 0;
  }
  return truth;
}

/// Where instances count.
struct Slot {
  std::size_t kind = 0, band = 0;
};

std::map<std::uint32_t, Slot> slots_of(std::span<const std::uint32_t> instances,
                                       std::span<const Place> places) {
  std::map<std::uint32_t, double> nearest_m;
  for (std::size_t i = 0; i < instances.size(); ++i) {
    const double range_m = std::hypot(double{places[i].x_m}, double{places[i].y_m});
    const auto at = nearest_m.try_emplace(instances[i], range_m).first;
    at->second = std::min(at->second, range_m);
  }
  std::map<std::uint32_t, Slot> slots;
  for (const auto& [instance, range_m] : nearest_m) {
    const Kind kind = kind_of(scan::semantic_class(instance));
    slots[instance] = {static_cast<std::size_t>(kind), statistics::range_band(range_m)};
  }
  return slots;
}

/// What is known of a found object or of a true instance once all overlaps were seen.
struct Match {
  bool is_made = false;
  std::uint32_t most = 0;          ///< Returns shared with the instance below.
  std::uint32_t instance = 0;      ///< The one with which an object shares most.
  std::uint32_t on_instances = 0;  ///< Returns of an object that are any instance's.
};

}  // namespace

Kind kind_of(std::uint16_t semantic_class) noexcept {
  switch (semantic_class) {
    case 10:
    case 252:
      return Kind::kCar;
    case 30:
    case 254:
      return Kind::kPerson;
    case 11:
    case 15:
    case 31:
    case 32:
    case 253:
    case 255:
      return Kind::kTwoWheeler;
    default:
      return Kind::kOther;
  }
}

InstanceCounts& InstanceCounts::operator+=(const InstanceCounts& other) noexcept {
  found += other.found;
  missed += other.missed;
  false_objects += other.false_objects;
  iou_sum += other.iou_sum;
  return *this;
}

double InstanceCounts::panoptic_quality() const noexcept {
  return iou_sum / (static_cast<double>(found) +
                    0.5 * (static_cast<double>(missed) + static_cast<double>(false_objects)));
}

double InstanceCounts::recall() const noexcept {
  return static_cast<double>(found) / static_cast<double>(found + missed);
}

InstancesByKind& InstancesByKind::operator+=(const InstancesByKind& other) noexcept {
  for (std::size_t kind = 0; kind < counts.size(); ++kind) {
    for (std::size_t band = 0; band < counts[kind].size(); ++band) {
      counts[kind][band] += other.counts[kind][band];
    }
  }
  return *this;
}

InstanceCounts InstancesByKind::of(Kind kind) const noexcept {
  InstanceCounts sum;
  for (const InstanceCounts& part : counts[static_cast<std::size_t>(kind)]) sum += part;
  return sum;
}

InstanceCounts InstancesByKind::all() const noexcept {
  InstanceCounts sum;
  for (std::size_t kind = 0; kind < kKinds; ++kind) sum += of(static_cast<Kind>(kind));
  return sum;
}

InstancesByKind compare_instances(std::span<const Place> places,
                                  std::span<const std::uint32_t> labels,
                                  std::span<const std::uint32_t> found_object) {
  const TrueInstances truth = true_instances(labels);
  std::vector<std::uint32_t> objects(found_object.begin(), found_object.end());
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (truth.is_known[i] == 0) objects[i] = 0;
  }
  const Overlaps counts = overlaps(truth.of_return, objects);
  const std::map<std::uint32_t, Slot> slots = slots_of(truth.of_return, places);
  InstancesByKind result;
  const auto counts_of = [&](std::uint32_t instance) -> InstanceCounts& {
    const Slot& slot = slots.at(instance);
    return result.counts[slot.kind][slot.band];
  };
  std::map<std::uint32_t, Match> instances, found;
  for (const auto& [parts, returns] : counts.both) {
    const auto [instance, object] = parts;
    if (instance == 0) continue;
    Match& of_instance = instances[instance];
    if (object == 0) continue;
    Match& of_object = found[object];
    of_object.on_instances += returns;
    if (returns > of_object.most) of_object.most = returns, of_object.instance = instance;
    const double either = counts.first.at(instance) + counts.second.at(object) - returns;
    const double iou = returns / either;
    if (iou <= 0.5) continue;
    of_instance.is_made = of_object.is_made = true;
    ++counts_of(instance).found;
    counts_of(instance).iou_sum += iou;
  }
  for (const auto& [instance, match] : instances) {
    if (!match.is_made) ++counts_of(instance).missed;
  }
  for (const auto& [object, match] : found) {
    const bool is_on_instances = 2 * match.on_instances > counts.second.at(object);
    if (!match.is_made && is_on_instances) ++counts_of(match.instance).false_objects;
  }
  return result;
}

}  // namespace terracut::object_measures
