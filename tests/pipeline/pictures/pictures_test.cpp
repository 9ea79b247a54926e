// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <gmock/gmock.h>
#include <png.h>

#include "pipeline/pictures/bird_eye_picture.hpp"
#include "pipeline/pictures/range_image_picture.hpp"
#include "tests/pipeline/output/small_frame.hpp"

namespace terracut::pictures {
namespace {

using frame::Label;

/// The colour in the middle of what is drawn for a point of the vehicle frame.
Colour colour_at(const Picture& picture, const BirdEyeView& view, double x_m, double y_m) {
  return picture.at(static_cast<int>(picture.width() / 2.0 - y_m * view.pixels_per_m),
                    static_cast<int>(picture.height() / 2.0 - x_m * view.pixels_per_m));
}

using test::content_of;

class Pictures : public test::InScratchFolder {};

TEST_F(Pictures, AreHalvedToTheMeanOfFourPixels) {
  Picture picture(4, 4, {10, 20, 30});
  picture.set(1, 0, {50, 20, 31});
  const Picture half = picture.halved();
  EXPECT_EQ(half.width(), 2);
  EXPECT_EQ(half.height(), 2);
  EXPECT_EQ(half.at(0, 0), (Colour{20, 20, 30}));
  EXPECT_EQ(half.at(1, 0), (Colour{10, 20, 30}));
  EXPECT_EQ(half.at(0, 1), (Colour{10, 20, 30}));
  EXPECT_EQ(half.at(1, 1), (Colour{10, 20, 30}));
}

TEST_F(Pictures, SurviveThePngFile) {
  Picture picture(7, 3, {1, 2, 3});
  picture.set(6, 2, {200, 100, 50});
  ASSERT_TRUE(picture.write_png(folder_ / "a.png").has_value());

  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  ASSERT_NE(png_image_begin_read_from_file(&header, (folder_ / "a.png").c_str()), 0);
  header.format = PNG_FORMAT_RGB;
  ASSERT_EQ(header.width, 7U);
  ASSERT_EQ(header.height, 3U);
  std::vector<Colour> pixels(21);
  ASSERT_NE(png_image_finish_read(&header, nullptr, pixels.data(), 0, nullptr), 0);
  EXPECT_EQ(pixels.front(), (Colour{1, 2, 3}));
  EXPECT_EQ(pixels.back(), (Colour{200, 100, 50}));

  const auto bytes = picture.png();
  ASSERT_TRUE(bytes.has_value());
  EXPECT_EQ(std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size()),
            content_of(folder_ / "a.png"));
}

TEST_F(Pictures, DrawingOutsideThePictureLeavesNoTrace) {
  Picture picture(4, 4, {});
  picture.set(-1, 0, {9, 9, 9});
  picture.set(0, 4, {9, 9, 9});
  picture.rectangle(-10, -10, 5, 5, {9, 9, 9});
  picture.circle(100, 100, 10, 2, {9, 9, 9}, 1.0);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) EXPECT_EQ(picture.at(x, y), Colour{});
  }
}

TEST_F(Pictures, RangeImageShowsTheSkyUpAndStraightAheadInTheMiddle) {
  output::SmallFrame small;
  small.add(3, 0, 10, 0, 2.0F, Label::kObstacle);  // highest laser, straight ahead
  small.add(0, 8, 0, -5, 0.0F, Label::kGround);    // lowest laser, 90 degrees to the right
  const Picture picture = range_image_picture(small.frame());
  ASSERT_EQ(picture.width(), 32);
  ASSERT_EQ(picture.height(), 4 * kPixelsPerRow + kAzimuthScaleHeight);
  EXPECT_NE(picture.at(16, 0), kPictureBackground);
  EXPECT_NE(picture.at(24, 4 * kPixelsPerRow - 1), kPictureBackground);
  EXPECT_EQ(picture.at(16, 4 * kPixelsPerRow - 1), kPictureBackground);
  EXPECT_EQ(picture.at(0, 0), kPictureBackground);
}

TEST_F(Pictures, RangeImageShowsTheLeftOnTheLeftOfASensorUpsideDown) {
  output::SmallFrame small;
  small.add(0, 4, 10, 10, 0, Label::kGround);
  const Picture picture = range_image_picture(small.frame());
  const int bottom = picture.height() - kAzimuthScaleHeight - 1;
  EXPECT_NE(picture.at(11, bottom), kPictureBackground);
  EXPECT_EQ(picture.at(20, bottom), kPictureBackground);
}

