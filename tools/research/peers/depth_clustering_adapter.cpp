// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// The ground removal of depth_clustering as a peer of tools/beside_peer.
#include "ground_removal/depth_ground_remover.h"
#include "peer_program.hpp"
#include "projections/projection_params.h"
#include "utils/cloud.h"

namespace {

using depth_clustering::Cloud;
using depth_clustering::ProjectionParams;

/// Keeps the depth image from which the method has removed the ground.
class Listener : public depth_clustering::AbstractClient<Cloud> {
 public:
  void OnNewObjectReceived(const Cloud& cloud, int) override {
    depth_m = cloud.projection_ptr()->depth_image();
  }
  cv::Mat depth_m;
};

class DepthClustering {
 public:
  using Scan = Cloud::Ptr;

  DepthClustering() { remover_.AddClient(&listener_); }
  static Scan scan_of(const std::vector<terracut::peers::Point>& points) {
    Scan scan = boost::make_shared<Cloud>();
    for (const auto& p : points) scan->push_back(depth_clustering::RichPoint(p[0], p[1], p[2]));
    return scan;
  }
  void prepare(const Scan& scan) { cloud_ = std::make_unique<Cloud>(*scan); }
  /// The projection is part of the time, because the method's input is an image.
  void segment(const Scan&) {
    cloud_->InitProjection(*params_);
    remover_.OnNewObjectReceived(*cloud_, 0);
  }
  std::vector<bool> is_ground(const Scan& scan) {
    std::vector<bool> of_point(scan->size());
    const auto projection = cloud_->projection_ptr();
    for (std::size_t row = 0; row < projection->rows(); ++row) {
      for (std::size_t column = 0; column < projection->cols(); ++column) {
        if (listener_.depth_m.at<float>(static_cast<int>(row), static_cast<int>(column)) > 0) {
          continue;
        }
        for (const auto point : projection->at(row, column).points()) of_point[point] = true;
      }
    }
    return of_point;
  }

 private:
  std::unique_ptr<ProjectionParams> params_ = ProjectionParams::HDL_64();
  // The method's own program for KITTI uses 7 degrees and 9 pixels.
  depth_clustering::DepthGroundRemover remover_{*params_, depth_clustering::Radians::FromDegrees(7),
                                                9};
  Listener listener_;
  std::unique_ptr<Cloud> cloud_;
};

}  // namespace

int main(int argc, char** argv) {
  return terracut::peers::run_peer<DepthClustering>(argc, argv);
}
