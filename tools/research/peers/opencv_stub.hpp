// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

/// Replaces the header of all of OpenCV, and its names before version 4. The functions that peers
/// use are the real ones; windows, which are closed during measurements, are missing.
#include <opencv2/core/core_c.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace cv {
inline void imshow(const char*, const Mat&) {}
inline int waitKey(int) {
  return -1;
}
}  // namespace cv
