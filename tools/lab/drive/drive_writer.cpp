// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "drive_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <utility>

namespace terracut::drive {
namespace fs = std::filesystem;

namespace {

/// Refuses to replace a table without a drive's truth beside it: no drive has written it, so it may
/// belong to a real unit.
Status check_table(const fs::path& table, const fs::path& truth) {
  std::error_code none;
  if (table.empty() || !fs::exists(table, none) || fs::exists(truth, none)) return {};
  return fail(ErrorCode::kInvalidArgument,
              fmt::format("{}: would be replaced, but is of no earlier drive, for there is no {} "
                          "beside it; move it away or choose another output name",
                          table.string(), truth.string()));
}

/// Writes the unit's table and reads it back, so that frames begin and end by the values in the
/// file, as they will for the decoder. Returns a built-in table unchanged.
template <class EncoderTraits>
Expected<typename EncoderTraits::Calibration> written_table(
    const fs::path& table, const typename EncoderTraits::Calibration& calibration) {
  if constexpr (EncoderTraits::kCalibrationSuffix.empty()) {
    return calibration;
  } else {
    const Status written = EncoderTraits::write_calibration(table, calibration);
    if (!written) return tl::unexpected(written.error());
    return EncoderTraits::read_calibration(table);
  }
}

}  // namespace

template <class EncoderTraits>
Expected<DriveWriter<EncoderTraits>> DriveWriter<EncoderTraits>::create(
    const fs::path& pcap_path, const typename EncoderTraits::Calibration& calibration,
    const typename EncoderTraits::Config& config) {
  const Status replaceable =
      check_table(calibration_path_of<EncoderTraits>(pcap_path), truth_folder_of(pcap_path));
  if (!replaceable) return tl::unexpected(replaceable.error());
  // The capture comes first, because creating it makes missing folders.
  auto pcap = capture::PcapWriter::create(pcap_path);
  if (!pcap) return tl::unexpected(pcap.error());
  auto files = DriveFiles::create(pcap_path);
  if (!files) return tl::unexpected(files.error());

  const auto as_read = written_table<EncoderTraits>(files->staged_calibration(), calibration);
  if (!as_read) return tl::unexpected(as_read.error());
  const auto sender = EncoderTraits::sender(calibration, config);
  if (!sender) return tl::unexpected(sender.error());
  return DriveWriter(std::move(*pcap), std::move(*files), EncoderTraits::offsets(*as_read), *sender,
                     config.returns);
}

template <class EncoderTraits>
DriveWriter<EncoderTraits>::DriveWriter(capture::PcapWriter pcap, DriveFiles files,
                                        const typename EncoderTraits::Offsets& offsets,
                                        Sender sender, packets::ReturnMode returns)
    : pcap_(std::move(pcap)),
      files_(std::move(files)),
      truth_(offsets, returns),
      sender_(std::move(sender)),
      columns_per_packet_(static_cast<std::size_t>(EncoderTraits::columns_per_packet(returns))),
      group_(static_cast<std::size_t>(EncoderTraits::firings_per_group(returns) *
                                      packets::returns_per_firing(returns))) {}

template <class EncoderTraits>
Status DriveWriter<EncoderTraits>::add_column(
    std::int64_t stamp_ns, std::int64_t unwrapped_azimuth_cdeg,
    std::span<const packets::LabelledReturn, kLasers> by_laser) {
  Column& column = group_[filled_++];
  column.stamp_ns = stamp_ns;
  column.unwrapped_azimuth_cdeg = unwrapped_azimuth_cdeg;
  std::copy(by_laser.begin(), by_laser.end(), column.by_laser.begin());
  ++summary_.columns;
  return filled_ == group_.size() ? write_group() : Status{};
}

template <class EncoderTraits>
Status DriveWriter<EncoderTraits>::write_group() {
  filled_ = 0;
  for (std::size_t first = 0; first < group_.size(); first += columns_per_packet_) {
    const auto columns = std::span<const Column>(group_).subspan(first, columns_per_packet_);
    const Status sent = sender_.send(columns, static_cast<int>(first), pcap_);
    if (!sent) return sent;
    ++summary_.packets;
  }
  truth_.add(group_);
  std::vector<std::uint32_t> labels;
  while (truth_.take_finished(labels)) {
    if (const Status written = write_truth(labels); !written) return written;
  }
  return {};
}

template <class EncoderTraits>
Status DriveWriter<EncoderTraits>::write_truth(const std::vector<std::uint32_t>& labels) {
  if (const Status written = files_.write_truth(summary_.frames, labels); !written) {
    return written;
  }
  ++summary_.frames;
  summary_.returns += labels.size();
  return {};
}

template <class EncoderTraits>
Expected<DriveSummary> DriveWriter<EncoderTraits>::finish() {
  if (filled_ != 0) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("the last {} columns of the drive fill no packet", filled_));
  }
  std::vector<std::uint32_t> labels;
  while (truth_.take_any(labels)) {
    if (const Status written = write_truth(labels); !written) {
      return tl::unexpected(written.error());
    }
  }
  Status placed = files_.check_replaceable();
  if (placed) placed = pcap_.finish();
  if (placed) placed = files_.put_in_place(calibration_path_of<EncoderTraits>(pcap_.path()));
  if (!placed) return tl::unexpected(placed.error());
  return summary_;
}

#define TERRACUT_INSTANTIATE(EncoderTraits) template class DriveWriter<EncoderTraits>;
TERRACUT_FOR_ENCODER_TRAITS(TERRACUT_INSTANTIATE)
#undef TERRACUT_INSTANTIATE

}  // namespace terracut::drive
