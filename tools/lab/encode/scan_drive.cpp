// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "scan_drive.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <span>
#include <utility>

#include "firmware_io/scan/ring_fit_of_scans.hpp"
#include "frame_motion_log.hpp"
#include "recorded_spin.hpp"
#include "tools/lab/drive/vehicle_log.hpp"

namespace terracut::encode {
namespace {

/// Rotates points by half a revolution about the sensor's axis.
void turn_half_round(std::span<scan::ScanPoint> points) {
  for (scan::ScanPoint& point : points) {
    point.x_m = -point.x_m;
    point.y_m = -point.y_m;
  }
}
SensorTwist reversed(SensorTwist twist) {
  for (const std::size_t axis : {std::size_t{0}, std::size_t{1}}) {
    twist.velocity_m_s[axis] = -twist.velocity_m_s[axis];
    twist.angular_velocity_rad_s[axis] = -twist.angular_velocity_rad_s[axis];
  }
  return twist;
}

Expected<RecordedSpin> recorded_spin(const ScanReader& reader) {
  RecordedSpin spin;
  scan::KittiScan scan;
  scan::RingRecovery rings;
  const Status read = scan::read_some_scans(reader.size(), [&](std::size_t index) {
    Status one = reader.read(index, scan, rings);
    if (one) spin.add(rings.ring_of_point);
    return one;
  });
  if (!read) return tl::unexpected(read.error());
  return spin;
}

}  // namespace

Expected<ScanDriveReport> encode_scan_folder(const std::filesystem::path& folder,
                                             const std::filesystem::path& pcap_path,
                                             const ScanDriveOptions& options) {
  auto reader = ScanReader::open(folder, options.motion);
  if (!reader) return tl::unexpected(std::move(reader.error()));
  ScanDriveReport report;
  report.why_as_recorded = reader->why_as_recorded();
  if (options.can_log && !report.why_as_recorded.empty()) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("{}: a CAN log is of the motion that is put back into the scans, and "
                            "none is: {}",
                            folder.string(), report.why_as_recorded));
  }
  if (options.calibration) {
    report.calibration = *options.calibration;
    reader->use_rings(scan::ring_table(report.calibration));
  } else {
    auto fitted = reader->fit_rings();
    if (!fitted) return tl::unexpected(std::move(fitted.error()));
    report.fitted = *fitted;
    report.calibration = scan::hdl64e_calibration(fitted->table);
    report.calibration.origin = "fitted from " + folder.string();
  }

  auto writer = drive::Hdl64eDriveWriter::create(pcap_path, report.calibration);
  if (!writer) return tl::unexpected(std::move(writer.error()));
  const auto spin = recorded_spin(*reader);
  if (!spin) return tl::unexpected(spin.error());
  report.spin_hz = spin->spin_hz();
  FrameMotionLog log(options.first_stamp_ns);
  const ScanEncoder::Config config{static_cast<std::int64_t>(reader->size()), report.spin_hz,
                                   options.first_stamp_ns};
  ScanEncoder encoder(report.calibration, config, [&](const EncodedFiring& firing) {
    log.note_firing(firing.column.stamp_ns, firing.column.unwrapped_azimuth_cdeg);
    return writer->add_column(firing.column.stamp_ns, firing.column.unwrapped_azimuth_cdeg,
                              firing.column.by_laser);
  });
  scan::KittiScan scan;
  scan::RingRecovery rings;
  for (std::size_t i = 0; i < reader->size(); ++i) {
    if (const Status status = reader->read(i, scan, rings); !status) {
      return tl::unexpected(status.error());
    }
    if (options.can_log) {
      const auto twist = reader->twist(i);
      if (!twist) return tl::unexpected(twist.error());
      turn_half_round(scan.points);
      log.add_frame(reversed(**twist));
    }
    const Status status = encoder.add_frame(scan.points, rings.ring_of_point, scan.labels);
    if (!status) return tl::unexpected(status.error());
    if (!options.on_scan) continue;
    if (const Status go_on = options.on_scan(i + 1, reader->size()); !go_on) {
      return tl::unexpected(go_on.error());
    }
  }
  auto encoded = encoder.finish();
  if (!encoded) return tl::unexpected(std::move(encoded.error()));
  report.encoded = std::move(*encoded);
  const auto drive = writer->finish();
  if (!drive) return tl::unexpected(drive.error());
  report.drive = *drive;
  if (options.can_log) {
    const Status logged = drive::write_vehicle_log(pcap_path, log.samples());
    if (!logged) return tl::unexpected(logged.error());
  }
  return report;
}

}  // namespace terracut::encode
