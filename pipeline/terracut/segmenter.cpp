// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "terracut/segmenter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "calib/mount/mount_finder.hpp"
#include "calib/mount/ring_profile.hpp"
#include "calib/terracut/calibration_table.hpp"
#include "firmware_io/cloud/sensor_rows.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "firmware_io/scan/scan_to_image.hpp"
#include "firmware_io/terracut/points.hpp"
#include "pipeline/ground/mount_search.hpp"
#include "pipeline/ground/parameter_table.hpp"
#include "pipeline/ground/segmenter.hpp"
#include "pipeline/terracut/point_buffer.hpp"
#include "pipeline/terracut/profile.hpp"
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
  for (const std::string& setting : config.parameters) {
    if (const Status set = ground::apply_setting(method, setting); !set) {
      return tl::unexpected(set.error());
    }
  }
  return method;
}

}  // namespace

/// All that labels clouds of one sensor, taken when its first cloud is known.
struct Segmenter::Labeller {
  Labeller(const Config& config, const mount::Mount& mount, cloud::SensorRows rows,
           std::size_t points_of_first)
      : shape(rows.shape()),
        finder(std::move(rows)),
        image(shape, shape.cells(), memory),
        first_points(points_of_first),
        most_points(std::max(2 * first_points, image.return_capacity())),
        to_image(mount, most_points),
        segmenter(ground::remembering(*method_of(config), false),
                  scan::ring_profile(finder.rows().rings.table, mount), shape,
                  image.return_capacity(), memory) {
    rings.ring_of_point.reserve(most_points);
    labels.reserve(most_points);
  }

  [[nodiscard]] Status check_room(const cloud::CloudView& cloud) const {
    if (cloud.points.size() <= most_points) return {};
    return fail(ErrorCode::kCapacityExceeded,
                fmt::format("{} points; the first cloud made room for {}", cloud.points.size(),
                            most_points));
  }

  Status label(const cloud::CloudView& cloud) {
    if (Status room = check_room(cloud); !room) return room;
    if (Status found = finder.find(cloud, rings); !found) return found;
    (void)to_image.place(cloud.points, rings.ring_of_point, image);
    (void)segmenter.segment(image);
    to_image.labels_of_points(segmenter.labels(), labels);
    return {};
  }

  memory::FixedMemory memory;
  frame::ImageShape shape;
  cloud::RowFinder finder;
  frame::RangeImage image;
  std::size_t first_points;  ///< Of the first cloud.
  std::size_t most_points;
  scan::ScanToImage to_image;
  ground::Segmenter segmenter;
  scan::RingRecovery rings;
  std::vector<Label> labels;
};

struct Segmenter::Engine {
  /// Reads the mount off the first clouds of a sensor.
  class MountOfFirstClouds {
   public:
    MountOfFirstClouds() : to_image_(mount::kAtTheSensor) {}

    /// `image`: room to place the cloud in. Whether there is another mount to label by.
    bool look(std::span<const scan::ScanPoint> points, std::span<const std::int16_t> ring_of_point,
              frame::RangeImage& image) {
      (void)to_image_.place(points, ring_of_point, image);
      search_.add_frame(image);
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
    /// Why there is none, as of the last cloud.
    [[nodiscard]] const Error& fault() const noexcept { return fault_; }
    [[nodiscard]] const std::optional<mount::FoundMount>& found() const noexcept { return found_; }

   private:
    scan::ScanToImage to_image_;
    ground::MountSearch search_;
    std::optional<mount::FoundMount> found_;
    Error fault_{ErrorCode::kMountNotFound, ""};
    bool is_done_ = false;
  };

  explicit Engine(const Config& wanted) : config(wanted), mount(mount_of(wanted.mount)) {
    if (wanted.find_mount) first_clouds.emplace();
  }

  Expected<std::span<const Label>> label(const cloud::CloudView& view) {
    if (!labeller) {
      auto rows =
          cloud::learn_rows(1, [&](std::size_t) -> Expected<cloud::CloudView> { return view; });
      if (!rows) return tl::unexpected(rows.error());
      labeller.emplace(config, mount, *std::move(rows), view.points.size());
    }
    if (first_clouds && !first_clouds->is_done()) {
      if (const Status looked = look_for_mount(view); !looked) {
        return tl::unexpected(looked.error());
      }
    }
    if (const Status labelled = labeller->label(view); !labelled) {
      return tl::unexpected(labelled.error());
    }
    // Once, and not before: the view may look into these.
    cloud.points.reserve(labeller->most_points);
    cloud.laser.reserve(labeller->most_points);
    return std::span<const Label>(labeller->labels);
  }

  Status look_for_mount(const cloud::CloudView& view) {
    if (Status room = labeller->check_room(view); !room) return room;
    if (Status found = labeller->finder.find(view, labeller->rings); !found) return found;
    if (first_clouds->look(view.points, labeller->rings.ring_of_point, labeller->image)) {
      mount = first_clouds->found()->mount;
      const std::size_t first_points = labeller->first_points;
      cloud::SensorRows rows = labeller->finder.rows();
      labeller.emplace(config, mount, std::move(rows), first_points);
    }
    if (first_clouds->found() || config.guess_mount) return {};
    return tl::unexpected(mount_not_found(first_clouds->fault()));
  }

  Config config;
  mount::Mount mount;
  cloud::Cloud cloud;  ///< What is taken out of drivers' memory.
  std::optional<Labeller> labeller;
  std::optional<MountOfFirstClouds> first_clouds;  ///< Where the mount is to be found.
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

std::optional<FoundMount> Segmenter::found_mount() const noexcept {
  if (!engine_->first_clouds || !engine_->first_clouds->found()) return std::nullopt;
  return public_mount(*engine_->first_clouds->found());
}

Expected<std::span<const Label>> Segmenter::label(const PointBuffer& buffer) {
  if (auto unpacked = unpack(buffer, engine_->cloud); !unpacked) {
    return fail(ErrorCode::kMalformed, std::move(unpacked.error().message));
  }
  return engine_->label(engine_->cloud.view());
}

}  // namespace terracut
