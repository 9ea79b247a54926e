// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Tables of an RS-Ruby128 as files; what the input bends, and what must hold: csv_table.hpp.
#include "calib/ruby128/nominal_ruby128.hpp"
#include "calib/ruby128/ruby128_csv.hpp"
#include "csv_table.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace terracut;
  fuzz::check_csv(
      data, size, ruby128::nominal_ruby128(),
      [](const auto&... text) { return ruby128::parse_ruby128_csv(text...); },
      [](const auto& table) { return ruby128::ruby128_csv_text(table); });
  return 0;
}
