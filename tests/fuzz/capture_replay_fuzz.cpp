// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Captures whose headers, stamps, lengths and VLANs the input bends, on the way of `replay` to
// labels: each record of the file is in one place of the account, and each return has a label.
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "firmware_io/velodyne/models.hpp"
#include "input.hpp"
#include "rt/files/owned_descriptor.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/input/labelled_capture.hpp"

namespace {

using namespace terracut;
using fuzz::Input;
using fuzz::require;
using Bytes = std::vector<std::uint8_t>;

void put(Bytes& bytes, std::uint64_t value, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    bytes.push_back(static_cast<std::uint8_t>(value >> 8 * (count - 1 - i)));
  }
}
void put_little(Bytes& bytes, std::uint32_t value) {
  for (int shift = 0; shift < 32; shift += 8) {
    bytes.push_back(static_cast<std::uint8_t>(value >> shift));
  }
}

/// A data packet of a VLP-16 that rotates ten times a second.
Bytes packet_of(std::int64_t number) {
  constexpr std::int64_t kPeriod_ns = velodyne::Vlp16::kPace.column_ns * 12;
  hdl64e::wire::Packet packet{};
  packet.stamp_us =
      static_cast<std::uint32_t>(number * kPeriod_ns / 1000 % velodyne::kClockWrap_us);
  packet.status_type = velodyne::kStrongest;
  packet.status_value = 0x22;
  for (std::size_t block = 0; block < packet.blocks.size(); ++block) {
    const std::int64_t column = number * 12 + static_cast<std::int64_t>(block);
    packet.blocks[block].id = hdl64e::kUpperBlockId;
    packet.blocks[block].azimuth_cdeg = static_cast<std::uint16_t>(column * 40 % 36'000);
    for (std::size_t i = 0; i < 32; i += 5) {
      packet.blocks[block].returns[i].distance = static_cast<std::uint16_t>(2000 + 100 * i);
    }
  }
  const auto payload = hdl64e::payload_of(packet);
  return {payload.begin(), payload.end()};
}

/// A capture made as the input says.
class BentCapture {
 public:
  explicit BentCapture(Input& input) : input_(input), link_(input.below(3)) {
    constexpr std::array<std::uint32_t, 3> kLinks{1, 113, 101};  // Ethernet, Linux cooked, raw IP
    put_little(file_, 0xA1B2C3D4);
    put_little(file_, 0x00040002);
    put_little(file_, 0);
    put_little(file_, 0);
    put_little(file_, 65535);
    put_little(file_, kLinks[static_cast<std::size_t>(link_)]);
    while (!input_.empty() && records_ < kMostRecords) step();
  }
  [[nodiscard]] const Bytes& file() const { return file_; }
  [[nodiscard]] std::uint64_t records() const { return records_; }

 private:
  static constexpr std::uint64_t kMostRecords = 600;

  void step() {
    switch (input_.below(14)) {
      case 0:
        vlan_ = input_.below(4) * 10;
        break;
      case 1:
        seconds_ += static_cast<std::int8_t>(input_.next(1));
        break;
      case 2:
        destination_ = input_.next(1);
        break;
      case 3:
        port_ = static_cast<std::uint32_t>(2368 + input_.below(3));
        break;
      case 4:
        source_ = input_.next(1);
        break;
      case 5:
        number_ += input_.below(256);
        break;
      case 6:
        write(frame_of(packet_of(number_)));
        write(frame_of(packet_of(number_++)));
        break;
      case 7: {  // a header that is another one
        Bytes frame = frame_of(packet_of(number_++));
        frame[static_cast<std::size_t>(input_.below(64))] =
            static_cast<std::uint8_t>(input_.next(1));
        write(frame);
        break;
      }
      case 8: {  // cut
        Bytes frame = frame_of(packet_of(number_++));
        frame.resize(static_cast<std::size_t>(input_.below(1300)) % frame.size());
        write(frame);
        break;
      }
      case 9: {  // a payload that is another one
        Bytes payload = packet_of(number_++);
        payload[static_cast<std::size_t>(input_.below(1206))] =
            static_cast<std::uint8_t>(input_.next(1));
        write(frame_of(payload));
        break;
      }
      case 10:  // of another length
        write(frame_of(Bytes(static_cast<std::size_t>(input_.below(1400)), 0xFF)));
        break;
      default:
        for (int left = input_.below(64); left >= 0; --left) {
          write(frame_of(packet_of(number_++)));
        }
    }
  }

  [[nodiscard]] Bytes frame_of(const Bytes& payload) const {
    Bytes frame;
    const bool has_tag = vlan_ != 0 && link_ != 2;
    if (link_ == 0) put(frame, 0x02'00'00'00'00'01, 6);
    if (link_ == 1) put(frame, 0x0000'0001'0006, 6);
    if (link_ != 2) {
      put(frame, 0x02'00'00'00'00'02U + source_, 6);
      if (link_ == 1) put(frame, 0, 2);
      put(frame, has_tag ? 0x8100 : 0x0800, 2);
    }
    if (has_tag) put(frame, static_cast<std::uint64_t>(vlan_) << 16 | 0x0800, 4);
    put(frame, 0x4500, 2);
    put(frame, 28 + payload.size(), 2);
    put(frame, 0, 4);
    put(frame, 0x4011'0000, 4);
    put(frame, 0xC0A80100U + source_, 4);
    put(frame, 0xC0A80100U + destination_, 4);
    put(frame, 2368, 2);
    put(frame, port_, 2);
    put(frame, 8 + payload.size(), 2);
    put(frame, 0, 2);
    frame.insert(frame.end(), payload.begin(), payload.end());
    return frame;
  }

  void write(const Bytes& frame) {
    if (records_ >= kMostRecords) return;
    ++records_;
    const std::int64_t since_us = number_ * 1327;
    put_little(file_, static_cast<std::uint32_t>(seconds_ + since_us / 1'000'000));
    put_little(file_, static_cast<std::uint32_t>(since_us % 1'000'000));
    put_little(file_, static_cast<std::uint32_t>(frame.size()));
    put_little(file_, static_cast<std::uint32_t>(std::max<std::size_t>(frame.size(), 1248)));
    file_.insert(file_.end(), frame.begin(), frame.end());
  }

  Input& input_;
  int link_;
  int vlan_ = 0;
  std::int64_t seconds_ = 1'600'000'000, number_ = 0;
  std::uint32_t destination_ = 255, source_ = 201, port_ = 2368;
  std::uint64_t records_ = 0;
  Bytes file_;
};

cli::Options options_of(Input& input) {
  cli::Options options;
  const std::uint32_t bits = input.next(1);
  cli::CaptureOptions& capture = options.capture;
  if ((bits & 1) != 0) capture.port = 2368;
  if ((bits & 2) != 0) capture.vlan = "0";
  if ((bits & 4) != 0) capture.from = "192.168.1.201";
  if ((bits & 8) != 0) capture.to = "192.168.1.255";
  if ((bits & 16) != 0) capture.start_s = 0.05;
  if ((bits & 32) != 0) capture.duration_s = 0.15;
  if ((bits & 64) != 0) capture.sensor = sensor::SensorModel::kVlp16;
  if ((bits & 128) != 0) capture.from = "192.168.1.201:2368";
  capture.columns = 64;
  options.mount.height_m = 1.7;
  options.mount.roll_deg = options.mount.pitch_deg = 0;
  return options;
}

void replay(const cli::Options& options, std::uint64_t records) {
  auto capture = cli::LabelledCapture::open(options, cli::LabelledCapture::Makes::kLabels);
  if (!capture) return require(!capture.error().message.empty(), "a refusal says nothing");
  cli::LabelledCapture& labelled = **capture;
  std::uint64_t frames = 0;
  while (const run::Frame* const frame = labelled.next()) {
    ++frames;
    require(labelled.labels().size() == frame->record.info.returns, "not every return has a label");
    require(std::ranges::count(labelled.labels(), frame::Label::kNone) == 0,
            "a return has no label");
  }
  const capture::CaptureAccount account = labelled.account();
  require(account.balances(), "a record is in no place, or in two");
  require(account.read.frames <= records, "more records than there are");
  require(options.capture.duration_s || account.read.frames == records,
          "records are left unread, and nothing says so");
  require(labelled.conclude().has_value() == (frames > 0), "frames came, or not");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Input input({data, size});
  cli::HeardLines heard;
  cli::Options options = options_of(input);
  const BentCapture bent(input);
  const files::OwnedDescriptor file(::memfd_create("capture", MFD_CLOEXEC));
  const Bytes& bytes = bent.file();
  require(::write(file.get(), bytes.data(), bytes.size()) == static_cast<::ssize_t>(bytes.size()),
          "no memory for a file");
  options.capture.file = "/proc/self/fd/" + std::to_string(file.get());
  replay(options, bent.records());
  return 0;
}
