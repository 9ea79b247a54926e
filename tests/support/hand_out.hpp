// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <optional>
#include <type_traits>

#include "firmware_io/frame/frame_info.hpp"
#include "firmware_io/frame/point_image.hpp"
#include "firmware_io/packet/datagram.hpp"
#include "rt/memory/fixed_memory.hpp"

namespace terracut::test {

/// Hands every frame that is ready to `on_frame`(const FrameInfo&, MeasuredReturns&) or, as points,
/// to `on_frame`(const FrameInfo&, const RangeImage&), for which memory is taken.
template <class Decoder, class OnFrame>
void hand_out(Decoder& decoder, OnFrame&& on_frame) {
  while (frame::Frame* frame = decoder.next()) {
    if constexpr (!std::is_invocable_v<OnFrame, frame::FrameInfo&, frame::MeasuredReturns&>) {
      memory::FixedMemory memory;
      on_frame(frame->info, decoder.point_image(memory).make(*frame->returns, frame->motions));
    } else {
      on_frame(frame->info, *frame->returns);
    }
  }
}

/// Decodes one datagram; why it was rejected, if it was.
template <class Decoder, class OnFrame>
std::optional<frame::Reject> decode(Decoder& decoder, const packet::Datagram& datagram,
                                    OnFrame&& on_frame) {
  decoder.push(datagram);
  hand_out(decoder, on_frame);
  return decoder.rejected();
}

template <class Decoder, class OnFrame>
void end_stream(Decoder& decoder, OnFrame&& on_frame) {
  decoder.end_stream();
  hand_out(decoder, on_frame);
}

}  // namespace terracut::test
