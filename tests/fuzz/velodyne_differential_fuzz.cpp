// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Velodyne decoders beside the plain reference on packets that the input makes and bends: the same
// refusals, and the same frame, cell and place of every return.
#include "differential.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace terracut;
  fuzz::Input input({data, size});
  switch (input.below(4)) {
    case 0:
      fuzz::Differential<reference::Vlp16>(input).run();
      break;
    case 1:
      fuzz::Differential<reference::Hdl32e>(input).run();
      break;
    case 2:
      fuzz::Differential<reference::Vlp32c>(input).run();
      break;
    default:
      fuzz::Differential<reference::Vls128>(input).run();
      break;
  }
  return 0;
}
