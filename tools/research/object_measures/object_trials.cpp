// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "object_trials.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "entropies.hpp"
#include "firmware_io/frame/each_return.hpp"
#include "pipeline/objects/object_finder.hpp"
#include "rt/measure/thread_cpu_clock.hpp"
#include "true_objects.hpp"

namespace terracut::object_measures {

void Spread::add(double value) noexcept {
  sum += value;
  sum_of_squares += value * value;
}

double Spread::mean(std::uint64_t of) const noexcept {
  return sum / static_cast<double>(of);
}

double Spread::deviation(std::uint64_t of) const noexcept {
  const double variance = sum_of_squares / static_cast<double>(of) - mean(of) * mean(of);
  return std::sqrt(std::max(variance, 0.0));
}

void ObjectTrials::look(const eval::LabelledByAll& frame) {
  std::vector<Place> places(frame.image.returns());
  frame::for_each_return(frame.image, [&](const frame::PlacedReturn& placed) {
    places[placed.return_index] = {placed.point.x_m, placed.point.y_m, placed.point.z_m};
  });
  const std::vector<std::uint32_t> truth = true_objects(places, frame.truth);
  memory::FixedMemory memory;
  objects::ObjectFinder finder({}, frame.profile, frame.image.shape(),
                               frame.image.return_capacity(), memory);
  for (std::size_t method = 0; method < counts_.size(); ++method) {
    std::int64_t shortest_ns = std::numeric_limits<std::int64_t>::max();
    for (int time = 0; time < 3; ++time) {
      const std::int64_t begun_ns = measure::thread_cpu_ns();
      finder.find(frame.image, frame.planes_of(method), frame.labels_of(method));
      shortest_ns = std::min(shortest_ns, measure::thread_cpu_ns() - begun_ns);
    }
    const std::vector<std::uint32_t> found(finder.object_of_return().begin(),
                                           finder.object_of_return().end());
    const Entropies differ = entropies(truth, found);
    const InstancesByKind instances = compare_instances(places, frame.truth, found);

    const std::scoped_lock lock(mutex_);
    SplitCounts& split = counts_[method];
    ObjectCounts& counts = is_tuned_on(frame.sequence) ? split.tuned : split.unseen;
    ++counts.frames;
    counts.objects.add(static_cast<double>(finder.objects().size()));
    counts.over_segmentation.add(differ.over_segmentation);
    counts.under_segmentation.add(differ.under_segmentation);
    counts.milliseconds.add(static_cast<double>(shortest_ns) * 1e-6);
    counts.instances += instances;
  }
}

}  // namespace terracut::object_measures
