// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

#include "calib/hdl64e_calibration.hpp"
#include "firmware_io/hdl64e/firing_azimuth.hpp"
#include "firmware_io/labelled_return.hpp"
#include "rt/error.hpp"

namespace terracut::firmware_io {

/// What a drive holds.
struct DriveSummary {
  std::uint64_t frames = 0;   ///< Turns with at least one return = truth files.
  std::uint64_t returns = 0;  ///< = entries of all truth files.
  std::uint64_t columns = 0;  ///< Firings, those that fill up the last packet included.
  std::uint64_t packets = 0;
};

/// Writes a labelled HDL-64E drive: three things that belong together.
///
///   drive.pcap                data packets on UDP port 2368, the calibration in their status bytes
///   drive.calibration.xml     the unit's table (db.xml)
///   drive.truth/NNNNNN.label  one little-endian uint32 per return, turn by turn, in order of
///                             arrival (packet, block, laser), SemanticKITTI ids
///
/// The n-th entry of NNNNNN.label is the n-th return that the decoder places into its frame NNNNNN
/// (RangeImage::return_index()). A turn without a single return is no frame, on either side. Turns
/// are those of the beams, not of the head: lasers point up to 10 degrees before or behind the
/// head, so start about 11 degrees before a seam and end about 11 degrees after one, and leave
/// returns of turns that are not wanted out (raw = 0).
///
/// Everything is written under temporary names and appears, whole, at finish(); a DriveWriter that
/// goes without it leaves nothing behind. File work: not real-time safe. One thread.
class DriveWriter {
 public:
  /// `pcap_path` is "<folder>/<name>.pcap"; the other two names follow from it. An existing
  /// capture, calibration and truth folder of that name are replaced at finish(); a truth folder
  /// that holds anything but NNNNNN.label files is refused here.
  [[nodiscard]] static Expected<DriveWriter> create(const std::filesystem::path& pcap_path,
                                                    const calib::Hdl64eCalibration& calibration,
                                                    AzimuthAt azimuth_at = AzimuthAt::kFiring);

  DriveWriter(DriveWriter&&) noexcept;
  DriveWriter& operator=(DriveWriter&&) noexcept;
  ~DriveWriter();

  /// The next firing of all lasers; `stamp_ns` is that of its first laser. Firings must be those of
  /// a turning head: stamps at least 1 us apart; inside a packet (the 1st to 6th, 7th to 12th, ...
  /// of these calls) the head turns on by [0.02, 1.0] degrees from one to the next. Between packets
  /// it may leave a gap of up to 0.9 s, if speed and stamps agree with the azimuths to 15 degrees.
  /// Errors: kInvalidArgument naming the firing and what it broke, kWriteFailed.
  [[nodiscard]] Status add_column(std::int64_t stamp_ns, std::int64_t unwrapped_azimuth_cdeg,
                                  std::span<const LabelledReturn, calib::kHdl64eLasers> by_laser);

  /// Fills up the last packet with empty firings and puts all files in their places.
  [[nodiscard]] Expected<DriveSummary> finish();

 private:
  class Impl;
  explicit DriveWriter(std::unique_ptr<Impl> impl) noexcept;
  std::unique_ptr<Impl> impl_;
};

/// The names a drive's parts have beside "<folder>/<name>.pcap".
[[nodiscard]] std::filesystem::path calibration_path_of(const std::filesystem::path& pcap_path);
[[nodiscard]] std::filesystem::path truth_folder_of(const std::filesystem::path& pcap_path);

}  // namespace terracut::firmware_io
