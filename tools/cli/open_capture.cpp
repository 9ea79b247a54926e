// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "open_capture.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>

#include <limits>
#include <string_view>
#include <utility>

#include "calib/hdl64e_file.hpp"
#include "calib/hdl64e_stream_table.hpp"
#include "console.hpp"
#include "firmware_io/hdl64e/packet_check.hpp"
#include "firmware_io/hdl64e/status_stream_reader.hpp"
#include "firmware_io/hdl64e/wire.hpp"
#include "loss_table.hpp"

namespace terracut::cli {
namespace {

using firmware_io::PcapSource;

/// A table goes round in 4160 packets, and S2 units need two equal rounds; the rest is for losses.
constexpr std::uint64_t kPacketsToSearch = 30'000;

firmware_io::PcapFilter filter_of(const CaptureOptions& options) {
  firmware_io::PcapFilter filter;
  filter.port = options.port;
  in_addr address{};
  if (!options.from.empty() && ::inet_pton(AF_INET, options.from.c_str(), &address) == 1) {
    filter.source_address = ntohl(address.s_addr);
  }
  return filter;
}

std::int64_t nanoseconds(double seconds) {
  return static_cast<std::int64_t>(seconds * 1e9);
}

/// What became of the frames of a capture of which no datagram was delivered.
std::string where_frames_went(const firmware_io::PcapCounters& read) {
  std::string text = fmt::format("of {} captured frames", read.frames);
  const auto add = [&](std::uint64_t count, std::string_view what) {
    if (count > 0)
      text += fmt::format("{} {} {}", text.ends_with("frames") ? "" : ",", count, what);
  };
  add(read.other_port, "went to another port than --port");
  add(read.other_source, "came from another address than --from");
  for (std::size_t i = 0; i < firmware_io::kFrameRejects; ++i) {
    add(read.refused[i], to_string(static_cast<firmware_io::FrameReject>(i)));
  }
  return text + "; `terracut info` lists the streams";
}

std::string why(const firmware_io::PcapCounters& read, std::uint64_t offered,
                const firmware_io::LossCounters& losses) {
  if (read.frames == 0) return "the capture holds no packets";
  if (read.delivered == 0) return where_frames_went(read);
  if (offered == 0) return "it ends before --start; `terracut info` tells how long it is";
  if (losses.rejected_total() == 0) {
    return fmt::format("{} datagrams were read and none rejected, but they do not make a turn",
                       offered);
  }
  return fmt::format(
      "{} datagrams were read, and these failed a check: {}; `terracut info` names "
      "the sensors in the capture",
      offered, loss_sentence(losses));
}

/// What the search for a table in the stream met on its way.
struct StreamSearch {
  std::optional<calib::Hdl64eCalibration> found;
  std::string table_error;  ///< Of a whole table that does not hold a plausible calibration.
  std::string broke_off;    ///< Why the capture could not be read further.
  std::uint64_t datagrams = 0;
  std::uint64_t data_packets = 0;  ///< Of them, of an HDL-64E.
  std::size_t holes = 0;
  firmware_io::LossCounters losses;
};

StreamSearch search_stream(PcapSource& source) {
  StreamSearch search;
  firmware_io::StatusStreamReader status;
  firmware_io::PacketHeads heads;
  while (search.data_packets < kPacketsToSearch && !status.has_table()) {
    const auto next = source.next();
    if (!next) search.broke_off = next.error().message;
    if (!next || !*next) break;
    ++search.datagrams;
    const auto reject = firmware_io::check_hdl64e_packet((*next)->payload, heads);
    if (reject && *reject != firmware_io::Reject::kStationary) {  // a standing head still talks
      ++search.losses.rejected[static_cast<std::size_t>(*reject)];
      continue;
    }
    const auto packet = firmware_io::Hdl64ePacketView::of((*next)->payload);
    if (!packet) continue;
    ++search.data_packets;
    status.add(packet->status_type(), packet->status_value(), packet->stamp_us());
  }
  search.holes = status.holes();
  if (!status.has_table()) return search;
  auto table = calib::parse_stream_table(status.table());
  if (table) {
    search.found = std::move(table->calibration);
  } else {
    search.table_error = table.error().message;
  }
  return search;
}

Error no_calibration(const PcapSource& source, const StreamSearch& search) {
  if (search.data_packets == 0) {
    return {ErrorCode::kUnsupported,
            fmt::format("{}: expected data packets of an HDL-64E, found none: {}", source.name(),
                        why(source.counters(), search.datagrams, search.losses))};
  }
  const std::string missing =
      !search.table_error.empty()
          ? fmt::format("the table in them is not usable: {}", search.table_error)
          : fmt::format(
                "{} of the table's {} bytes are missing after {} packets (a whole table takes "
                "4160 packets, 1.2 s)",
                search.holes, calib::kStreamTableBytes, search.data_packets);
  return {
      ErrorCode::kNoCalibration,
      fmt::format("{}: no calibration: none was given, and the packets do not hold one: {}{}. Give "
                  "the unit's db.xml or yaml with --calibration FILE",
                  source.name(), missing, search.broke_off.empty() ? "" : "; " + search.broke_off)};
}

Expected<calib::Hdl64eCalibration> choose_calibration(const CaptureOptions& options,
                                                      PcapSource& source) {
  if (!options.calibration.empty()) return calib::load_hdl64e_calibration(options.calibration);
  StreamSearch search = search_stream(source);
  if (!search.found) return tl::unexpected(no_calibration(source, search));
  if (Status status = source.rewind(); !status) return tl::unexpected(status.error());
  return *std::move(search.found);
}

}  // namespace

Expected<OpenCapture> open_capture(const CaptureOptions& options) {
  auto source = PcapSource::open(options.file, filter_of(options));
  if (!source) return tl::unexpected(source.error());
  auto calibration = choose_calibration(options, *source);
  if (!calibration) return tl::unexpected(calibration.error());
  std::string line =
      fmt::format("{}, fingerprint {:016x}", calibration->origin, calib::fingerprint(*calibration));
  say("calibration: " + line);
  return OpenCapture{*std::move(source), *std::move(calibration), std::move(line)};
}

CaptureWindow::CaptureWindow(const CaptureOptions& options)
    : start_ns_(nanoseconds(options.start_s)),
      end_ns_(options.duration_s ? start_ns_ + nanoseconds(*options.duration_s)
                                 : std::numeric_limits<std::int64_t>::max()) {}

CaptureWindow::Place CaptureWindow::place(std::int64_t stamp_ns) noexcept {
  if (!first_ns_) first_ns_ = stamp_ns;
  const std::int64_t since_ns = stamp_ns - *first_ns_;
  if (since_ns < start_ns_) return Place::kBefore;
  return since_ns < end_ns_ ? Place::kInside : Place::kAfter;
}

Error nothing_came_out(const PcapSource& source, std::uint64_t offered,
                       const firmware_io::LossCounters& losses) {
  return {ErrorCode::kNothingCameOut, fmt::format("{}: no frame came out: {}", source.name(),
                                                  why(source.counters(), offered, losses))};
}

}  // namespace terracut::cli
