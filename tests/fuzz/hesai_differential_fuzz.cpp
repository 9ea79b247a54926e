// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Hesai decoders beside the plain reference on packets that the input makes and bends: the same
// refusals, and the same frame, cell and place of every return.
#include "any_hesai.hpp"
#include "differential.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace terracut;
  fuzz::Input input({data, size});
  fuzz::with_any_hesai(input, [&]<class Model>(std::type_identity<Model>) {
    fuzz::Differential<reference::Hesai<Model>>(input).run();
  });
  return 0;
}
