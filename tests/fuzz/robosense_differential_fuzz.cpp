// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Decoders of RoboSenses with 32 lasers beside the plain reference on packets that the input makes
// and bends: the same refusals, and the same frame, cell and place of every return.
#include "any_robosense.hpp"
#include "differential.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace terracut;
  fuzz::Input input({data, size});
  fuzz::with_any_robosense(input, [&]<class Model>(std::type_identity<Model>) {
    fuzz::Differential<reference::RoboSense<Model>>(input).run();
  });
  return 0;
}
