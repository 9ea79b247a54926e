// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "image_objects.hpp"

namespace terracut::objects {

void ImageObjects::find(const frame::RangeImage& image, std::span<const frame::Label> labels,
                        std::span<const float> heights_m) noexcept {
  const std::span<const std::uint32_t> return_index = image.return_index();
  for (std::size_t cell = 0; cell < planes_.label.size(); ++cell) {
    const bool is_there = image.has_return(cell);
    planes_.label[cell] = is_there ? labels[return_index[cell]] : frame::Label::kNone;
    planes_.height_m[cell] = is_there ? heights_m[return_index[cell]] : frame::kNoHeight_m;
  }
  finder_.find(image, planes_, labels);
}

}  // namespace terracut::objects
