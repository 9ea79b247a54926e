// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "calib/mount/ring_profile.hpp"
#include "firmware_io/frame/label.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "pipeline/min_cut/cut_report.hpp"
#include "pipeline/objects/clusters.hpp"
#include "pipeline/objects/foot_cut.hpp"
#include "pipeline/objects/footprint.hpp"
#include "pipeline/objects/object.hpp"
#include "pipeline/objects/parts.hpp"
#include "pipeline/stage/cell_planes.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::objects {

/// Makes objects of the obstacle returns of a labelled image, coarse to fine like the ground: an
/// exact minimum cut divides low returns into bodies and what grows at their feet (FootCut);
/// neighbouring cells within reach become clusters, and small ones join what is around them
/// (Clusters). Clusters of bodies are objects; so is something low by itself (a person who lies on
/// the road), but not the feet of bodies, which belong to no object.
///
/// All memory is taken in the constructor; find() does not allocate, lock, throw or look at a
/// clock. The same image gives the same objects on every machine. One thread at a time.
class ObjectFinder {
 public:
  /// A street frame has some 100; clusters beyond are counted in left_out().
  static constexpr std::size_t kMostObjects = 2048;

  struct Config {
    /// Neighbours that far apart belong together: less than two persons side by side keep between
    /// them, more than rows and columns lie apart on a car's side 30 m away.
    float gap_m = 0.5F;
    std::uint32_t fewest_returns = 10;  ///< Clusters with fewer returns are no objects.
    float least_top_m = 0.20F;  ///< Something low by itself is an object from this height on.
    FootCut::Config foot;
    Clusters::Config clusters;
  };

  /// `profile` must have shape.rows rings. `return_capacity` is the most returns of an image.
  ObjectFinder(const Config& config, const mount::RingProfile& profile, frame::ImageShape shape,
               std::size_t return_capacity, memory::FixedMemory& memory);

  /// Finds the objects of an image of the shape given at construction. `planes` has the label of
  /// each cell and its height above the ground, `labels` the label of each return, by return index.
  /// Overwrites the last result. Real-time safe.
  void find(const frame::RangeImage& image, const stage::CellPlanes& planes,
            std::span<const frame::Label> labels) noexcept TERRACUT_NONBLOCKING;

  /// Returns the objects in order of their lowest cells; object i has the number i + 1.
  [[nodiscard]] std::span<const Object> objects() const noexcept { return objects_.first(count_); }
  /// Returns the number of each return's object, by return index; 0: none.
  [[nodiscard]] std::span<const std::uint16_t> object_of_return() const noexcept {
    return object_of_return_.first(returns_);
  }
  /// Returns how many clusters are no objects because there were kMostObjects before them.
  [[nodiscard]] std::uint32_t left_out() const noexcept { return left_out_; }
  /// Returns how far the minimum cut got.
  [[nodiscard]] const min_cut::CutReport& cut() const noexcept { return foot_cut_.report(); }

 private:
  void number() noexcept;
  void measure(const frame::RangeImage& image) noexcept;
  /// Gives returns that do not own their cell the object of the nearest cell around.
  void take_overflow(const frame::RangeImage& image, std::span<const Part> parts,
                     std::span<const frame::Label> labels) noexcept;
  [[nodiscard]] std::uint16_t object_near(const frame::RangeImage& image,
                                          const frame::OverflowReturn& extra,
                                          std::span<const Part> parts) const noexcept;

  Config config_;
  frame::ImageShape shape_;
  Reach reach_;
  FootCut foot_cut_;
  Clusters clusters_;
  std::span<std::uint16_t> object_of_cluster_;  // by the first run of a cluster; 0: none
  std::span<Outermost> outermost_;
  std::span<Object> objects_;
  std::span<std::uint16_t> object_of_return_;
  std::size_t count_ = 0, returns_ = 0;
  std::uint32_t left_out_ = 0;
};

}  // namespace terracut::objects
