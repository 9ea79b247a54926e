// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <span>
#include <string_view>

#include "tests/pipeline/min_cut/test_problem.hpp"

namespace terracut::pipeline::test {

/// Problems without a street in sight, each hard for some solver: long paths, few terminals, ties.
/// All cells are unknown or seeds; one component spans most of the image.
struct AdversarialFamily {
  std::string_view name;
  TestProblem (*make)(ImageShape shape);
};
std::span<const AdversarialFamily> adversarial_families();

/// A stand-in for a street frame of 64 x 2083: blobs of unknown cells between seeds, 8 % of the
/// cells, whose costs mostly agree with their neighbours'.
TestProblem typical_problem(ImageShape shape, std::uint32_t seed);

}  // namespace terracut::pipeline::test
