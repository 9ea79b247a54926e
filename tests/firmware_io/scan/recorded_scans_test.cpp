// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Behaviour on the labelled scans beside the repository (shared/data/semantickitti).
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "recorded_sequences.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tools/lab/encode/recorded_spin.hpp"
#include "tools/lab/encode/scan_encoder.hpp"
#include "tools/lab/encode/scan_reader.hpp"

namespace terracut::scan {
namespace {

encode::ScanReader reader_of(const std::filesystem::path& sequence, bool undo) {
  auto reader = encode::ScanReader::open(
      sequence, undo ? encode::PutMotionBack::kWhereKnown : encode::PutMotionBack::kNever);
  EXPECT_TRUE(reader) << reader.error().message;
  EXPECT_EQ(reader->why_as_recorded().empty(), undo);
  return std::move(*reader);
}

TEST(RecordedScans, HaveSixtyFourRingsEachByTheOrderOfTheFile) {
  TERRACUT_RECORDED_SEQUENCES(sequences);
  std::size_t scans = 0;
  for (const auto& sequence : sequences) {
    const encode::ScanReader reader = reader_of(sequence, false);
    KittiScan scan;
    RingRecovery rings;
    for (std::size_t i = 0; i < reader.size(); ++i, ++scans) {
      const Status status = reader.read(i, scan, rings);
      ASSERT_TRUE(status) << status.error().message;
      EXPECT_EQ(rings.rings, 64) << reader.file(i).points;
      EXPECT_EQ(rings.no_ring, 0U);
      EXPECT_EQ(scan.labels.size(), scan.points.size());
    }
  }
  EXPECT_GE(scans, 18U);
}

TEST(RecordedScans, KeepTheirRingsWhenOnesAreMissing) {
  TERRACUT_RECORDED_SEQUENCES(sequences);
  for (const auto& sequence : sequences) {
    encode::ScanReader reader = reader_of(sequence, false);
    const auto fitted = reader.fit_rings();
    ASSERT_TRUE(fitted);
    KittiScan scan;
    RingRecovery whole;
    ASSERT_TRUE(reader.read(0, scan, whole));
    std::vector<ScanPoint> points;
    std::vector<std::int16_t> truth;
    for (std::size_t i = 0; i < scan.points.size(); ++i) {
      const int ring = whole.ring_of_point[i];
      if (ring == 0 || ring == 13 || ring == 40 || ring == 62) continue;
      points.push_back(scan.points[i]);
      truth.push_back(whole.ring_of_point[i]);
    }
    RingRecovery aligned;
    ASSERT_TRUE(recover_rings(points, &fitted->table, aligned));
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const int off = std::abs(aligned.ring_of_point[i] - truth[i]);
      EXPECT_LE(off, 1);
      wrong += off != 0 ? 1U : 0U;
    }
    // Near rings of a moving scan lie half a degree apart, and compensation moved them by more.
    EXPECT_LE(wrong * 33, truth.size()) << sequence << ": " << wrong << " points in the next ring";
  }
}

TEST(RecordedScans, KeepTheirRingsWhenANullPointEndsThem) {
  TERRACUT_RECORDED_SEQUENCES(sequences);
  for (const auto& sequence : sequences) {
    KittiScan scan;
    RingRecovery whole, with_null;
    ASSERT_TRUE(reader_of(sequence, false).read(0, scan, whole));
    scan.points.push_back({});
    ASSERT_TRUE(recover_rings(scan.points, nullptr, with_null));
    EXPECT_EQ(with_null.no_ring, 1U);
    whole.ring_of_point.push_back(kNoRing);
    EXPECT_EQ(with_null.ring_of_point, whole.ring_of_point) << sequence;
  }
}

/// Shares of the points of each ring of `truth` that lie in the ring most of them lie in, and
/// whether these go down the rows one by one.
struct RowsKept {
  double share = 0;
  bool in_order = true;
};
RowsKept rows_kept(const std::vector<std::int16_t>& truth, const std::vector<std::int16_t>& found) {
  std::array<std::array<std::size_t, kScanRings>, kScanRings> counts{};
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (found[i] == kNoRing) continue;
    ++counts[static_cast<std::size_t>(truth[i])][static_cast<std::size_t>(found[i])];
  }
  RowsKept kept;
  std::size_t in_main = 0;
  std::ptrdiff_t last = -1;
  for (const auto& of_ring : counts) {
    const auto main = std::max_element(of_ring.begin(), of_ring.end());
    if (*main == 0) continue;
    in_main += *main;
    kept.in_order = kept.in_order && main - of_ring.begin() > last;
    last = main - of_ring.begin();
  }
  kept.share = static_cast<double>(in_main) / static_cast<double>(truth.size());
  return kept;
}