TEST_F(Pictures, RangeImageClosesOnlyGapsOfOneColumn) {
  output::SmallFrame small;
  for (const int column : {20, 22, 25}) small.add(0, column, 10, 0, 0, Label::kGround);
  const Picture picture = range_image_picture(small.frame());
  const int bottom = picture.height() - kAzimuthScaleHeight - 1;
  EXPECT_EQ(picture.at((21 + 16) % 32, bottom), picture.at((20 + 16) % 32, bottom));
  EXPECT_EQ(picture.at((23 + 16) % 32, bottom), kPictureBackground);
  EXPECT_EQ(picture.at((24 + 16) % 32, bottom), kPictureBackground);
}

TEST_F(Pictures, BirdsEyeViewPutsForwardUpAndLeftLeft) {
  output::SmallFrame small;
  small.add(0, 0, 25, 15, 0, Label::kGround, 255);
  const BirdEyeView view{.side_m = 100, .pixels_per_m = 4};
  const Picture picture = bird_eye_picture(small.frame(), view);
  ASSERT_EQ(picture.width(), 400);
  const Colour background = colour_at(picture, view, 25, -15);
  EXPECT_NE(colour_at(picture, view, 25, 15), background);
  EXPECT_EQ(colour_at(picture, view, -25, 15), background);
  EXPECT_EQ(colour_at(picture, view, -25, -15), background);
}

TEST_F(Pictures, BirdsEyeViewShowsTheBoxesOfObjects) {
  output::SmallFrame small;
  small.add(0, 0, 25, 15, 0, Label::kObstacle);
  LabelledFrame frame = small.frame();
  objects::Object car;
  car.box = {{20, -10}, {0.8F, 0.6F}, 5, 2};
  frame.objects = std::span(&car, 1);
  const BirdEyeView view{.side_m = 100, .pixels_per_m = 10};
  const Picture picture = bird_eye_picture(frame, view);
  EXPECT_EQ(colour_at(picture, view, 20, -10), kPictureBackground) << "its middle";
  EXPECT_EQ(colour_at(picture, view, 20 + 2.5 * 0.8, -10 + 2.5 * 0.6), kObjectColour)
      << "the middle of the side in front";
  EXPECT_EQ(colour_at(picture, view, 20 + 0.6, -10 - 0.8), kObjectColour) << "of the right side";
  EXPECT_EQ(legend_of(frame).back().text, "object");
}

TEST_F(Pictures, BirdsEyeViewShowsTheAreaThatIsFree) {
  output::SmallFrame small;
  small.add(0, 0, 25, 15, 0, Label::kObstacle);
  LabelledFrame frame = small.frame();
  const std::array<free_way::Sector, 2> sectors{
      {{-1.5707963F, 8, 12}, {1.5707963F, 30, 20}}};  // to the right, to the left
  frame.free_way = sectors;
  const BirdEyeView view{.side_m = 100, .pixels_per_m = 10};
  const Picture picture = bird_eye_picture(frame, view);
  EXPECT_EQ(colour_at(picture, view, 1, 13), kFreeAreaColour);
  EXPECT_EQ(colour_at(picture, view, 1, 23), kPictureBackground);
  EXPECT_EQ(colour_at(picture, view, 1, -7), kFreeAreaColour);
  EXPECT_EQ(colour_at(picture, view, 1, -9), kPictureBackground) << "behind the obstacle";
  EXPECT_EQ(legend_of(frame).back().text, "free way");
}

TEST_F(Pictures, BirdsEyeViewShowsTheHighestOfReturnsThatFallTogether) {
  const BirdEyeView view{.side_m = 40, .pixels_per_m = 10};
  output::SmallFrame high_first, high_last;
  high_first.add(1, 0, 7, 7, 1.5F, Label::kObstacle);
  high_first.add(0, 0, 7, 7, 0.0F, Label::kGround);
  high_last.add(0, 0, 7, 7, 0.0F, Label::kGround);
  high_last.add(1, 0, 7, 7, 1.5F, Label::kObstacle);
  EXPECT_EQ(colour_at(bird_eye_picture(high_first.frame(), view), view, 7, 7),
            colour_at(bird_eye_picture(high_last.frame(), view), view, 7, 7));
}

