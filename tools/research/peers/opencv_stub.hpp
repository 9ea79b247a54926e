// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

/// In place of the header that brings all of OpenCV, and of its names before version 4: what peers
/// use of it is here, the real one. Windows, which they do not open when they are measured, are
/// not.
#include <opencv2/core/core_c.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace cv {
inline void imshow(const char*, const Mat&) {}
inline int waitKey(int) {
  return -1;
}
}  // namespace cv
