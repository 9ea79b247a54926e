// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

/// Replaces the header that includes all of OpenCV, also under its names before version 4. Includes
/// the real functions that peers use, and replaces those that open windows by functions that do
/// nothing.
#include <opencv2/core/core_c.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace cv {
inline void imshow(const char*, const Mat&) {}
inline int waitKey(int) {
  return -1;
}
}  // namespace cv
