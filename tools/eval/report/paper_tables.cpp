// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "paper_tables.hpp"

#include <algorithm>
#include <array>

namespace terracut::evaluation::report {
namespace {

constexpr std::array kAverages{PaperAverage{"pfaff", 37, 64.11, 8.94},
                               PaperAverage{"ring_map", 39.83, 81.16, 7.68},
                               PaperAverage{"ring_map_adjacent", 43.73, 85.92, 13.02},
                               PaperAverage{"paper", 48.58, 93.71, 39.04}};

// SemanticKITTI: Tables I, IV, V, VI.
constexpr std::array<std::string_view, 11> kKittiSequences{"00", "01", "02", "03", "04", "05",
                                                           "06", "07", "08", "09", "10"};
constexpr std::array kKittiScans{4540, 1100, 4660, 800, 270, 2760, 1100, 1100, 4070, 1590, 1200};

using Kitti = std::array<double, kKittiSequences.size()>;
constexpr Kitti kIouZhang{34.02, 58.16, 34.71, 33.53, 55.19, 30.8,
                          30.34, 36.81, 31.46, 35.73, 32.04};
constexpr Kitti kIouBogoslavskyi{23.96, 51.63, 26.85, 29.29, 45.58, 22.84,
                                 28,    25.35, 25.04, 28.17, 21.86};
constexpr Kitti kIouPaper{43.67, 68.54, 43.38, 43.89, 63.31, 38.84,
                          34.03, 47.47, 41.56, 46.2,  47.26};
constexpr Kitti kRecallZhang{72.09, 61.21, 74.84, 72.32, 80.32, 76.06,
                             78.63, 74.71, 73.46, 76.18, 71.66};
constexpr Kitti kRecallBogoslavskyi{58.76, 54.36, 53.72, 50.98, 53.81, 58.28,
                                    55.86, 58.16, 55.13, 56.06, 60.02};
constexpr Kitti kRecallPaper{96.35, 93.3,  94.91, 96.2,  97.92, 96.55,
                             97.23, 96.64, 96.53, 93.25, 94.09};
constexpr Kitti kTimeZhang{1477.63, 1482.06, 1475.77, 1476.36, 1479.85, 1477.14,
                           1487.17, 1473.15, 1476.5,  1473.06, 1469.47};
constexpr Kitti kTimeBogoslavskyi{15.94, 14.88, 15.79, 16.96, 16.32, 16.16,
                                  15.72, 15.10, 15.41, 15.53, 15.62};
constexpr Kitti kTimePaper{39.59, 37.77, 39.21, 42.09, 39.94, 39.83,
                           40.82, 38.98, 39.69, 40.67, 38.89};

constexpr std::array kKittiIou{PaperRow{"zhang", kIouZhang, 37.53},
                               PaperRow{"bogoslavskyi", kIouBogoslavskyi, 29.87},
                               PaperRow{"paper", kIouPaper, 47.10}};
constexpr std::array kKittiRecall{PaperRow{"zhang", kRecallZhang, 73.77},
                                  PaperRow{"bogoslavskyi", kRecallBogoslavskyi, 55.92},
                                  PaperRow{"paper", kRecallPaper, 95.72}};
constexpr std::array kKittiTime{PaperRow{"zhang", kTimeZhang, 1477},
                                PaperRow{"bogoslavskyi", kTimeBogoslavskyi, 15.8},
                                PaperRow{"paper", kTimePaper, 39.8}};

// Koblenz: Tables II, VII, VIII, IX.
constexpr std::array<std::string_view, 3> kKoblenzSequences{"ForestMap", "CampusMap", "FarmMap"};
constexpr std::array kKoblenzScans{263, 644, 426};

using Koblenz = std::array<double, kKoblenzSequences.size()>;
constexpr Koblenz kKoblenzIouZhang{36.87, 62.96, 24.93};
constexpr Koblenz kKoblenzIouBogoslavskyi{24.37, 44.81, 20.40};
constexpr Koblenz kKoblenzIouPaper{58.89, 73.65, 29.51};
constexpr Koblenz kKoblenzRecallZhang{64.01, 74.62, 57.50};
constexpr Koblenz kKoblenzRecallBogoslavskyi{47.15, 72.26, 55.83};
constexpr Koblenz kKoblenzRecallPaper{89.38, 90.81, 78.76};
constexpr Koblenz kKoblenzTimeZhang{1507.88, 1501.65, 1522.74};
constexpr Koblenz kKoblenzTimeBogoslavskyi{15.08, 15.76, 15.13};
constexpr Koblenz kKoblenzTimePaper{34.78, 35.84, 38.43};

constexpr std::array kKoblenzIou{PaperRow{"zhang", kKoblenzIouZhang, 41.59},
                                 PaperRow{"bogoslavskyi", kKoblenzIouBogoslavskyi, 29.86},
                                 PaperRow{"paper", kKoblenzIouPaper, 54.02}};
constexpr std::array kKoblenzRecall{PaperRow{"zhang", kKoblenzRecallZhang, 65.38},
                                    PaperRow{"bogoslavskyi", kKoblenzRecallBogoslavskyi, 58.42},
                                    PaperRow{"paper", kKoblenzRecallPaper, 86.32}};
constexpr std::array kKoblenzTime{PaperRow{"zhang", kKoblenzTimeZhang, 1510.76},
                                  PaperRow{"bogoslavskyi", kKoblenzTimeBogoslavskyi, 15.32},
                                  PaperRow{"paper", kKoblenzTimePaper, 36.35}};

constexpr std::array kDatasets{PaperDataset{"semantickitti",
                                            kKittiSequences,
                                            kKittiScans,
                                            {"IV", "IoU<sub>g</sub> by sequence", kKittiIou},
                                            {"V", "Recall<sub>o</sub> by sequence", kKittiRecall},
                                            {"VI", "Time a frame by sequence", kKittiTime}},
                               PaperDataset{"koblenz",
                                            kKoblenzSequences,
                                            kKoblenzScans,
                                            {"VII", "IoU<sub>g</sub> by map", kKoblenzIou},
                                            {"VIII", "Recall<sub>o</sub> by map", kKoblenzRecall},
                                            {"IX", "Time a frame by map", kKoblenzTime}}};

}  // namespace

std::span<const PaperAverage> paper_averages() noexcept {
  return kAverages;
}

const PaperRow* PaperTable::row_of(std::string_view method) const noexcept {
  const auto row = std::ranges::find(rows, method, &PaperRow::method);
  return row == rows.end() ? nullptr : &*row;
}

const PaperDataset* paper_dataset(std::string_view name) noexcept {
  const auto* const dataset = std::ranges::find(kDatasets, name, &PaperDataset::name);
  return dataset == kDatasets.end() ? nullptr : dataset;
}

}  // namespace terracut::evaluation::report
