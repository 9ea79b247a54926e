// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <span>
#include <string_view>

#include "test_problem.hpp"

namespace terracut::test {

/// Problems without a street in sight, each hard for some solver: long paths, few terminals, ties.
/// All cells are unknown or seeds; one component spans most of the image.
struct AdversarialFamily {
  std::string_view name;
  TestProblem (*make)(frame::ImageShape shape);
};
std::span<const AdversarialFamily> adversarial_families();

/// A stand-in for a street frame of 64 x 2083: blobs of unknown cells between seeds, 8 % of the
/// cells, whose costs mostly agree with their neighbours'.
TestProblem typical_problem(frame::ImageShape shape, std::uint32_t seed);

}  // namespace terracut::test
