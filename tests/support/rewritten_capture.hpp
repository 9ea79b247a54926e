// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>

#include "firmware_io/capture/capture_source.hpp"
#include "firmware_io/capture/pcap_writer.hpp"

namespace terracut::test {

/// Writes another capture of a capture's datagrams: `each(datagram, number, write)` is called for
/// each of them and calls write(datagram) for what is to be in it. Returns how many there were.
template <class Each>
std::size_t rewrite_capture(const std::filesystem::path& from, const std::filesystem::path& to,
                            const Each& each) {
  auto source = capture::CaptureSource::open(from);
  auto writer = capture::PcapWriter::create(to);
  EXPECT_TRUE(source && writer) << from << " " << to;
  const auto write = [&](const packet::Datagram& datagram) {
    EXPECT_TRUE(writer->write(datagram));
  };
  std::size_t number = 0;
  for (auto next = source->next(); next && *next; next = source->next()) {
    each(packet::Datagram(**next), number++, write);
  }
  EXPECT_TRUE(writer->finish());
  return number;
}

}  // namespace terracut::test
