// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "drive_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <system_error>
#include <utility>
#include <vector>

#include "firing_order.hpp"
#include "firmware_io/capture/pcap_writer.hpp"
#include "truth_frames.hpp"

namespace terracut::drive {
namespace fs = std::filesystem;

template <class EncoderTraits>
class DriveWriter<EncoderTraits>::Impl {
 public:
  using Column = typename EncoderTraits::Column;
  using Sender = typename EncoderTraits::Sender;

  Impl(capture::PcapWriter pcap, DriveFiles files, const typename EncoderTraits::Offsets& offsets,
       Sender sender, ReturnMode returns)
      : pcap_(std::move(pcap)),
        files_(std::move(files)),
        truth_(offsets, returns),
        sender_(std::move(sender)),
        order_(EncoderTraits::limits(returns)),
        returns_(static_cast<std::size_t>(returns_per_firing(returns))),
        group_(static_cast<std::size_t>(EncoderTraits::limits(returns).firings_per_group) *
               returns_) {}

  Status add_column(std::int64_t stamp_ns, std::int64_t azimuth_cdeg,
                    std::span<const frame::LabelledReturn, kLasers> by_laser) {
    if (finished_) return fail(ErrorCode::kInvalidArgument, "the drive is already finished");
    const Status ordered = is_second_return() ? order_.check_second_return(stamp_ns, azimuth_cdeg)
                                              : order_.check(stamp_ns, azimuth_cdeg);
    if (!ordered) return ordered;
    Column& column = group_[filled_++];
    column.stamp_ns = stamp_ns;
    column.unwrapped_azimuth_cdeg = azimuth_cdeg;
    std::copy(by_laser.begin(), by_laser.end(), column.by_laser.begin());
    ++summary_.columns;
    return filled_ == group_.size() ? write_group() : Status{};
  }

  Expected<DriveSummary> finish() {
    if (finished_) return fail(ErrorCode::kInvalidArgument, "the drive is already finished");
    while (filled_ != 0) {  // an odd end: firings without returns fill up the packets
      const auto [stamp_ns, azimuth_cdeg] = is_second_return() ? order_.last() : order_.next();
      static constexpr std::array<frame::LabelledReturn, kLasers> kNothing{};
      if (const Status added = add_column(stamp_ns, azimuth_cdeg, kNothing); !added) {
        return tl::unexpected(added.error());
      }
    }
    std::vector<std::uint32_t> labels;
    while (truth_.take_any(labels)) {
      if (const Status written = write_truth(labels); !written) {
        return tl::unexpected(written.error());
      }
    }
    finished_ = true;
    if (const Status placed = put_in_place(); !placed) return tl::unexpected(placed.error());
    return summary_;
  }

 private:
  [[nodiscard]] bool is_second_return() const noexcept { return filled_ % returns_ != 0; }

  Status write_group() {
    filled_ = 0;
    constexpr auto kColumns = static_cast<std::size_t>(EncoderTraits::kColumnsPerPacket);
    for (std::size_t first = 0; first < group_.size(); first += kColumns) {
      const auto columns =
          std::span<const Column>(group_).subspan(first).template first<kColumns>();
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

  Status write_truth(const std::vector<std::uint32_t>& labels) {
    if (const Status written = files_.write_truth(summary_.frames, labels); !written) {
      return written;
    }
    ++summary_.frames;
    summary_.returns += labels.size();
    return {};
  }

  Status put_in_place() {
    if (const Status replaceable = files_.check_replaceable(); !replaceable) return replaceable;
    if (const Status captured = pcap_.finish(); !captured) return captured;
    return files_.put_in_place(calibration_path_of<EncoderTraits>(pcap_.path()));
  }

  capture::PcapWriter pcap_;
  DriveFiles files_;
  TruthFrames<EncoderTraits> truth_;
  Sender sender_;
  FiringOrder order_;
  std::size_t returns_;        ///< Columns of a firing.
  std::vector<Column> group_;  ///< Columns that fill whole packets.
  std::size_t filled_ = 0;
  DriveSummary summary_;
  bool finished_ = false;
};

namespace {

/// A table without the truth of a drive beside it is no earlier drive's, but somebody's own unit's.
Status check_table(const fs::path& table, const fs::path& truth) {
  std::error_code none;
  if (!fs::exists(table, none) || fs::exists(truth, none)) return {};
  return fail(ErrorCode::kInvalidArgument,
              fmt::format("{}: would be replaced, but is of no earlier drive, for there is no {} "
                          "beside it; move it away or choose another output name",
                          table.string(), truth.string()));
}

}  // namespace

template <class EncoderTraits>
Expected<DriveWriter<EncoderTraits>> DriveWriter<EncoderTraits>::create(
    const fs::path& pcap_path, const typename EncoderTraits::Calibration& calibration,
    const typename EncoderTraits::Config& config) {
  const Status replaceable =
      check_table(calibration_path_of<EncoderTraits>(pcap_path), truth_folder_of(pcap_path));
  if (!replaceable) return tl::unexpected(replaceable.error());
  auto pcap = capture::PcapWriter::create(pcap_path);  // first, for it makes missing folders
  if (!pcap) return tl::unexpected(pcap.error());
  auto files = DriveFiles::create(pcap_path);
  if (!files) return tl::unexpected(files.error());

  const fs::path table = files->staged_calibration();
  if (const Status written = EncoderTraits::write_calibration(table, calibration); !written) {
    return tl::unexpected(written.error());
  }
  // The decoder will have what the file says, so frames are cut by that, not by what was meant.
  const auto as_read = EncoderTraits::read_calibration(table);
  if (!as_read) return tl::unexpected(as_read.error());
  const auto sender = EncoderTraits::sender(calibration, config);
  if (!sender) return tl::unexpected(sender.error());
  return DriveWriter(std::make_unique<Impl>(std::move(*pcap), std::move(*files),
                                            EncoderTraits::offsets(*as_read, config), *sender,
                                            config.returns));
}

template <class EncoderTraits>
DriveWriter<EncoderTraits>::DriveWriter(std::unique_ptr<Impl> impl) noexcept
    : impl_(std::move(impl)) {}
template <class EncoderTraits>
DriveWriter<EncoderTraits>::DriveWriter(DriveWriter&&) noexcept = default;
template <class EncoderTraits>
DriveWriter<EncoderTraits>& DriveWriter<EncoderTraits>::operator=(DriveWriter&&) noexcept = default;
template <class EncoderTraits>
DriveWriter<EncoderTraits>::~DriveWriter() = default;

template <class EncoderTraits>
Status DriveWriter<EncoderTraits>::add_column(
    std::int64_t stamp_ns, std::int64_t unwrapped_azimuth_cdeg,
    std::span<const frame::LabelledReturn, kLasers> by_laser) {
  return impl_->add_column(stamp_ns, unwrapped_azimuth_cdeg, by_laser);
}

template <class EncoderTraits>
Expected<DriveSummary> DriveWriter<EncoderTraits>::finish() {
  return impl_->finish();
}

template class DriveWriter<encode::Hdl64eEncoderTraits>;
template class DriveWriter<encode::Ruby128EncoderTraits>;

}  // namespace terracut::drive
