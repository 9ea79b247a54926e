// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "firmware_io/frame/label.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "pipeline/output/frame_folder.hpp"
#include "pipeline/pictures/frame_colours.hpp"
#include "pipeline/pictures/png_picture.hpp"
#include "pipeline/points/labelled_points.hpp"
#include "pipeline/publish/publisher.hpp"
#include "pipeline/publish/run_facts.hpp"
#include "pipeline/scene/scene_finder.hpp"
#include "rt/error.hpp"
#include "tools/cli/files/frame_folder_of.hpp"
#include "tools/cli/options.hpp"
#include "tools/cli/output/output_sinks.hpp"

namespace terracut::cli {

/// Writes the outputs of OutputOptions frame by frame. `name` is a file name without extension.
class FrameOutputs {
 public:
  explicit FrameOutputs(const OutputOptions& options)
      : options_(options),
        labels_(frame_folder_of(options, options.labels, ".label")),
        pcd_(frame_folder_of(options, options.pcd, ".pcd")),
        png_(frame_folder_of(options, options.png, ".png")) {}

  /// True if an output needs points, not only labels.
  [[nodiscard]] static bool need_points(const OutputOptions& options) {
    return !options.pcd.empty() || !options.png.empty() || wants_sinks(options);
  }

  /// Opens the outputs that get every frame in turn (output/output_sinks.hpp), before the first
  /// frame.
  [[nodiscard]] Status open(const publish::RunFacts& facts);
  /// Lets look() find what is wanted, which is then part of all outputs. The arguments are those of
  /// scene::SceneFinder.
  void find_scene(scene::Wanted wanted, const mount::RingProfile& profile, frame::ImageShape shape,
                  std::size_t return_capacity);

  /// Looks at a frame before it is written. The arguments are those of scene::SceneFinder::find().
  void look(const frame::RangeImage& image, const frame::RangeImage& as_measured,
            std::span<const frame::Label> labels, std::span<const float> heights_m,
            bool is_whole = true);
  /// Returns how far the sensor sees, by the frames so far, as scene::SceneFinder.
  [[nodiscard]] visibility::SightFigures sight() const noexcept {
    return finder_ ? finder_->sight() : visibility::SightFigures();
  }
  /// Returns the number of each return's object; empty unless objects are found.
  [[nodiscard]] std::span<const std::uint16_t> object_of_return() const noexcept {
    return finder_ ? finder_->object_of_return() : std::span<const std::uint16_t>();
  }

  /// Writes NAME.label, in the order of `labels`; `objects` has the numbers of their objects, or is
  /// empty.
  [[nodiscard]] Status write_labels(const std::string& name, std::span<const frame::Label> labels,
                                    std::span<const std::uint16_t> objects);

  /// Writes NAME.pcd, NAME.birdseye.png and NAME.range.png; with truth also NAME.mistakes.png.
  /// `image` has points if need_points(); `labels`, `heights_m` (or empty) and `truth`
  /// (SemanticKITTI ids, or empty) are by return index.
  [[nodiscard]] Status write_frame(const std::string& name, const frame::RangeImage& image,
                                   std::span<const frame::Label> labels,
                                   std::span<const float> heights_m,
                                   std::span<const std::uint32_t> truth);

  /// Hands the frame to the outputs that open() opened, and waits for slow ones. Returns their
  /// first error. `timing` gives the times of the frame's returns.
  [[nodiscard]] Status publish(const status::FrameRecord& record, const frame::RangeImage& image,
                               std::span<const frame::Label> labels,
                               std::span<const float> heights_m,
                               const points::FrameTiming& timing = {});

  /// Completes the outputs that open() opened; call it after the last frame.
  [[nodiscard]] Status finish();

 private:
  [[nodiscard]] Status draw(const std::string& name, const pictures::Picture& picture);

  [[nodiscard]] std::span<const objects::Object> objects() const noexcept {
    return finder_ ? finder_->objects() : std::span<const objects::Object>();
  }
  [[nodiscard]] std::span<const free_way::Sector> free_way() const noexcept {
    return finder_ ? finder_->free_way() : std::span<const free_way::Sector>();
  }

  OutputOptions options_;
  memory::FixedMemory memory_;
  std::optional<scene::SceneFinder> finder_;  ///< Exists after find_scene().
  output::FrameFolder labels_, pcd_, png_;
  std::vector<pictures::Mistake> mistakes_;
  std::optional<publish::Publisher> publisher_;  ///< Exists if open() opened an output.
};

}  // namespace terracut::cli
