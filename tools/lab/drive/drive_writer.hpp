// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "drive_files.hpp"
#include "firmware_io/capture/pcap_writer.hpp"
#include "rt/error.hpp"
#include "tools/lab/packets/encoder_traits.hpp"
#include "tools/lab/packets/labelled_return.hpp"
#include "truth_frames.hpp"

namespace terracut::drive {

/// The size of a drive.
struct DriveSummary {
  std::uint64_t frames = 0;   ///< Frames with at least one return, each with a truth file.
  std::uint64_t returns = 0;  ///< The number of entries of all truth files.
  std::uint64_t columns = 0;
  std::uint64_t packets = 0;  ///< Data packets.
};

/// Writes a labelled drive of a sensor, which has three parts:
///
///   drive.pcap                the sensor's packets, its calibration in them (HDL-64E: in the
///                             status bytes; RS-Ruby128: in a device packet every second)
///   drive.calibration.xml     the unit's table (HDL-64E: db.xml; RS-Ruby128: angle.csv, named
///                             drive.calibration.csv); none where the table is built in
///   drive.truth/NNNNNN.label  one little-endian uint32 per return, frame by frame, in order of
///                             arrival (packet, block, laser), SemanticKITTI ids
///
/// The n-th entry of NNNNNN.label is the n-th return that the decoder places into its frame NNNNNN
/// (RangeImage::return_index()). A frame without returns does not exist on either side. Frames are
/// cut by the beams' azimuths, not the head's: lasers point up to 10 degrees before or behind the
/// head. So start about 11 degrees before a seam, end about 11 degrees after one, and omit returns
/// of other frames (raw = 0).
///
/// All files have temporary names and appear, whole, at finish(); without it nothing is left. File
/// work: not real-time safe. One thread.
///
/// `EncoderTraits`: encoder_traits.hpp.
template <class EncoderTraits>
class DriveWriter {
 public:
  static constexpr auto kLasers = static_cast<std::size_t>(EncoderTraits::kLasers);

  /// `pcap_path` is "<folder>/<name>.pcap"; the paths of the other parts follow from it. finish()
  /// replaces an existing capture, calibration and truth folder of that name. Refuses a truth
  /// folder with anything but NNNNNN.label files, and a calibration without a truth folder.
  [[nodiscard]] static Expected<DriveWriter> create(
      const std::filesystem::path& pcap_path,
      const typename EncoderTraits::Calibration& calibration,
      const typename EncoderTraits::Config& config = {});

  /// Adds the next firing of all lasers; `stamp_ns` is that of its first laser. Dual return takes
  /// two calls per firing, with the same stamp and azimuth: HDL-64E strongest, then last; others
  /// last, then strongest. Firings must be those of a rotating head that a decoder can follow.
  /// Fails with kWriteFailed.
  [[nodiscard]] Status add_column(std::int64_t stamp_ns, std::int64_t unwrapped_azimuth_cdeg,
                                  std::span<const packets::LabelledReturn, kLasers> by_laser);

  /// Moves all files to their places. Fails with kInvalidArgument if the columns do not fill whole
  /// packets.
  [[nodiscard]] Expected<DriveSummary> finish();

 private:
  using Column = typename EncoderTraits::Column;
  using Sender = typename EncoderTraits::Sender;

  DriveWriter(capture::PcapWriter pcap, DriveFiles files,
              const typename EncoderTraits::Offsets& offsets, Sender sender,
              packets::ReturnMode returns);

  [[nodiscard]] Status write_group();
  [[nodiscard]] Status write_truth(const std::vector<std::uint32_t>& labels);

  capture::PcapWriter pcap_;
  DriveFiles files_;
  TruthFrames<EncoderTraits> truth_;
  Sender sender_;
  std::size_t columns_per_packet_;
  std::vector<Column> group_;  ///< Columns of whole packets.
  std::size_t filled_ = 0;
  DriveSummary summary_;
};

using Hdl64eDriveWriter = DriveWriter<packets::Hdl64eEncoderTraits>;

}  // namespace terracut::drive
