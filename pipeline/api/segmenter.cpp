// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "terracut/segmenter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "calib/api/calibration_table.hpp"
#include "calib/mount/mount_finder.hpp"
#include "calib/mount/ring_profile.hpp"
#include "firmware_io/api/points.hpp"
#include "firmware_io/cloud/cloud_to_image.hpp"
#include "firmware_io/cloud/elevation_bins.hpp"
#include "firmware_io/cloud/sensor_rows.hpp"
#include "pipeline/api/point_buffer.hpp"
#include "pipeline/api/profile.hpp"
#include "pipeline/api/wanted.hpp"
#include "pipeline/ground/mount_search.hpp"
#include "pipeline/ground/parameter_table.hpp"
#include "pipeline/ground/segmenter.hpp"
#include "pipeline/run/cloud_pipeline.hpp"
#include "pipeline/scene/scene_finder.hpp"
#include "rt/memory/fixed_memory.hpp"

namespace terracut {
namespace {

Status check(const Mount& mount) {
  const bool is_possible =
      mount.height_m >= 0.2 && mount.height_m <= 6 && mount::has_possible_angles(mount_of(mount));
  if (is_possible) return {};
  return fail(
      ErrorCode::kInvalidArgument,
      fmt::format("mount: expected a height of 0.2 to 6 m, roll of at most pi and pitch of at "
                  "most pi/2, found {} m, {} and {} rad",
                  mount.height_m, mount.roll_rad, mount.pitch_rad));
}

Expected<ground::SegmenterConfig> method_of(const Segmenter::Config& config) {
  ground::SegmenterConfig method = config_of(config.profile);
  method.gives_heights = wants_heights(config);
  for (const std::string& setting : config.parameters) {
    if (const Status set = ground::apply_setting(method, setting); !set) {
      return tl::unexpected(set.error());
    }
  }
  return method;
}

}  // namespace

struct Segmenter::Engine {
  /// Finds the mount from the first clouds of a sensor.
  class MountOfFirstClouds {
   public:
    explicit MountOfFirstClouds(const cloud::SensorRows& rows)
        : to_image_(rows, mount::kAtTheSensor, memory_) {}

    /// Adds a cloud to the search. Returns true if the search now shows a mount, which found()
    /// returns. Fails as cloud::RowFinder::find() does.
    Expected<bool> look(const cloud::CloudView& view) {
      if (const Status placed = to_image_.place(view); !placed) {
        return tl::unexpected(placed.error());
      }
      search_.add_frame(to_image_.image());
      const bool is_whole = search_.has_enough_frames();
      if (found_ && !is_whole) return false;
      const auto found = search_.found();
      if (found) found_ = *found;
      if (!found) fault_ = found.error();
      is_done_ = is_whole && found_;
      if (is_whole) search_ = {};
      return found.has_value();
    }
    [[nodiscard]] bool is_done() const noexcept { return is_done_; }
    /// Returns why the clouds so far show no mount.
    [[nodiscard]] const Error& fault() const noexcept { return fault_; }
    [[nodiscard]] const std::optional<mount::FoundMount>& found() const noexcept { return found_; }

   private:
    memory::FixedMemory memory_;
    cloud::CloudToImage to_image_;
    ground::MountSearch search_;
    std::optional<mount::FoundMount> found_;
    Error fault_{ErrorCode::kMountNotFound, ""};
    bool is_done_ = false;
  };

  struct Scene {
    Scene(scene::Wanted wanted, const mount::RingProfile& profile, const frame::RangeImage& image)
        : finder(wanted, profile, image.shape(), image.return_capacity(), memory) {}
    memory::FixedMemory memory;
    scene::SceneFinder finder;
  };

  explicit Engine(const Config& wanted) : config(wanted), mount(mount_of(wanted.mount)) {}

  Expected<std::span<const Label>> label(const cloud::CloudView& view) {
    if (!pipeline) {
      if (const Status learnt = learn(view); !learnt) return tl::unexpected(learnt.error());
    }
    if (view.points.size() > most_points) {
      return fail(ErrorCode::kCapacityExceeded,
                  fmt::format("{} points; the first cloud made room for {}", view.points.size(),
                              most_points));
    }
    if (first_clouds) {
      if (const Status looked = look_for_mount(view); !looked) {
        return tl::unexpected(looked.error());
      }
    }
    status::FrameRecord record;
    if (const Status labelled = pipeline->label(view, record); !labelled) {
      return tl::unexpected(labelled.error());
    }
    if (scene) {
      scene->finder.find(pipeline->image(), pipeline->labels(), pipeline->heights_m());
      object_of_point = pipeline->numbers_of_points(scene->finder.object_of_return());
    }
    // Reserves only here, after labelling: `view` may point into these buffers, which reserve() may
    // move.
    cloud.points.reserve(most_points);
    cloud.laser.reserve(most_points);
    return std::span<const Label>(pipeline->point_labels());
  }

