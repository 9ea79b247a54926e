// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/bag/bag.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zstd.h>

#include <random>

#include "firmware_io/bag/topic_choice.hpp"
#include "mcap_bytes.hpp"
#include "tests/support/scratch_folder.hpp"

namespace terracut::bag {
namespace {

using test::Compression;
using test::McapBytes;
using testing::ElementsAre;
using testing::HasSubstr;

/// The messages of all topics as texts, and the error that ended reading, if one did.
struct Read {
  std::vector<std::string> messages;
  std::string fault;
};

Read read_all(Bag& bag) {
  Read read;
  const std::vector<bool> all(bag.topics().size(), true);
  for (;;) {
    const auto found = bag.next(all);
    if (!found) read.fault = found.error().message;
    if (!found || !*found) return read;
    const auto bytes = (*found)->message.bytes;
    read.messages.emplace_back(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }
}

std::string zstd(std::string_view plain) {
  std::string packed(ZSTD_compressBound(plain.size()), '\0');
  packed.resize(ZSTD_compress(packed.data(), packed.size(), plain.data(), plain.size(), 1));
  return packed;
}

class BagTest : public test::InScratchFolder {
 protected:
  Read read(const std::string& name) const {
    auto bag = Bag::open(folder_ / name);
    if (!bag) return {{}, bag.error().message};
    return read_all(*bag);
  }
};

std::string three_messages(Compression compression) {
  return McapBytes(compression)
      .topic("/a", "x/msg/X")
      .message(0, "one")
      .message(0, "two")
      .chunk()
      .message(0, "three")
      .chunk()
      .finished();
}

TEST_F(BagTest, ReadsChunksOfEveryCompression) {
  for (const Compression compression :
       {Compression::kNone, Compression::kZstd, Compression::kLz4}) {
    write("a.mcap", three_messages(compression));
    const Read found = read("a.mcap");
    EXPECT_THAT(found.messages, ElementsAre("one", "two", "three"));
    EXPECT_EQ(found.fault, "");
  }
}

TEST_F(BagTest, ReadsFilesAndMessagesPackedByZstd) {
  write("a.mcap.zstd", zstd(three_messages(Compression::kNone)));
  EXPECT_THAT(read("a.mcap.zstd").messages, ElementsAre("one", "two", "three"));
  write("b.mcap", McapBytes().topic("/a", "x/msg/X").message(0, zstd("one")).chunk().finished());
  EXPECT_THAT(read("b.mcap").messages, ElementsAre("one"));
}

TEST_F(BagTest, ReadsZstdToItsEndAndSaysWhereThatIsMissing) {
  const std::string plain = three_messages(Compression::kNone);
  write("joined.mcap.zstd", zstd(plain.substr(0, 100)) + zstd(plain.substr(100)));
  EXPECT_THAT(read("joined.mcap.zstd").messages, ElementsAre("one", "two", "three"));
  const std::string packed = zstd(plain);
  write("cut.mcap.zstd", packed.substr(0, packed.size() - 1));
  EXPECT_NE(read("cut.mcap.zstd").fault, "");

  const auto with_message = [&](const std::string& message) {
    write("m.mcap", McapBytes().topic("/a", "x/msg/X").message(0, message).chunk().finished());
    return read("m.mcap");
  };
  EXPECT_THAT(with_message(zstd("o") + zstd("ne")).messages, ElementsAre("one"));
  const std::string one = zstd("one");
  EXPECT_NE(with_message(one.substr(0, one.size() - 1)).fault, "");
}

TEST_F(BagTest, ReadsTheFilesOfAFolderInTheOrderOfTheirNumbers) {
  for (const int i : {10, 9, 0}) {
    write("bag/drive_" + std::to_string(i) + ".mcap",
          McapBytes().topic("/a", "x/msg/X").message(0, std::to_string(i)).chunk().finished());
  }
  EXPECT_TRUE(is_bag(folder_ / "bag"));
  EXPECT_THAT(read("bag").messages, ElementsAre("0", "9", "10"));
  write("bag/other.mcap", three_messages(Compression::kNone));
  EXPECT_FALSE(is_bag(folder_ / "bag")) << "two recordings";
  write("bag/metadata.yaml", "");
  EXPECT_TRUE(is_bag(folder_ / "bag"));
}

TEST_F(BagTest, ReadsWhatAKilledRecorderLeft) {
  write("bag/drive_0.mcap", three_messages(Compression::kNone));
  write("bag/drive_1.mcap", "");
  const Read found = read("bag");
  EXPECT_THAT(found.messages, ElementsAre("one", "two", "three"));
  EXPECT_THAT(found.fault, HasSubstr("drive_1.mcap: is empty"));
}

TEST_F(BagTest, GoesBackToAnyMessage) {
  for (const Compression compression : {Compression::kNone, Compression::kZstd}) {
    write("a.mcap", three_messages(compression));
    auto bag = Bag::open(folder_ / "a.mcap");
    ASSERT_TRUE(bag);
    const std::vector<bool> all{true};
    std::vector<Bag::Position> positions;
    for (auto found = bag->next(all); found && *found; found = bag->next(all)) {
      positions.push_back((*found)->position);
    }
    ASSERT_EQ(positions.size(), 3U);
    for (const std::size_t i : {2U, 0U, 1U}) {
      ASSERT_TRUE(bag->seek(positions[i]));
      EXPECT_EQ(read_all(*bag).messages.size(), 3 - i);
    }
  }
}

TEST_F(BagTest, GivesAllWholeMessagesBeforeAFileBreaksOff) {
  const std::string whole = three_messages(Compression::kNone);
  const std::string data_end("\x0f\x04\0\0\0\0\0\0\0\0\0\0\0", 13);
  const std::size_t end_of_data = whole.rfind(data_end) + data_end.size();
  std::size_t most = 0;
  for (std::size_t bytes = kMcapMagic.size(); bytes + 40 < whole.size(); ++bytes) {
    write("a.mcap", whole.substr(0, bytes));
    const Read found = read("a.mcap");
    EXPECT_GE(found.messages.size(), most) << "of " << bytes << " bytes";
    most = std::max(most, found.messages.size());
    const bool lacks_data = bytes < end_of_data;
    EXPECT_THAT(found.fault, HasSubstr(lacks_data ? "a.mcap: breaks off at byte" : ""));
  }
  EXPECT_EQ(most, 3U);
}

TEST_F(BagTest, SaysThatAChunkIsNotWhatWasWritten) {
  std::string bytes = three_messages(Compression::kNone);
  bytes[bytes.find("three")] = 'T';
  write("a.mcap", bytes);
  const Read found = read("a.mcap");
  EXPECT_THAT(found.messages, ElementsAre("one", "two"));
  EXPECT_THAT(found.fault, HasSubstr("a chunk's checksum is wrong"));
}

TEST_F(BagTest, SaysWhatIsNoBag) {
  write("a.mcap", "no");
  EXPECT_FALSE(is_bag(folder_ / "a.mcap"));
  EXPECT_THAT(read("a.mcap").fault, HasSubstr("is neither MCAP nor an SQLite bag"));
  write("a.db3", std::string("SQLite format 3\0 and no more", 28));
  EXPECT_TRUE(is_bag(folder_ / "a.db3"));
  EXPECT_THAT(read("a.db3").fault, HasSubstr("a.db3: "));
}

TEST_F(BagTest, ReadsNoMoreThanThereIsOfAnyBytes) {
  std::minstd_rand random(1);
  const std::string whole = three_messages(Compression::kZstd);
  for (int i = 0; i < 2000; ++i) {
    std::string bytes = whole;
    for (int flips = 0; flips < 4; ++flips) {
      bytes[8 + random() % (bytes.size() - 8)] = static_cast<char>(random());
    }
    auto file = open_mcap(std::as_bytes(std::span(bytes)), "memory");
    if (!file) continue;
    const std::vector<bool> all((*file)->topics().size(), true);
    int messages = 0;
    for (auto next = (*file)->next(all); next && *next; next = (*file)->next(all)) ++messages;
    EXPECT_LE(messages, 1000);
  }
}

TEST_F(BagTest, ChoosesTheOnlyTopicWithTheContent) {
  write("a.mcap", McapBytes()
                      .topic("/tf", "tf2_msgs/msg/TFMessage")
                      .topic("/os/lidar_packets", "ouster_sensor_msgs/msg/PacketMsg")
                      .topic("/os/imu_packets", "ouster_sensor_msgs/msg/PacketMsg")
                      .topic("/points", "sensor_msgs/msg/PointCloud2")
                      .message(0, "x")
                      .chunk()
                      .finished());
  const auto bag = Bag::open(folder_ / "a.mcap");
  ASSERT_TRUE(bag);
  EXPECT_EQ(bag->topics()[choose_topic(*bag, "", Content::kPackets).value()].name,
            "/os/lidar_packets");
  EXPECT_EQ(bag->topics()[choose_topic(*bag, "", Content::kClouds).value()].name, "/points");
  EXPECT_THAT(choose_topic(*bag, "", Content::kEither).error().message,
              HasSubstr("choose one by --topic: /os/lidar_packets"));
  EXPECT_THAT(choose_topic(*bag, "/tf", Content::kEither).error().message,
              HasSubstr("--topic /tf: expected one of its topics"));
}

}  // namespace
}  // namespace terracut::bag
