// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/hdl64e/drive_writer.hpp"

#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "calib/hdl64e_stream_table.hpp"
#include "calib/hdl64e_xml.hpp"
#include "firmware_io/capture/pcap_writer.hpp"
#include "firmware_io/hdl64e/firing_order.hpp"
#include "firmware_io/hdl64e/packet_encoder.hpp"
#include "firmware_io/hdl64e/status_stream_writer.hpp"
#include "firmware_io/hdl64e/truth_turns.hpp"

namespace terracut::firmware_io {
namespace fs = std::filesystem;
namespace {

/// Factory addresses of the sensor and its broadcast (HDL-64E S3 manual).
constexpr std::uint32_t kSensorAddress = 0xC0A8032B;     // 192.168.3.43
constexpr std::uint32_t kBroadcastAddress = 0xC0A803FF;  // 192.168.3.255

bool is_label_name(const std::string& name) {
  constexpr std::size_t kDigits = 6;
  return name.size() == kDigits + 6 && name.ends_with(".label") &&
         std::all_of(name.begin(), name.begin() + kDigits,
                     [](unsigned char c) { return std::isdigit(c) != 0; });
}

/// A truth folder in the way may be replaced only when it is surely one of ours.
Status check_replaceable(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder, error)) return {};
  if (!fs::is_directory(folder, error)) {
    return fail(
        ErrorCode::kInvalidArgument,
        fmt::format("{}: expected a folder of truth labels or nothing, found a file; move it "
                    "away or choose another output name",
                    folder.string()));
  }
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (!is_label_name(entry.path().filename().string())) {
      return fail(
          ErrorCode::kInvalidArgument,
          fmt::format("{}: expected only NNNNNN.label files, found '{}'; the folder would be "
                      "replaced, so move it away or choose another output name",
                      folder.string(), entry.path().filename().string()));
    }
  }
  return {};
}

tl::unexpected<Error> write_failed(const fs::path& path, const std::string& reason) {
  return fail(ErrorCode::kWriteFailed,
              fmt::format("{}: could not be written: {}; nothing was left in its place. Check the "
                          "free space and the folder's permissions",
                          path.string(), reason));
}

/// A folder beside the outputs, on the same file system, that vanishes with this object.
class StagingFolder {
 public:
  [[nodiscard]] Status make(const fs::path& beside) {
    const std::string stem = beside.stem().string();
    std::string name = (beside.parent_path() / fmt::format(".{}-XXXXXX", stem)).string();
    if (::mkdtemp(name.data()) == nullptr) {
      return write_failed(beside, "no temporary folder can be made in its folder");
    }
    path_ = name;
    return {};
  }
  StagingFolder() = default;
  StagingFolder(const StagingFolder&) = delete;
  StagingFolder& operator=(const StagingFolder&) = delete;
  ~StagingFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  [[nodiscard]] fs::path truth() const { return path_ / "truth"; }
  [[nodiscard]] fs::path old_truth() const { return path_ / "old-truth"; }
  [[nodiscard]] fs::path calibration() const { return path_ / "calibration.xml"; }

 private:
  fs::path path_;
};

}  // namespace

fs::path calibration_path_of(const fs::path& pcap_path) {
  return pcap_path.parent_path() / (pcap_path.stem().string() + ".calibration.xml");
}

fs::path truth_folder_of(const fs::path& pcap_path) {
  return pcap_path.parent_path() / (pcap_path.stem().string() + ".truth");
}

class DriveWriter::Impl {
 public:
  Impl(PcapWriter pcap, std::unique_ptr<StagingFolder> staging, const BeamOffsets& offsets,
       const StatusStreamWriter& status)
      : pcap_(std::move(pcap)), staging_(std::move(staging)), truth_(offsets), status_(status) {}

  Status add_column(std::int64_t stamp_ns, std::int64_t azimuth_cdeg,
                    std::span<const LabelledReturn, calib::kHdl64eLasers> by_laser) {
    if (finished_) return fail(ErrorCode::kInvalidArgument, "the drive is already finished");
    if (const Status ordered = order_.check(stamp_ns, azimuth_cdeg); !ordered) return ordered;
    FiringColumn& column = columns_[filled_++];
    column.stamp_ns = stamp_ns;
    column.unwrapped_azimuth_cdeg = azimuth_cdeg;
    std::copy(by_laser.begin(), by_laser.end(), column.by_laser.begin());
    ++summary_.columns;
    return filled_ == columns_.size() ? write_packet() : Status{};
  }