  Status learn(const cloud::CloudView& view) {
    auto learnt = cloud::learn_rows_or_bins(
        1, [&](std::size_t) -> Expected<cloud::CloudView> { return view; });
    if (!learnt) return tl::unexpected(learnt.error());
    rows = *std::move(learnt);
    most_points = 2 * view.points.size();
    make_pipeline();
    if (config.find_mount) first_clouds.emplace(*rows);
    return {};
  }

  void make_pipeline() {
    const mount::RingProfile profile = scan::ring_profile(rows->rings.table, mount);
    pipeline.emplace(*rows, profile, ground::maker_of(*method_of(config)));
    const scene::Wanted wanted = wanted_of(config);
    if (wanted.any()) scene.emplace(wanted, profile, pipeline->image());
    most_points = std::max(most_points, pipeline->image().return_capacity());
    pipeline->reserve(most_points);
  }

  Status look_for_mount(const cloud::CloudView& view) {
    const auto shows_another = first_clouds->look(view);
    if (!shows_another) return tl::unexpected(shows_another.error());
    if (*shows_another) {
      found = first_clouds->found();
      mount = found->mount;
      make_pipeline();
    }
    if (!found && !config.guess_mount) {
      return tl::unexpected(mount_not_found(first_clouds->fault()));
    }
    if (first_clouds->is_done()) first_clouds.reset();
    return {};
  }

  Config config;
  mount::Mount mount;
  std::optional<mount::FoundMount> found;          ///< The mount found, if one was looked for.
  cloud::Cloud cloud;                              ///< The points read from a driver's memory.
  std::optional<cloud::SensorRows> rows;           ///< The rows that the first cloud shows.
  std::size_t most_points = 0;                     ///< The most points a cloud may have.
  std::optional<run::CloudPipeline> pipeline;      ///< Set by the first cloud.
  std::optional<MountOfFirstClouds> first_clouds;  ///< Set while the mount is looked for.
  std::optional<Scene> scene;  ///< Set with the pipeline, if anything is to be found.
  std::span<const std::uint16_t> object_of_point;
};

Segmenter::Segmenter(std::unique_ptr<Engine> engine) noexcept : engine_(std::move(engine)) {}
Segmenter::Segmenter(Segmenter&&) noexcept = default;
Segmenter& Segmenter::operator=(Segmenter&&) noexcept = default;
Segmenter::~Segmenter() = default;

Expected<Segmenter> Segmenter::make(const Config& config) {
  if (const Status possible = check(config.mount); !possible) {
    return tl::unexpected(possible.error());
  }
  if (const auto method = method_of(config); !method) return tl::unexpected(method.error());
  return made([&] { return Segmenter(std::make_unique<Engine>(config)); });
}

Expected<std::span<const Label>> Segmenter::label(const Cloud& cloud) {
  if (cloud.rows == 0 || cloud.points.size() % cloud.rows != 0) {
    return fail(ErrorCode::kMalformed, fmt::format("{} points do not make {} rows of equal length",
                                                   cloud.points.size(), cloud.rows));
  }
  return engine_->label({cloud.points, cloud.laser, cloud.rows});
}

std::span<const float> Segmenter::height_above_ground_m() const noexcept {
  if (!engine_->pipeline) return {};
  return engine_->pipeline->point_heights_m();
}

std::span<const Object> Segmenter::objects() const noexcept {
  if (!engine_->scene) return {};
  return engine_->scene->finder.objects();
}

std::span<const std::uint16_t> Segmenter::object_of_point() const noexcept {
  return engine_->object_of_point;
}

std::span<const FreeWaySector> Segmenter::free_way() const noexcept {
  if (!engine_->scene) return {};
  return engine_->scene->finder.free_way();
}

std::optional<FoundMount> Segmenter::found_mount() const noexcept {
  if (!engine_->found) return std::nullopt;
  return public_mount(*engine_->found);
}

Expected<std::span<const Label>> Segmenter::label(const PointBuffer& buffer) {
  if (auto unpacked = unpack(buffer, engine_->cloud); !unpacked) {
    return fail(ErrorCode::kMalformed, std::move(unpacked.error().message));
  }
  return engine_->label(engine_->cloud.view());
}

}  // namespace terracut
