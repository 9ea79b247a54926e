// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Stands in for libFuzzer in ordinary builds: feeds each file named on the command line to the
// target once, so that every fuzzer is compiled everywhere and a crashing input can be replayed.
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <iostream>
#include <iterator>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
/// Some targets have none.
extern "C" __attribute__((weak)) int LLVMFuzzerInitialize(int* argc, char*** argv);

int main(int argc, char** argv) {
  int (*initialize)(int*, char***) = LLVMFuzzerInitialize;
  if (initialize != nullptr && initialize(&argc, &argv) != 0) return 1;
  for (int i = 1; i < argc; ++i) {
    std::ifstream file(argv[i], std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
    const std::vector<std::uint8_t> input(bytes.begin(), bytes.end());
    LLVMFuzzerTestOneInput(input.data(), input.size());
    std::cout << "ran " << argv[i] << " (" << input.size() << " bytes)\n";
  }
  return 0;
}
