// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/scan/ring_fit_of_scans.hpp"

#include <algorithm>
#include <utility>

#include "calib/hdl64e/nominal_hdl64e.hpp"

namespace terracut::scan {
namespace {

Expected<FittedRings> fit_once(std::size_t scans, const AddScan& add, const RingTable* table,
                               const RingTable* offsets) {
  RingTableFit fit;
  const Status read =
      read_some_scans(scans, [&](std::size_t index) { return add(index, table, fit); });
  if (!read) return tl::unexpected(read.error());
  return fit.fit(offsets);
}

}  // namespace

Status read_some_scans(std::size_t scans, const std::function<Status(std::size_t)>& read) {
  const std::size_t count = std::min(scans, kScansToFit);
  Error last{ErrorCode::kMalformed, ""};
  std::size_t used = 0;
  for (std::size_t i = 0; i < count; ++i) {
    // A scan that cannot be read is reported later, when its frame is processed. A scan that lacks
    // rings is aligned later with the table fitted to complete scans.
    if (const Status status = read(i * scans / count); status) {
      ++used;
    } else if (last.code != ErrorCode::kUnsupported) {
      last = status.error();
    }
  }
  if (used > 0) return {};
  return tl::unexpected(std::move(last));
}

Expected<FittedRings> fit_rings_of_scans(std::size_t scans, const AddScan& add) {
  auto fitted = fit_once(scans, add, nullptr, nullptr);
  if (fitted || fitted.error().code != ErrorCode::kUnsupported) return fitted;
  // No scan has all rings. A nominal unit's table is close enough to tell most lasers apart, and a
  // table fitted with its help is close enough to correct rings told apart wrongly.
  const RingTable nominal = ring_table(hdl64e::nominal_hdl64e());
  fitted = fit_once(scans, add, &nominal, &nominal);
  if (!fitted) return fitted;
  const RingTable first = fitted->table;
  fitted = fit_once(scans, add, &first, &nominal);
  if (fitted) fitted->from_nominal_table = true;
  return fitted;
}

}  // namespace terracut::scan
