// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <utility>

#include "firmware_io/bag/bag_file.hpp"

namespace terracut::bag {

OpenedFile open_sqlite(const std::filesystem::path&, std::string name) {
  return fail(ErrorCode::kUnsupported,
              std::move(name) +
                  ": is an SQLite file, and this program was built without SQLite; install "
                  "libsqlite3-dev and build it again, or write the bag anew as MCAP (ros2 bag "
                  "convert)");
}

}  // namespace terracut::bag
