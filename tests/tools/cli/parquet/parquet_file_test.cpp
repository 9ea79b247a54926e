// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/parquet/parquet_file.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <string>

#include "tests/support/scratch_folder.hpp"
#include "tools/cli/parquet/column_encoding.hpp"

namespace terracut::cli {
namespace {

namespace fs = std::filesystem;
using namespace std::string_literals;

/// Reads DELTA_BINARY_PACKED by its description: blocks of what the header says, value by value.
class DeltaReader {
 public:
  explicit DeltaReader(const std::string& bytes) : bytes_(bytes) {}

  std::vector<std::int64_t> read() {
    const std::uint64_t block = varint(), minis = varint(), count = varint();
    std::int64_t value = zigzag();
    std::vector<std::int64_t> values;
    if (count > 0) values.push_back(value);
    while (values.size() < count) {
      const std::int64_t least = zigzag();
      const std::string widths = bytes_.substr(at_, minis);
      at_ += minis;
      for (std::size_t mini = 0; mini < minis && values.size() < count; ++mini) {
        const int width = widths[mini];
        for (std::size_t i = 0; i < block / minis; ++i) {
          const std::int64_t above = bits(i * static_cast<std::size_t>(width), width);
          if (values.size() < count) values.push_back(value += least + above);
        }
        at_ += block / minis * static_cast<std::size_t>(width) / 8;
      }
    }
    return values;
  }
  [[nodiscard]] bool at_end() const { return at_ == bytes_.size(); }

 private:
  std::uint64_t varint() {
    std::uint64_t value = 0;
    for (int shift = 0;; shift += 7) {
      const auto byte = static_cast<unsigned char>(bytes_.at(at_++));
      value |= std::uint64_t{byte & 0x7FU} << shift;
      if (byte < 0x80) return value;
    }
  }
  std::int64_t zigzag() {
    const std::uint64_t value = varint();
    return static_cast<std::int64_t>(value >> 1) ^ -static_cast<std::int64_t>(value & 1);
  }
  std::int64_t bits(std::size_t from, int width) const {
    std::int64_t value = 0;
    for (int i = 0; i < width; ++i) {
      const std::size_t bit = from + static_cast<std::size_t>(i);
      const auto byte = static_cast<unsigned char>(bytes_.at(at_ + bit / 8));
      value |= std::int64_t{byte >> (bit % 8) & 1} << i;
    }
    return value;
  }

  const std::string& bytes_;
  std::size_t at_ = 0;
};

TEST(ColumnEncoding, DeltasAreReadBackByTheirDescription) {
  std::mt19937 random(3);
  for (const std::size_t count : {0U, 1U, 2U, 32U, 33U, 128U, 129U, 130U, 257U, 5000U}) {
    for (const std::int64_t spread : {0LL, 1LL, 100LL, 4294967295LL}) {
      std::vector<std::int32_t> values(count);
      std::uniform_int_distribution<std::int64_t> any(-spread / 2, spread / 2);
      for (auto& value : values) value = static_cast<std::int32_t>(any(random));
      const std::string bytes = delta_binary_packed(values);
      DeltaReader reader(bytes);
      EXPECT_EQ(reader.read(), std::vector<std::int64_t>(values.begin(), values.end()))
          << count << " values over " << spread;
      EXPECT_TRUE(reader.at_end());
    }
  }
}

TEST(ColumnEncoding, CountersTakeNextToNothing) {
  std::vector<std::int32_t> values(128'000);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<std::int32_t>(i);
  EXPECT_LT(delta_binary_packed(values).size(), 6000U);
}

TEST(ColumnEncoding, FloatsAreSplitByTheWeightOfTheirBytes) {
  // The example of parquet-format's Encodings.md, whose bytes are AABBCCDD 00112233 A3B4C5D6.
  const std::string lying = "\xAA\xBB\xCC\xDD\x00\x11\x22\x33\xA3\xB4\xC5\xD6"s;
  std::array<float, 3> values{};
  std::memcpy(values.data(), lying.data(), lying.size());
  EXPECT_EQ(byte_stream_split(values), "\xAA\x00\xA3\xBB\x11\xB4\xCC\x22\xC5\xDD\x33\xD6"s);
}

class ParquetFileTest : public testing::Test {
 protected:
  void SetUp() override { folder_ = test::make_scratch_folder(); }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] Status add(ParquetFile& file) const {
    const std::array<ParquetValues, 2> values{std::span<const std::int32_t>(counts_),
                                              std::span<const float>(lengths_m_)};
    return file.add_row_group(values);
  }
  [[nodiscard]] static std::vector<ParquetColumn> columns() {
    return {{"count", ParquetColumn::Kind::kUint8}, {"length", ParquetColumn::Kind::kFloat}};
  }

  fs::path folder_;
  std::vector<std::int32_t> counts_{1, 2, 3};
  std::vector<float> lengths_m_{1, 2, 3};
};

TEST_F(ParquetFileTest, HasItsNameOnceItIsComplete) {
  const fs::path path = folder_ / "sub/a.parquet";
  auto file = ParquetFile::create(path, columns());
  ASSERT_TRUE(file) << file.error().message;
  ASSERT_TRUE(add(*file));
  EXPECT_FALSE(fs::exists(path));
  ASSERT_TRUE(file->close({{"key", "value"}}, "a test"));
  std::ifstream stream(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_TRUE(bytes.starts_with("PAR1"));
  EXPECT_TRUE(bytes.ends_with("PAR1"));
  EXPECT_EQ(std::distance(fs::directory_iterator(path.parent_path()), {}), 1);
}

TEST_F(ParquetFileTest, LeavesNothingWithoutBeingClosed) {
  {
    auto file = ParquetFile::create(folder_ / "a.parquet", columns());
    ASSERT_TRUE(file && add(*file));
  }
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(ParquetFileTest, SaysThatItCannotBeWritten) {
  std::ofstream(folder_ / "file") << "no folder";
  const auto file = ParquetFile::create(folder_ / "file/a.parquet", columns());
  ASSERT_FALSE(file);
  EXPECT_EQ(file.error().code, ErrorCode::kWriteFailed);
}

TEST_F(ParquetFileTest, SaysNoLeastAndGreatestWhereOneIsNoNumber) {
  const auto size_with = [&](float last) {
    lengths_m_.back() = last;
    auto file = ParquetFile::create(folder_ / "a.parquet", columns());
    EXPECT_TRUE(file && add(*file) && file->close({}, "a test"));
    return fs::file_size(folder_ / "a.parquet");
  };
  const auto with_both = size_with(3);
  // Two values of four bytes, each with its length and its field.
  EXPECT_EQ(size_with(std::numeric_limits<float>::quiet_NaN()), with_both - 12);
}

}  // namespace
}  // namespace terracut::cli
