// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// What is found in the frames of a drive in a curve, deskewed, from images as in `replay` and from
// points as in `live`.
#include <algorithm>
#include <vector>

#include "pipeline/points/labelled_points.hpp"
#include "pipeline/points/scene_of_points.hpp"
#include "tests/tools/cli/cli_fixture.hpp"
#include "tools/cli/arguments/arguments.hpp"
#include "tools/cli/input/labelled_capture.hpp"

namespace terracut::cli {
namespace {

using Ways = std::vector<std::vector<free_way::Sector>>;

class SceneOfADrive : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    expect_done(
        "simulate --scene street --duration 0.4 --speed 20 --yaw-rate 28.6 --can-log -o d.pcap");
  }
  [[nodiscard]] std::unique_ptr<LabelledCapture> open(std::vector<std::string> more) const {
    const auto file = [&](const char* name) { return (folder_ / name).string(); };
    std::vector<std::string> words{"replay", file("d.pcap"), "--calibration",
                                   file("d.calibration.xml"), "--free-way"};
    if (!more.empty()) {
      words.insert(words.end(), {"--can", file("d.can.log"), "--dbc", file("d.can.dbc")});
    }
    words.insert(words.end(), more.begin(), more.end());
    const auto arguments = parse_arguments(words);
    if (!arguments) throw std::runtime_error(arguments.error().message);
    auto capture = LabelledCapture::open(arguments->options, LabelledCapture::Makes::kPoints);
    if (!capture) throw std::runtime_error(capture.error().message);
    return *std::move(capture);
  }
  /// Calls `look` with the free way of each frame of a capture.
  template <class Look>
  static void for_each_way(LabelledCapture& capture, Look look) {
    memory::FixedMemory memory;
    const decode::Decoder& decoder = capture.decoder();
    scene::SceneFinder finder({.free_way = true}, capture.profile(), decoder.shape(),
                              decoder.return_capacity(), memory);
    while (const run::Frame* frame = capture.next()) {
      finder.find(*frame->image, *frame->as_measured, capture.labels(), capture.heights_m());
      look(*frame, finder.free_way());
    }
  }
  [[nodiscard]] static Ways ways_of(LabelledCapture& capture) {
    Ways ways;
    for_each_way(capture, [&](const run::Frame&, std::span<const free_way::Sector> way) {
      ways.emplace_back(way.begin(), way.end());
    });
    return ways;
  }
};

bool are_alike(std::span<const free_way::Sector> a, std::span<const free_way::Sector> b,
               float within_m) {
  return std::ranges::equal(a, b, [&](const free_way::Sector& x, const free_way::Sector& y) {
    const bool is_same_obstacle =
        x.obstacle_m == y.obstacle_m || std::abs(x.obstacle_m - y.obstacle_m) <= within_m;
    return is_same_obstacle && std::abs(x.seen_m - y.seen_m) <= within_m &&
           x.seen_end == y.seen_end;
  });
}

TEST_F(SceneOfADrive, HasTheSameFreeWayWhetherItIsDeskewedOrNot) {
  const Ways plain = ways_of(*open({}));
  const Ways deskewed = ways_of(*open({"--deskew-to", "start"}));
  ASSERT_GE(plain.size(), 3U);
  ASSERT_EQ(deskewed.size(), plain.size());
  for (std::size_t i = 0; i < plain.size(); ++i) {
    EXPECT_TRUE(are_alike(plain[i], deskewed[i], 0)) << i;
  }
}

TEST_F(SceneOfADrive, HasTheSameFreeWayFromItsPoints) {
  for (const char* instant : {"start", "middle", "end"}) {
    const auto capture = open({"--deskew-to", instant});
    const decode::Decoder& decoder = capture->decoder();
    points::SceneOfPoints finder({.free_way = true}, capture->profile(), decoder.shape(),
                                 decoder.return_capacity(), decoder.beam_turns());
    std::vector<points::LabelledPoint> points;
    int frames = 0;
    for_each_way(*capture, [&](const run::Frame& frame, std::span<const free_way::Sector> way) {
      ASSERT_EQ(frame.record.info.deskew.state, frame::DeskewState::kDone);
      points.resize(frame.image->returns());
      ASSERT_TRUE(points::pack_labelled_points(*frame.image, capture->labels(), points,
                                               capture->timing(frame)));
      finder.find(frame.record.info, points, capture->heights_m());
      EXPECT_TRUE(are_alike(way, finder.found().free_way(), 0.01F)) << instant << ' ' << frames;
      ++frames;
    });
    EXPECT_GE(frames, 3);
  }
}

}  // namespace
}  // namespace terracut::cli
