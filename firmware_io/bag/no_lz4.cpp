// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/bag/unpacked.hpp"

namespace terracut::bag {

Status unpack_lz4(std::span<const std::byte>, std::vector<std::byte>&) {
  return fail(ErrorCode::kUnsupported,
              "it is compressed by lz4, which this program was built without; install liblz4-dev "
              "and build it again, or write the bag anew with zstd (mcap compress)");
}

}  // namespace terracut::bag