TEST_F(Pictures, BirdsEyeViewShowsHigherLevelsOverHigherReturns) {
  output::SmallFrame small;
  small.add(1, 0, 7, 7, 1.5F, Label::kObstacle);
  small.add(0, 0, 7, 7, 0.0F, Label::kGround);
  const BirdEyeView view{.side_m = 40, .pixels_per_m = 10};
  const std::vector<Colour> colours{{250, 0, 0}, {0, 250, 0}};
  const auto shown = [&](const std::vector<std::uint8_t>& level) {
    return colour_at(bird_eye_picture(ColouredFrame{small.image, colours, level}, view), view, 7,
                     7);
  };
  EXPECT_GT(shown({}).red, shown({}).green);
  EXPECT_GT(shown({0, 1}).green, shown({0, 1}).red);
  EXPECT_GT(shown({3, 2}).red, shown({3, 2}).green);
}

TEST_F(Pictures, MistakesHaveTheirOwnColours) {
  output::SmallFrame small;
  small.add(0, 0, 10, 0, 0, Label::kGround);
  small.add(0, 8, 10, 0, 0, Label::kObstacle);
  small.add(0, 16, 10, 0, 0, Label::kGround);
  small.mistakes = {Mistake::kMissedObstacle, Mistake::kFalseObstacle, Mistake::kNone};
  const Picture picture = range_image_picture(small.frame());
  const int bottom = picture.height() - kAzimuthScaleHeight - 1;
  EXPECT_EQ(picture.at(16, bottom), kMissedObstacleColour);
  EXPECT_EQ(picture.at(24, bottom), kFalseObstacleColour);
  EXPECT_NE(picture.at(0, bottom), kMissedObstacleColour);
}

TEST_F(Pictures, ACaptionStandsBelowThePictureAndNamesEveryColour) {
  const Picture picture(300, 20, {1, 2, 3});
  const Colour one{200, 0, 0}, other{0, 200, 0};
  const std::vector<LegendEntry> legend{{"one", {one}}, {"two that vary", {one, other}}};
  const Picture captioned = with_caption(picture, "A title", legend);
  ASSERT_EQ(captioned.width(), 300);
  ASSERT_GT(captioned.height(), 20);
  int ones = 0, others = 0, written = 0;
  for (int y = 0; y < captioned.height(); ++y) {
    for (int x = 0; x < captioned.width(); ++x) {
      if (y < 20) {
        EXPECT_EQ(captioned.at(x, y), (Colour{1, 2, 3}));
      }
      ones += captioned.at(x, y) == one;
      others += captioned.at(x, y) == other;
      written += captioned.at(x, y) == kTextColour;
    }
  }
  EXPECT_EQ(ones, 3 * others) << "a whole swatch and a half, and a half of the other colour";
  EXPECT_GT(others, 0);
  EXPECT_GT(written, 0);
}

TEST_F(Pictures, ALegendThatIsWiderThanThePictureGoesOnBelow) {
  const Picture picture(300, 20, {});
  const std::vector<LegendEntry> two(2, {"a text of some length", {Colour{200, 0, 0}}});
  EXPECT_GT(with_caption(picture, "", two).height(),
            with_caption(picture, "", std::span(two).first(1)).height());
}

TEST_F(Pictures, TheLegendSpeaksOfWhatThePictureShows) {
  output::SmallFrame small;
  small.add(0, 0, 10, 0, 0, Label::kGround);
  const auto texts = [&] {
    std::vector<std::string> found;
    for (const LegendEntry& entry : legend_of(small.frame())) found.push_back(entry.text);
    return found;
  };
  EXPECT_THAT(texts(), testing::ElementsAre("ground", "obstacle, 0 to 4 m high"));
  small.add(0, 8, 10, 0, 0, Label::kOtherGround);
  EXPECT_THAT(texts(), testing::Contains("ground beside the road"));
  small.mistakes = {Mistake::kNone, Mistake::kNone};
  EXPECT_THAT(texts(), testing::IsSupersetOf({"missed obstacle", "false obstacle"}));
}

TEST_F(Pictures, ReturnsOfAnyCoordinateAreSafeToDraw) {
  output::SmallFrame small;
  const float far = 1e30F;
  small.add(0, 0, far, -far, far, Label::kObstacle, 255);
  small.add(0, 1, -50.0F, 50.0F, -far, Label::kGround, 0);
  const Picture picture = bird_eye_picture(small.frame());
  EXPECT_EQ(picture.width(), 1000);
  EXPECT_EQ(picture.height(), 1000);
}

}  // namespace
}  // namespace terracut::pictures
