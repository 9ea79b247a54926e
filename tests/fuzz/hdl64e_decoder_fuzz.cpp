// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// The HDL-64E decoder on streams of packets made from the input: wild payloads, and well-formed
// packets whose stamps, azimuths and bytes the input bends. Whatever comes, every return of a
// packet that was accepted must be in a frame or counted as lost, and every packet that was not
// must be counted under its reason.
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <span>

#include "calib/nominal_hdl64e.hpp"
#include "firmware_io/hdl64e/hdl64e_decoder.hpp"
#include "firmware_io/hdl64e/wire.hpp"

namespace {

using namespace terracut;

constexpr int kMaxPackets = 4'000;

void require(bool holds) {
  if (!holds) std::abort();
}

class Input {
 public:
  explicit Input(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
  [[nodiscard]] bool empty() const { return bytes_.empty(); }
  std::uint32_t next(std::size_t count) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < count && !bytes_.empty(); ++i) {
      value = value << 8 | bytes_[0];
      bytes_ = bytes_.subspan(1);
    }
    return value;
  }
  std::span<const std::uint8_t> take(std::size_t count) {
    const auto part = bytes_.first(std::min(count, bytes_.size()));
    bytes_ = bytes_.subspan(part.size());
    return part;
  }

 private:
  std::span<const std::uint8_t> bytes_;
};

std::uint64_t returns_in(std::span<const std::uint8_t> payload) {
  const auto packet = firmware_io::Hdl64ePacketView::of(payload);
  std::uint64_t sum = 0;
  for (int block = 0; packet && block < firmware_io::kBlocksPerPacket; ++block) {
    for (int j = 0; j < firmware_io::kLasersPerBlock; ++j) sum += packet->distance(block, j) != 0;
  }
  return sum;
}

/// Stream and checks: one decoder per input, small enough to run thousands of inputs a second.
class Run {
 public:
  Run() : decoder_(calib::nominal_hdl64e(), {}, config(), memory_) {}

  [[nodiscard]] auto keep() {
    return [this](const firmware_io::FrameInfo& info, const pipeline::RangeImage& image) noexcept {
      require(info.number == frames_++);
      require(info.returns > 0 && info.returns == image.returns());
      require(image.returns() <= image.return_capacity());
      std::uint64_t in_cells = image.overflow().size();
      for (std::size_t cell = 0; cell < image.shape().cells(); ++cell) {
        if (!image.has_return(cell)) continue;
        ++in_cells;
        const auto stride = static_cast<std::size_t>(image.shape().stride());
        require(cell % stride < static_cast<std::size_t>(image.shape().columns));
        require(image.ground_range_m()[cell] >= 0.0F && image.ground_range_m()[cell] < 200.0F);
        require(image.z_m()[cell] > -200.0F && image.z_m()[cell] < 200.0F);
      }
      require(in_cells == info.returns);
      handed_returns_ += info.returns;
    };
  }

  void feed(std::span<const std::uint8_t> payload) {
    ++fed_;
    const auto reason = decoder_.decode({.payload = payload, .stamp_ns = stamp_ns_}, keep());
    if (reason) {
      ++rejected_;
    } else {
      accepted_returns_ += returns_in(payload);
    }
  }
  void advance(std::int64_t ns) { stamp_ns_ += ns; }
  void flush() { decoder_.flush(keep()); }

  void check() const {
    const firmware_io::LossCounters losses = decoder_.losses();
    require(losses.rejected_total() == rejected_);
    require(decoder_.packets_decoded() + rejected_ == fed_);
    require(handed_returns_ + losses.overflow_full_returns == accepted_returns_);
    require(decoder_.frames() == frames_);
  }

 private:
  static firmware_io::Hdl64eDecoder::Config config() {
    firmware_io::Hdl64eDecoder::Config config;
    config.columns = 64;
    config.returns_per_cell = 3;
    return config;
  }
  rt::FixedMemory memory_;
  firmware_io::Hdl64eDecoder decoder_;
  std::int64_t stamp_ns_ = 1'000'000'000;
  std::uint64_t fed_ = 0, rejected_ = 0, accepted_returns_ = 0, handed_returns_ = 0;
  std::uint32_t frames_ = 0;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Input input({data, size});
  Run run;
  firmware_io::Hdl64ePacketBuffer packet;
  std::uint32_t azimuth_cdeg = input.next(2) % 36'000;
  std::uint32_t stamp_us = input.next(4);
  std::uint32_t step_cdeg = 17;
  const auto send = [&] {
    for (int block = 0; block < firmware_io::kBlocksPerPacket; ++block) {
      const auto column = static_cast<std::uint32_t>(block / 2);
      packet.set_azimuth_cdeg(
          block, static_cast<std::uint16_t>((azimuth_cdeg + column * step_cdeg) % 36'000));
    }
    packet.set_stamp_us(stamp_us);
    run.feed(packet.payload());
    azimuth_cdeg = (azimuth_cdeg + 6 * step_cdeg) % 36'000;
    stamp_us += 288;
    run.advance(288'000);
  };
  for (int fed = 0; fed < kMaxPackets && !input.empty(); ++fed) {
    switch (input.next(1) % 10) {
      case 0:  // the stream goes on
        send();
        break;
      case 1:  // for a while
        for (std::uint32_t n = input.next(1); n > 0; --n, ++fed) send();
        break;
      case 2:  // packets are lost, or the clock jumps
        stamp_us += input.next(4);
        break;
      case 3:
        azimuth_cdeg = input.next(2) % 36'000;
        break;
      case 4:  // an older packet, or a repeated one
        stamp_us -= 288 * (input.next(1) % 8);
        azimuth_cdeg = (azimuth_cdeg + 36'000 - 6 * step_cdeg * (input.next(1) % 8)) % 36'000;
        break;
      case 5:
        step_cdeg = input.next(1) % 120;
        break;
      case 6: {  // one return
        const auto where = static_cast<int>(input.next(2));
        packet.set_return(where / 32 % 12, where % 32, static_cast<std::uint16_t>(input.next(2)),
                          static_cast<std::uint8_t>(input.next(1)));
        break;
      }
      case 7: {  // a bent copy of the packet
        std::array<std::uint8_t, firmware_io::kHdl64ePacketBytes> bent{};
        std::memcpy(bent.data(), packet.payload().data(), bent.size());
        for (std::uint32_t n = input.next(1) % 8; n > 0; --n) {
          bent[input.next(2) % bent.size()] = static_cast<std::uint8_t>(input.next(1));
        }
        run.feed(bent);
        break;
      }
      case 8:  // anything
        run.feed(input.take(input.next(2) % 1'300));
        break;
      default:
        run.advance(static_cast<std::int32_t>(input.next(4)));
        if (input.next(1) % 4 == 0) run.flush();
        break;
    }
  }
  run.flush();
  run.check();
  return 0;
}
