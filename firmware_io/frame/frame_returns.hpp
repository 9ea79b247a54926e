// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

#include "firmware_io/frame/measured_returns.hpp"
#include "firmware_io/frame/range_image.hpp"

namespace terracut::frame {

/// The returns of a frame that is to be labelled: as measured, if they were decoded, and as an
/// image of points, if somebody needs all points or they come from a cloud. Refers to them.
class FrameReturns {
 public:
  // Implicit, because a frame of one form is passed as it is.
  FrameReturns(const MeasuredReturns& measured, const RangeImage* image = nullptr) noexcept
      : measured_(&measured), image_(image) {}
  FrameReturns(const RangeImage& image) noexcept : image_(&image) {}

  /// Returns the measured returns; null for a cloud.
  [[nodiscard]] const MeasuredReturns* measured() const noexcept { return measured_; }
  /// Returns the image of points; null if there is none.
  [[nodiscard]] const RangeImage* image() const noexcept { return image_; }

  [[nodiscard]] std::uint32_t returns() const noexcept {
    return measured_ != nullptr ? measured_->returns() : image_->returns();
  }
  /// Tells which frame it is while the frame arrives: its buffer, and how often that was cleared.
  struct Identity {
    const void* buffer = nullptr;
    std::uint32_t generation = 0;

    bool operator==(const Identity&) const = default;
  };
  [[nodiscard]] Identity identity() const noexcept {
    if (measured_ != nullptr) return {measured_, measured_->generation()};
    return {image_, image_->generation()};
  }

 private:
  const MeasuredReturns* measured_ = nullptr;
  const RangeImage* image_;
};

}  // namespace terracut::frame