TEST(RecordedScans, KeepARowForEachRingInACameraViewOfThem) {
  TERRACUT_RECORDED_SEQUENCES(sequences);
  for (const auto& sequence : sequences) {
    const test::ScratchFolder folder;
    KittiScan scan;
    RingRecovery whole;
    ASSERT_TRUE(reader_of(sequence, false).read(0, scan, whole));
    std::vector<ScanPoint> points;
    std::vector<std::int16_t> truth;
    for (std::size_t i = 0; i < scan.points.size(); ++i) {  // 16 rings see nothing but the sky
      const ScanPoint& p = scan.points[i];
      if (whole.ring_of_point[i] < 16 || p.x_m < std::abs(p.y_m)) continue;
      points.push_back(p);
      truth.push_back(whole.ring_of_point[i]);
    }
    folder.write_records("000000.bin", points);
    encode::ScanReader reader = reader_of(folder.path(), false);
    const auto fitted = reader.fit_rings();
    ASSERT_TRUE(fitted) << sequence << ": " << fitted.error().message;
    RingRecovery found;
    ASSERT_TRUE(reader.read(0, scan, found));
    const RowsKept kept = rows_kept(truth, found.ring_of_point);
    EXPECT_GT(kept.share, 0.99) << sequence;
    EXPECT_TRUE(kept.in_order) << sequence;
  }
}

TEST(RecordedScans, FitOneUnitsTableWithinTheMeasuredResidual) {
  TERRACUT_RECORDED_SEQUENCES(sequences);
  for (const auto& sequence : sequences) {
    const auto fitted = reader_of(sequence, false).fit_rings();
    ASSERT_TRUE(fitted);
    EXPECT_NEAR(beams::rad_to_deg(fitted->table.front().elevation_rad), 1.93, 0.1) << sequence;
    EXPECT_NEAR(beams::rad_to_deg(fitted->table.back().elevation_rad), -25.2, 1.5) << sequence;
    EXPECT_NEAR(fitted->table[10].vert_offset_m, 0.205, 0.01) << sequence;
    EXPECT_LT(fitted->residual.p95_m, 0.12) << sequence;
    EXPECT_TRUE(validate(hdl64e_calibration(fitted->table)));
  }
}

TEST(RecordedScans, FitToAboutACentimetreOnceTheMotionIsPutBack) {
  TERRACUT_RECORDED_SEQUENCES(sequences);
  for (const auto& sequence : sequences) {
    const auto fitted = reader_of(sequence, true).fit_rings();
    ASSERT_TRUE(fitted);
    EXPECT_NEAR(beams::rad_to_deg(fitted->table.back().elevation_rad), -25.2, 0.8) << sequence;
    EXPECT_NEAR(fitted->table[40].vert_offset_m, 0.122, 0.02) << sequence;
    EXPECT_LT(fitted->residual.p95_m, 0.025) << sequence;
  }
}

class RecordedScansEncoded : public testing::TestWithParam<bool> {};

TEST_P(RecordedScansEncoded, KeepRangeAzimuthAndNearlyAllPoints) {
  TERRACUT_RECORDED_SEQUENCES(sequences);
  for (const auto& sequence : sequences) {
    encode::ScanReader reader = reader_of(sequence, GetParam());
    const auto fitted = reader.fit_rings();
    ASSERT_TRUE(fitted);
    std::size_t returns = 0;
    KittiScan scan;
    RingRecovery rings;
    encode::RecordedSpin spin;
    for (std::size_t i = 0; i < reader.size(); ++i) {
      ASSERT_TRUE(reader.read(i, scan, rings));
      spin.add(rings.ring_of_point);
    }
    // As often as the recorder's clock says: a frame is 103.4 to 104.2 ms long.
    EXPECT_NEAR(spin.spin_hz(), 9.63, 0.06) << sequence;
    encode::ScanEncoder encoder(hdl64e_calibration(fitted->table),
                                {static_cast<std::int64_t>(reader.size()), spin.spin_hz(), 0},
                                [&](const encode::EncodedFiring& f) -> Status {
                                  for (const auto& beam : f.column.by_laser)
                                    returns += beam.raw != 0 ? 1U : 0U;
                                  return {};
                                });
    for (std::size_t i = 0; i < reader.size(); ++i) {
      ASSERT_TRUE(reader.read(i, scan, rings));
      ASSERT_TRUE(encoder.add_frame(scan.points, rings.ring_of_point, scan.labels));
    }
    const auto summary = encoder.finish();
    ASSERT_TRUE(summary);
    EXPECT_EQ(returns, summary->encoded);
    const double nearly_all = GetParam() ? 0.999 : 0.992;
    EXPECT_GE(static_cast<double>(summary->encoded),
              nearly_all * static_cast<double>(summary->points))
        << sequence;
    EXPECT_LE(summary->max_range_error_m, 0.003) << sequence;
    EXPECT_LE(summary->median_azimuth_shift_deg, 0.08) << sequence;
    EXPECT_LE(summary->max_azimuth_shift_deg,
              encode::ScanEncoder::kFarthest_steps * 360 / spin.firings() + 0.01)
        << sequence;
    EXPECT_LT(summary->height.p95_m, GetParam() ? 0.025 : 0.12) << sequence;
  }
}

INSTANTIATE_TEST_SUITE_P(Compensation, RecordedScansEncoded, testing::Bool(),
                         [](const auto& param) { return param.param ? "Undone" : "Kept"; });

}  // namespace
}  // namespace terracut::scan
