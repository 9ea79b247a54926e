// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Whatever leaves the scope of a live run's threads, an exception above all, ends them: none is
// waited for that nobody told to end.
#include <gtest/gtest.h>

#include <stdexcept>
#include <utility>

#include "pipeline/ground/stream_segmenter.hpp"
#include "pipeline/live/frame_outlet.hpp"
#include "pipeline/live/live_thread.hpp"
#include "tests/firmware_io/hdl64e/random_drive.hpp"

namespace terracut::live {
namespace {

class LiveUnwinding : public testing::Test {
 protected:
  memory::FixedMemory memory_;
  calib::SensorCalibration calibration_ = hdl64e::nominal_hdl64e();
  mount::RingProfile profile_ = calib::ring_profile(calibration_, mount::Mount{});
  run::LabelledTurns turns_{calibration_, profile_, decode::Decoder::Config{},
                            ground::turn_maker_of(ground::terracut_profile()), memory_};
};

TEST_F(LiveUnwinding, EndsTheThreadWithADeadline) {
  net::ListenConfig listen;
  listen.at = {0x7F000001, 0};
  auto source = net::LiveSource::open(listen, memory_);
  ASSERT_TRUE(source) << source.error().message;
  auto ready = threads::WakeEvent::make();
  ASSERT_TRUE(ready);
  const auto run_that_throws = [&] {
    LiveThread thread({}, turns_, *source, *std::move(ready), nullptr, memory_);
    (void)thread.start();
    throw std::runtime_error("anything");
  };
  EXPECT_THROW(run_that_throws(), std::runtime_error);
}

TEST_F(LiveUnwinding, EndsTheThreadThatHandsOutLabelledPoints) {
  auto ready = threads::WakeEvent::make();
  ASSERT_TRUE(ready);
  publish::Publisher publisher({}, publish::WhenFull::kDropOldest, {});
  FrameOutlet::Slots slots("points", 2, 100, memory_);
  const auto run_that_throws = [&] {
    FrameOutlet outlet(std::nullopt, publisher, slots, nullptr, *ready, {});
    throw std::runtime_error("anything");
  };
  EXPECT_THROW(run_that_throws(), std::runtime_error);
}

}  // namespace
}  // namespace terracut::live
