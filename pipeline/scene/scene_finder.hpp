// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "calib/mount/ring_profile.hpp"
#include "firmware_io/frame/label.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "pipeline/elevation/adjacent_points.hpp"
#include "pipeline/free_way/free_way.hpp"
#include "pipeline/objects/object_finder.hpp"
#include "pipeline/scene/wanted.hpp"
#include "pipeline/stage/cell_planes.hpp"
#include "pipeline/visibility/sight_watch.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::scene {

/// Finds what is wanted in images whose labels and heights are known by return, not by cell. What
/// is not wanted costs nothing and is empty.
///
/// All memory is taken in the constructor; find() does not allocate, lock, throw or look at a
/// clock. The same image gives the same scene on every machine. One thread at a time.
class SceneFinder {
 public:
  /// `profile` must have shape.rows rings. `return_capacity` is the most returns of an image.
  SceneFinder(Wanted wanted, const mount::RingProfile& profile, frame::ImageShape shape,
              std::size_t return_capacity, memory::FixedMemory& memory);

  /// Looks at an image of the shape given at construction. Objects are found where its returns lie,
  /// the free way and the view where they were measured: `as_measured` has the same returns, and is
  /// the same image unless they were moved (deskewed). `labels` and `heights_m`, above the ground,
  /// have one element per return, by return index. `is_whole` is visibility::SightWatch::is_whole()
  /// of a turn. Overwrites the last result. Real-time safe.
  void find(const frame::RangeImage& image, const frame::RangeImage& as_measured,
            std::span<const frame::Label> labels, std::span<const float> heights_m,
            bool is_whole = true) noexcept TERRACUT_NONBLOCKING;
  /// Looks at an image whose returns were not moved.
  void find(const frame::RangeImage& image, std::span<const frame::Label> labels,
            std::span<const float> heights_m, bool is_whole = true) noexcept TERRACUT_NONBLOCKING {
    find(image, image, labels, heights_m, is_whole);
  }

  /// As of objects::ObjectFinder.
  [[nodiscard]] std::span<const objects::Object> objects() const noexcept {
    return objects_ ? objects_->objects() : std::span<const objects::Object>();
  }
  [[nodiscard]] std::span<const std::uint16_t> object_of_return() const noexcept {
    return objects_ ? objects_->object_of_return() : std::span<const std::uint16_t>();
  }
  /// As of free_way::FreeWay.
  [[nodiscard]] std::span<const free_way::Sector> free_way() const noexcept {
    return free_way_ ? free_way_->way.sectors() : std::span<const free_way::Sector>();
  }

  /// Returns how far the sensor sees, by the turns so far; is_watched is 0 if it is not wanted.
  [[nodiscard]] visibility::SightFigures sight() const noexcept {
    return sight_ ? sight_->figures() : visibility::SightFigures();
  }

 private:
  /// The free way, and what finds the steep steps that it asks for.
  struct Way {
    Way(const mount::RingProfile& profile, frame::ImageShape shape, memory::FixedMemory& memory);
    elevation::AdjacentPoints steps;
    free_way::FreeWay way;
  };

  /// Lays labels and heights into the cells.
  void take(const frame::RangeImage& image, std::span<const frame::Label> labels,
            std::span<const float> heights_m) noexcept;
  void find_steep(const frame::RangeImage& image) noexcept;

  stage::CellPlanes planes_;
  std::optional<objects::ObjectFinder> objects_;
  std::optional<Way> free_way_;
  std::optional<visibility::SightWatch> sight_;
};

}  // namespace terracut::scene