  Expected<DriveSummary> finish() {
    if (finished_) return fail(ErrorCode::kInvalidArgument, "the drive is already finished");
    while (filled_ != 0) {  // an odd end: firings without returns fill up the packet
      const auto [stamp_ns, azimuth_cdeg] = order_.next();
      static constexpr std::array<LabelledReturn, calib::kHdl64eLasers> kNothing{};
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
  Status write_packet() {
    filled_ = 0;
    const std::int64_t end_ns = packet_end_ns(columns_);
    encode_hdl64e_packet(columns_, end_ns, status_.next(end_ns), packet_);
    const Status sent = pcap_.write({.payload = packet_.payload(),
                                     .stamp_ns = end_ns,
                                     .source_address = kSensorAddress,
                                     .destination_address = kBroadcastAddress,
                                     .source_port = kHdl64eSourcePort,
                                     .destination_port = kHdl64eDataPort});
    if (!sent) return sent;
    ++summary_.packets;
    truth_.add(columns_);
    std::vector<std::uint32_t> labels;
    while (truth_.take_finished(labels)) {
      if (const Status written = write_truth(labels); !written) return written;
    }
    return {};
  }

  Status write_truth(const std::vector<std::uint32_t>& labels) {
    const fs::path path = staging_->truth() / fmt::format("{:06}.label", summary_.frames);
    std::vector<char> bytes;
    bytes.reserve(4 * labels.size());
    for (const std::uint32_t label : labels) {
      for (int shift = 0; shift < 32; shift += 8) {
        bytes.push_back(static_cast<char>(label >> shift & 0xFFU));
      }
    }
    std::ofstream file(path, std::ios::binary);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    file.close();
    if (!file) return write_failed(truth_folder_of(pcap_.path()), "a label file was refused");
    ++summary_.frames;
    summary_.returns += labels.size();
    return {};
  }

  Status put_in_place() {
    const fs::path truth = truth_folder_of(pcap_.path());
    const fs::path calibration = calibration_path_of(pcap_.path());
    if (const Status replaceable = check_replaceable(truth); !replaceable) return replaceable;
    if (const Status captured = pcap_.finish(); !captured) return captured;
    std::error_code error;
    if (fs::exists(truth, error)) fs::rename(truth, staging_->old_truth(), error);
    if (!error) fs::rename(staging_->truth(), truth, error);
    if (error) return write_failed(truth, error.message());
    fs::rename(staging_->calibration(), calibration, error);
    if (error) return write_failed(calibration, error.message());
    return {};
  }

  PcapWriter pcap_;
  std::unique_ptr<StagingFolder> staging_;
  TruthTurns truth_;
  StatusStreamWriter status_;
  FiringOrder order_;
  std::array<FiringColumn, kColumnsPerPacketSingle> columns_{};
  std::size_t filled_ = 0;
  Hdl64ePacketBuffer packet_;
  DriveSummary summary_;
  bool finished_ = false;
};

Expected<DriveWriter> DriveWriter::create(const fs::path& pcap_path,
                                          const calib::Hdl64eCalibration& calibration,
                                          AzimuthAt azimuth_at) {
  if (const Status usable = check_replaceable(truth_folder_of(pcap_path)); !usable) {
    return tl::unexpected(usable.error());
  }
  auto pcap = PcapWriter::create(pcap_path);
  if (!pcap) return tl::unexpected(pcap.error());
  auto staging = std::make_unique<StagingFolder>();
  if (const Status made = staging->make(pcap_path); !made) return tl::unexpected(made.error());
  std::error_code error;
  fs::create_directory(staging->truth(), error);
  if (error) return write_failed(truth_folder_of(pcap_path), error.message());

  const Status written = calib::write_hdl64e_xml(staging->calibration(), calibration);
  if (!written) return tl::unexpected(written.error());
  // The decoder will have what the file says, so turns are cut by that, not by what was meant.
  const auto as_read = calib::read_hdl64e_xml(staging->calibration());
  if (!as_read) return tl::unexpected(as_read.error());
  const auto table = calib::make_stream_table(calibration, calib::UnitInfo{});
  if (!table) return tl::unexpected(table.error());

  return DriveWriter(std::make_unique<Impl>(std::move(*pcap), std::move(staging),
                                            BeamOffsets(*as_read, azimuth_at),
                                            StatusStreamWriter(*table, StatusFlavour::kS3)));
}

DriveWriter::DriveWriter(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}
DriveWriter::DriveWriter(DriveWriter&&) noexcept = default;
DriveWriter& DriveWriter::operator=(DriveWriter&&) noexcept = default;
DriveWriter::~DriveWriter() = default;

Status DriveWriter::add_column(std::int64_t stamp_ns, std::int64_t unwrapped_azimuth_cdeg,
                               std::span<const LabelledReturn, calib::kHdl64eLasers> by_laser) {
  return impl_->add_column(stamp_ns, unwrapped_azimuth_cdeg, by_laser);
}

Expected<DriveSummary> DriveWriter::finish() {
  return impl_->finish();
}

}  // namespace terracut::firmware_io
