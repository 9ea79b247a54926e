// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

#include "drive_files.hpp"
#include "encoder_traits.hpp"
#include "firmware_io/frame/labelled_return.hpp"
#include "rt/error.hpp"

namespace terracut::drive {

/// What a drive holds.
struct DriveSummary {
  std::uint64_t frames = 0;   ///< Frames with at least one return = truth files.
  std::uint64_t returns = 0;  ///< = entries of all truth files.
  std::uint64_t columns = 0;  ///< Those that fill up the last packets included.
  std::uint64_t packets = 0;  ///< Of data.
};

/// Writes a labelled drive of a sensor: three things that belong together.
///
///   drive.pcap                the sensor's packets, its calibration in them (HDL-64E: in the
///                             status bytes; RS-Ruby128: in a device packet every second)
///   drive.calibration.xml     the unit's table (HDL-64E: db.xml; RS-Ruby128: angle.csv, named
///                             drive.calibration.csv)
///   drive.truth/NNNNNN.label  one little-endian uint32 per return, frame by frame, in order of
///                             arrival (packet, block, laser), SemanticKITTI ids
///
/// The n-th entry of NNNNNN.label is the n-th return that the decoder places into its frame NNNNNN
/// (RangeImage::return_index()). A frame without a single return is no frame, on either side.
/// Frames are those of the beams, not of the head: lasers point up to 10 degrees before or behind
/// the head, so start about 11 degrees before a seam and end about 11 degrees after one, and leave
/// returns of frames that are not wanted out (raw = 0).
///
/// Everything is written under temporary names and appears, whole, at finish(); a DriveWriter that
/// goes without it leaves nothing behind. File work: not real-time safe. One thread.
///
/// `EncoderTraits`: Hdl64eEncoderTraits or Ruby128EncoderTraits.
template <class EncoderTraits>
class DriveWriter {
 public:
  static constexpr auto kLasers = static_cast<std::size_t>(EncoderTraits::kLasers);

  /// `pcap_path` is "<folder>/<name>.pcap"; the other two names follow from it. An existing
  /// capture, calibration and truth folder of that name are replaced at finish(); a truth folder
  /// that holds anything but NNNNNN.label files, and a calibration without a truth folder beside
  /// it, are refused here.
  [[nodiscard]] static Expected<DriveWriter> create(
      const std::filesystem::path& pcap_path,
      const typename EncoderTraits::Calibration& calibration,
      const typename EncoderTraits::Config& config = {});

  DriveWriter(DriveWriter&&) noexcept;
  DriveWriter& operator=(DriveWriter&&) noexcept;
  ~DriveWriter();

  /// The next firing of all lasers; `stamp_ns` is that of its first laser. In dual return two calls
  /// a firing, with the same stamp and azimuth: HDL-64E strongest, then last; RS-Ruby128 last, then
  /// strongest. Firings must be those of a rotating head: stamps at least 1 us apart; inside a
  /// group (Transmitter::limits(); the first group begins with the first firing) the head rotates
  /// on by the sensor's own span of steps from one to the next. Between groups it may leave a gap
  /// of up to 0.9 s, if speed and stamps agree with the azimuths to 15 degrees. Errors:
  /// kInvalidArgument naming the firing and what it broke, kWriteFailed.
  [[nodiscard]] Status add_column(std::int64_t stamp_ns, std::int64_t unwrapped_azimuth_cdeg,
                                  std::span<const frame::LabelledReturn, kLasers> by_laser);

  /// Fills up the last packets with empty firings and puts all files in their places.
  [[nodiscard]] Expected<DriveSummary> finish();

 private:
  class Impl;
  explicit DriveWriter(std::unique_ptr<Impl> impl) noexcept;
  std::unique_ptr<Impl> impl_;
};

using Hdl64eDriveWriter = DriveWriter<encode::Hdl64eEncoderTraits>;
using Ruby128DriveWriter = DriveWriter<encode::Ruby128EncoderTraits>;

}  // namespace terracut::drive
