// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "semantic_kitti.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "firmware_io/scan/scan_reader.hpp"

namespace terracut::evaluation {
namespace {

namespace fs = std::filesystem;
using firmware_io::ScanReader;

class KittiSequence final : public Sequence {
 public:
  KittiSequence(ScanReader reader, calib::Hdl64eCalibration calibration)
      : reader_(std::move(reader)), calibration_(std::move(calibration)) {}

  std::size_t size() const override { return reader_.size(); }
  std::string frame(std::size_t index) const override { return reader_.file(index).name; }
  fs::path file(std::size_t index) const override { return reader_.file(index).points; }
  const calib::Hdl64eCalibration& calibration() const override { return calibration_; }

  Status read(std::size_t index, LabelledScan& scan) const override {
    const firmware_io::ScanFile& file = reader_.file(index);
    if (!file.labels) {
      return fail(ErrorCode::kNotFound, file.points.string() + ": there is no label file for it");
    }
    return reader_.read(index, scan.scan, scan.rings);
  }

 private:
  ScanReader reader_;
  calib::Hdl64eCalibration calibration_;
};

}  // namespace

Expected<std::vector<std::string>> SemanticKitti::sequences() const {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(root_ / "sequences", error)) {
    if (fs::is_directory(entry.path() / "labels", error)) {
      names.push_back(entry.path().filename().string());
    }
  }
  std::ranges::sort(names);
  if (!names.empty()) return names;
  return fail(ErrorCode::kNotFound, fmt::format("expected {}/sequences/NN with velodyne/ and "
                                                "labels/, found no such folder",
                                                root_.string()));
}

Expected<std::unique_ptr<Sequence>> SemanticKitti::open(const std::string& sequence) const {
  auto reader = ScanReader::open(folder(sequence));
  if (!reader) return tl::unexpected(reader.error());
  const auto fitted = reader->fit_rings();
  if (!fitted) return tl::unexpected(fitted.error());
  return std::make_unique<KittiSequence>(*std::move(reader),
                                         firmware_io::hdl64e_calibration(fitted->table));
}

}  // namespace terracut::evaluation
