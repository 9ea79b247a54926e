// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/recorder/flight_recorder.hpp"

#include <algorithm>
#include <string>
#include <system_error>

#include "firmware_io/capture/pcap_writer.hpp"
#include "pipeline/recorder/frame_times_json.hpp"
#include "rt/files/whole_file.hpp"
#include "rt/measure/thread_cpu_clock.hpp"

namespace terracut::recorder {
namespace {

constexpr const char* kNothingHeld =
    "no datagram is held: none came, or more came than the recorder holds while they were copied";

}  // namespace

DumpReport FlightRecorder::copy() {
  ring_.copy_to(window_);
  DumpReport report;
  report.datagrams = window_.datagrams();
  report.overwritten = window_.overwritten();
  if (report.datagrams == 0) return report;
  report.first_stamp_ns = report.last_stamp_ns = window_.datagram(0).stamp_ns;
  for (std::size_t n = 0; n < window_.datagrams(); ++n) {
    const packet::Datagram datagram = window_.datagram(n);
    report.first_stamp_ns = std::min(report.first_stamp_ns, datagram.stamp_ns);
    report.last_stamp_ns = std::max(report.last_stamp_ns, datagram.stamp_ns);
    if (!capture::PcapWriter::can_write(datagram)) ++report.unwritable;
  }
  report.datagrams -= report.unwritable;
  return report;
}

std::uint64_t FlightRecorder::capture_bytes() const noexcept {
  return capture::PcapWriter::kFileHeaderBytes +
         window_.datagrams() * capture::PcapWriter::kRecordHeaderBytes + window_.payload_bytes();
}

Status FlightRecorder::write(DumpReport& report, std::string_view times) const {
  auto writer = capture::PcapWriter::create(report.capture);
  if (!writer) return tl::unexpected(writer.error());
  for (std::size_t n = 0; n < window_.datagrams(); ++n) {
    const packet::Datagram datagram = window_.datagram(n);
    if (!capture::PcapWriter::can_write(datagram)) continue;
    if (Status written = writer->write(datagram); !written) return written;
  }
  if (Status written = files::write_whole_file(report.frame_times, times); !written) return written;
  Status finished = writer->finish();
  if (!finished) {
    std::error_code ignored;
    std::filesystem::remove(report.frame_times, ignored);
  }
  return finished;
}

Expected<DumpReport> FlightRecorder::dump(const std::filesystem::path& capture, DumpReason reason,
                                          const DumpFrames& frames) {
  DumpReport report = copy();
  if (report.datagrams == 0) return fail(ErrorCode::kNothingCameOut, kNothingHeld);
  report.capture = capture;
  report.frame_times = frame_times_path(capture);
  const Status written =
      write(report, frame_times_json(report, reason, frames.times, frames.stages));
  if (!written) return tl::unexpected(written.error());
  return report;
}

tl::expected<DumpReport, RefusedDump> FlightRecorder::dump(DumpPolicy& policy, DumpReason reason,
                                                           const DumpFrames& frames) {
  if (const auto admitted = policy.admit(reason, measure::monotonic_ns()); !admitted) {
    return tl::unexpected(admitted.error());
  }
  DumpReport report = copy();
  if (report.datagrams == 0) return policy.refuse({DumpRefusal::kNothingHeld, kNothingHeld});
  const std::string times = frame_times_json(report, reason, frames.times, frames.stages);
  const auto capture =
      policy.make_room(capture_bytes() + times.size(), reason, measure::realtime_ns());
  if (!capture) return tl::unexpected(capture.error());
  report.capture = *capture;
  report.frame_times = frame_times_path(*capture);
  if (const Status written = write(report, times); !written) {
    return policy.refuse({DumpRefusal::kWriteFailed, written.error().message});
  }
  policy.note_written();
  return report;
}

}  // namespace terracut::recorder
