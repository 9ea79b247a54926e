// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Any bytes at all: an error or a table that validates, never a crash or a hang.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "calib/hdl64e/hdl64e_xml.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(data, data + size);
  const auto parsed = terracut::hdl64e::parse_hdl64e_xml(text, "fuzz");
  if (parsed && !validate(*parsed)) std::abort();
  if (!parsed && parsed.error().message.find("fuzz") == std::string::npos) std::abort();
  return 0;
}
