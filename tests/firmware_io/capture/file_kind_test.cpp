// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/capture/file_kind.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace terracut::capture {
namespace {

std::vector<std::uint8_t> bytes_of(const std::string& text) {
  return {text.begin(), text.end()};
}

TEST(CaptureName, IsKnownWhateverWritesIt) {
  EXPECT_EQ(capture_stem("drive.pcap"), "drive");
  EXPECT_EQ(capture_stem("DRIVE.PcapNG"), "DRIVE");
  EXPECT_EQ(capture_stem("drive.cap"), "drive");
  EXPECT_EQ(capture_stem("drive.pcap12"), "drive");
  EXPECT_EQ(capture_stem("drive_00001.pcap.3"), "drive_00001");
  EXPECT_EQ(capture_stem("drive.pcap-20261103"), "drive");
  for (const char* const name : {"", "1", ".pcap", "pcap", "drive", "drive.pcap.gz", "drive.pcapx",
                                 "drive.escape", "drive.calibration.xml", "000000.bin"}) {
    EXPECT_EQ(capture_stem(name), "") << name;
  }
}

TEST(FirstBytes, TellACapture) {
  for (const char* const start : {"\xa1\xb2\xc3\xd4", "\xd4\xc3\xb2\xa1", "\xa1\xb2\x3c\x4d",
                                  "\x4d\x3c\xb2\xa1", "\xa1\xb2\xcd\x34", "\x34\xcd\xb2\xa1"}) {
    EXPECT_TRUE(begins_as_capture(bytes_of(start)));
  }
  EXPECT_TRUE(begins_as_capture(bytes_of("\x0a\x0d\x0d\x0a 4B \x1a\x2b\x3c\x4d")));
  EXPECT_TRUE(begins_as_capture(bytes_of("\x0a\x0d\x0d\x0a 4B \x4d\x3c\x2b\x1a")));
  for (const char* const start :
       {"", "\xd4\xc3\xb2", "\x0a\x0d\x0d\x0a", "\x0a\x0d\x0d\x0a text", "\x1f\x8b\x08"}) {
    EXPECT_FALSE(begins_as_capture(bytes_of(start)));
  }
}

TEST(FirstBytes, TellARecordingThatIsNotReadHere) {
  EXPECT_TRUE(foreign_kind(bytes_of("\x1f\x8b\x08"))->is_packed);
  EXPECT_FALSE(foreign_kind(bytes_of("#ROSBAG V2.0"))->is_packed);
  EXPECT_FALSE(foreign_kind(bytes_of("\x89PNG")));
  EXPECT_FALSE(foreign_kind(bytes_of("some text")));
}

}  // namespace
}  // namespace terracut::capture
