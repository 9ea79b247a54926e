// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/capture/fragment_joiner.hpp"

#include <algorithm>
#include <span>

namespace terracut::capture {
namespace {

bool are_of_one_packet(const packet::IpFragment& a, const packet::IpFragment& b) noexcept {
  return a.source_address == b.source_address && a.destination_address == b.destination_address &&
         a.vlan == b.vlan && a.id == b.id;
}

}  // namespace

std::optional<FragmentJoiner::Joined> FragmentJoiner::add(const packet::IpFragment& fragment) {
  const std::size_t end = fragment.at + fragment.payload.size();
  // All fragments but the last are of whole units.
  if (end > kMostBytes || fragment.payload.empty() ||
      (fragment.more && fragment.payload.size() % kUnitBytes != 0)) {
    return std::nullopt;
  }
  Open& open = open_of(fragment);
  const std::size_t fresh = mark(open, fragment.at, fragment.payload.size());
  if (fresh == 0) return std::nullopt;
  std::ranges::copy(fragment.payload,
                    open.bytes.begin() + static_cast<std::ptrdiff_t>(fragment.at));
  open.units += fresh;
  ++open.fragments;
  if (!fragment.more) open.total_bytes = end;
  const bool is_whole =
      open.total_bytes != 0 && open.units == (open.total_bytes + kUnitBytes - 1) / kUnitBytes;
  if (!is_whole) return std::nullopt;
  Joined joined{.whole = open.key, .fragments = open.fragments};
  joined.whole.at = 0;
  joined.whole.more = false;
  joined.whole.payload = std::span(open.bytes).first(open.total_bytes);
  open.fragments = open.units = 0;  // free; its bytes stay
  return joined;
}

void FragmentJoiner::clear() noexcept {
  for (Open& open : open_) open.fragments = open.units = 0;
}

FragmentJoiner::Open& FragmentJoiner::open_of(const packet::IpFragment& fragment) {
  const auto is_its_own = [&](const Open& open) {
    return open.fragments > 0 && are_of_one_packet(open.key, fragment);
  };
  if (const auto found = std::ranges::find_if(open_, is_its_own); found != open_.end()) {
    return *found;
  }
  const auto is_free = [](const Open& open) { return open.fragments == 0; };
  auto place = std::ranges::find_if(open_, is_free);
  if (place == open_.end() && open_.size() < kMostOpen) {
    open_.emplace_back().bytes.resize(kMostBytes);
    place = open_.end() - 1;
  } else if (place == open_.end()) {
    place = std::ranges::min_element(open_, {}, &Open::age);
  }
  place->key = fragment;
  place->has_unit.fill(0);
  place->units = place->total_bytes = 0;
  place->fragments = 0;
  place->age = ++age_;
  return *place;
}

std::size_t FragmentJoiner::mark(Open& open, std::size_t at, std::size_t bytes) noexcept {
  std::size_t fresh = 0;
  for (std::size_t unit = at / kUnitBytes; unit * kUnitBytes < at + bytes; ++unit) {
    std::uint64_t& word = open.has_unit[unit / 64];
    const std::uint64_t bit = std::uint64_t{1} << (unit % 64);
    fresh += (word & bit) == 0 ? 1U : 0U;
    word |= bit;
  }
  return fresh;
}

}  // namespace terracut::capture
