// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Any bytes at all, and a good file with any bytes over it: first where to write (two bytes) and
// how much (one), then what. The outcome is an error that names the file in printable words, or a
// table that validates and survives being written and read.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "calib/hesai/hesai_csv.hpp"

namespace {

using namespace terracut;

void check(bool holds) {
  if (!holds) std::abort();
}

void check_text(const std::string& text) {
  const auto parsed = hesai::parse_hesai_csv(text, "fuzz");
  if (!parsed) {
    const std::string& message = parsed.error().message;
    check(message.find("fuzz") != std::string::npos);
    check(std::all_of(message.begin(), message.end(), [](char c) { return c >= ' ' && c <= '~'; }));
    return;
  }
  check(validate(*parsed).has_value());
  const std::string written = hesai::hesai_csv_text(*parsed);
  const auto again = hesai::parse_hesai_csv(written, "again");
  check(again.has_value() && fingerprint(*again) == fingerprint(*parsed));
  check(hesai::hesai_csv_text(*again) == written);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  check_text(std::string(data, data + size));
  std::string text = hesai::hesai_csv_text(beams::built_in_table(sensor::SensorModel::kPandar40p));
  for (std::size_t i = 0; i + 3 <= size;) {
    const std::size_t at = (data[i] * std::size_t{256} + data[i + 1]) % text.size();
    const std::size_t count = std::min({std::size_t{data[i + 2]}, size - i - 3, text.size() - at});
    std::copy_n(data + i + 3, count, text.begin() + static_cast<std::ptrdiff_t>(at));
    i += 3 + count;
  }
  check_text(text);
  return 0;
}
