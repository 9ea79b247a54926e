// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "semantic_kitti.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "firmware_io/scan/scan_reader.hpp"

namespace terracut::evaluation {
namespace {

namespace fs = std::filesystem;
using firmware_io::ScanReader;

class KittiSequence final : public Sequence {
 public:
  KittiSequence(fs::path labels, ScanReader reader, calib::Hdl64eCalibration calibration)
      : labels_(std::move(labels)),
        reader_(std::move(reader)),
        calibration_(std::move(calibration)) {}

  std::size_t size() const override { return reader_.size(); }
  std::string frame(std::size_t index) const override { return reader_.file(index).name; }
  fs::path file(std::size_t index) const override { return reader_.file(index).points; }
  const calib::Hdl64eCalibration& calibration() const override { return calibration_; }

  Status read(std::size_t index, LabelledScan& scan) const override {
    const firmware_io::ScanFile& file = reader_.file(index);
    if (!file.labels) {
      return fail(ErrorCode::kNotFound, file.points.string() + ": there is no label file for it");
    }
    if (const Status read = reader_.read(index, scan.scan, scan.rings); !read) return read;
    if (scan.rings.no_ring < scan.scan.points.size()) return {};
    return fail(ErrorCode::kMalformed,
                fmt::format("{}: of none of its {} points the laser could be told; is it a scan "
                            "of an HDL-64E, in the order of the original KITTI files?",
                            file.points.string(), scan.scan.points.size()));
  }

  Status check_whole() const override {
    std::set<std::string> scans;
    for (std::size_t i = 0; i < size(); ++i) scans.insert(frame(i));
    std::set<std::string> without;
    std::error_code error;  // sequences() has found the folder; what vanishes since has no labels
    for (const auto& entry : fs::directory_iterator(labels_, error)) {
      const fs::path& path = entry.path();
      if (path.extension() != ".label" || scans.contains(path.stem().string())) continue;
      without.insert(path.string());
    }
    if (without.empty()) return {};
    return fail(ErrorCode::kMalformed,
                fmt::format("{}: there is no scan for it{}", *without.begin(),
                            without.size() == 1 ? std::string()
                                                : fmt::format(", nor for {} more labels beside it",
                                                              without.size() - 1)));
  }

 private:
  fs::path labels_;
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
  return std::make_unique<KittiSequence>(folder(sequence) / "labels", *std::move(reader),
                                         firmware_io::hdl64e_calibration(fitted->table));
}

}  // namespace terracut::evaluation
