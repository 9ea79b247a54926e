// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "calib/mount/ring_profile.hpp"
#include "firmware_io/frame/label.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "pipeline/objects/clusters.hpp"
#include "pipeline/objects/footprint.hpp"
#include "pipeline/objects/nearby_clusters.hpp"
#include "pipeline/objects/object.hpp"
#include "pipeline/objects/parts.hpp"
#include "pipeline/objects/reach.hpp"
#include "pipeline/stage/cell_planes.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::objects {

/// Makes objects of the obstacle returns of a labelled image, coarse to fine like the ground:
/// neighbouring cells of bodies within reach become clusters (Clusters), small ones join what is
/// around them (NearbyClusters), and low returns go to the body that they lie under. So what grows
/// on the ground joins nothing, and belongs to no object.
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
    float low_m = 0.25F;   ///< Returns lower than this above the ground are feet, others bodies.
    float least_m = 0.1F;  ///< Feet lower than this belong to no body: they may well be ground.
    NearbyClusters::Config nearby;
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
  /// Returns how many cells are in no cluster because they are more scattered than there is memory
  /// for: in runs of fewer than two cells on average.
  [[nodiscard]] std::uint32_t cells_left_out() const noexcept { return clusters_.cells_left_out(); }

 private:
  /// Makes objects of clusters that belong together.
  void number() noexcept;
  void measure(const frame::RangeImage& image) noexcept;
  /// Gives feet to the body above them, row by row from the top.
  void take_feet(const frame::RangeImage& image, std::span<const float> height_m) noexcept;
  /// Gives returns that do not own their cell the object of the cell, if near, or of the nearest
  /// cell around.
  void take_overflow(const frame::RangeImage& image, std::span<const frame::Label> cell_labels,
                     std::span<const frame::Label> labels) noexcept;
  [[nodiscard]] std::uint16_t object_near(const frame::RangeImage& image,
                                          std::span<const frame::Label> cell_labels,
                                          const frame::OverflowReturn& extra) const noexcept;

  Config config_;
  frame::ImageShape shape_;
  Reach reach_;
  Parts parts_;
  Clusters clusters_;
  NearbyClusters nearby_;
  std::span<std::uint16_t> object_of_cluster_, object_of_cell_, object_of_return_;  // 0: none
  std::span<Outermost> outermost_;
  std::span<Object> objects_;
  std::size_t count_ = 0, returns_ = 0;
  std::uint32_t left_out_ = 0;
};

}  // namespace terracut::objects
