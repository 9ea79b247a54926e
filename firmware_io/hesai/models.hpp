// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware_io/hesai/packet_reader.hpp"
#include "firmware_io/packet/hesai_wire.hpp"
#include "firmware_io/table/model_list.hpp"

/// Hesai's models, and when each of their lasers fires after a column's first one
/// (table/table_sensor.hpp lists what a model must define). Times are the manuals'
/// (docs/reference/sensors.md).
namespace terracut::hesai {

/// What follows from a model's packet: a column is a block, and every laser fires by itself.
template <sensor::SensorModel kWhich>
struct ModelOf {
  static constexpr auto kModel = kWhich;
  static constexpr const PacketLayout& kLayout = layout_of(kWhich);
  static constexpr table::ColumnPace kPace = pace_of(kLayout);
  static constexpr double kMetresPerCount = kMillimetresPerCount * 1e-3;
  static constexpr int kLasers = kLayout.lasers, kChannels = kLasers;
  static constexpr std::size_t kGroups = kChannels;
  [[nodiscard]] static constexpr std::size_t group(std::size_t channel) noexcept { return channel; }
};

/// Pandar40P.
struct Pandar40p : ModelOf<sensor::SensorModel::kPandar40p> {
  static constexpr int kDefaultColumns = 1800;  ///< Firings a frame at 10 Hz.
  [[nodiscard]] static constexpr std::int32_t group_ns(std::size_t group) noexcept {
    constexpr std::array<std::int32_t, 40> kFired_ns{
        12'450, 26'200, 38'630, 51'050, 9'180,  22'930, 7'210,  0,      34'050, 20'960,
        13'760, 46'480, 34'050, 27'510, 3'940,  46'480, 39'930, 17'690, 9'180,  1'970,
        30'780, 22'930, 15'720, 43'200, 36'020, 29'480, 5'910,  48'440, 41'900, 19'660,
        32'750, 45'170, 11'150, 24'900, 37'320, 49'750, 12'450, 26'200, 38'630, 51'050};
    return kFired_ns[group];
  }
};

/// Pandar64.
struct Pandar64 : ModelOf<sensor::SensorModel::kPandar64> {
  static constexpr int kDefaultColumns = 1800;  ///< Firings a frame at 10 Hz.
  [[nodiscard]] static constexpr std::int32_t group_ns(std::size_t group) noexcept {
    constexpr std::array<std::int32_t, 64> kFired_ns{
        31'488, 32'792, 34'096, 35'400, 36'704, 38'008, 43'224, 7'872,  47'136, 17'712, 3'936,
        0,      13'776, 9'840,  23'616, 19'680, 5'904,  1'968,  15'744, 11'808, 25'584, 21'648,
        7'872,  29'520, 17'712, 3'936,  27'552, 13'776, 9'840,  23'616, 19'680, 5'904,  29'520,
        15'744, 11'808, 25'584, 21'648, 1'968,  48'440, 0,      39'312, 27'552, 44'528, 31'488,
        49'744, 32'792, 40'616, 36'704, 45'832, 35'400, 51'048, 34'096, 41'920, 38'008, 47'136,
        43'224, 48'440, 39'312, 44'528, 49'744, 51'048, 40'616, 45'832, 41'920};
    return kFired_ns[group];
  }
};

/// PandarQT (64 channels). The 56th time is printed without its last digit, 12.96 us.
struct PandarQt64 : ModelOf<sensor::SensorModel::kPandarQt64> {
  static constexpr int kDefaultColumns = 600;  ///< Firings a frame at 10 Hz.
  [[nodiscard]] static constexpr std::int32_t group_ns(std::size_t group) noexcept {
    constexpr std::array<std::int32_t, 64> kFired_ns{
        0,       2'060,   4'120,   6'180,   8'230,   10'290,  12'350,  14'400,  16'850,  18'910,
        20'970,  23'030,  25'080,  27'140,  29'190,  31'250,  34'300,  36'360,  38'420,  40'470,
        42'530,  44'590,  46'640,  48'700,  51'140,  53'210,  55'270,  57'320,  59'380,  61'430,
        63'490,  65'550,  68'590,  70'660,  72'710,  74'770,  76'830,  78'880,  80'940,  82'990,
        85'440,  87'510,  89'560,  91'620,  93'670,  95'730,  97'790,  99'840,  102'890, 104'950,
        107'010, 109'070, 111'120, 113'180, 115'230, 117'290, 119'740, 121'800, 123'860, 125'910,
        127'970, 130'030, 132'080, 134'140};
    return kFired_ns[group];
  }
};

/// PandarQT128. Of its first 64 channels 32 fire in every other block; the times of the others
/// differ between the two kinds of blocks by at most 0.856 us, and their mean is taken.
struct PandarQt128 : ModelOf<sensor::SensorModel::kPandarQt128> {
  static constexpr int kDefaultColumns = 900;  ///< Firings a frame at 10 Hz.
  [[nodiscard]] static constexpr std::int32_t group_ns(std::size_t group) noexcept {
    constexpr std::array<std::int32_t, 128> kFired_ns{
        1'284,  77'316, 26'628, 51'972, 55'140, 29'796, 80'484, 4'452,  7'620,  83'652, 32'964,
        58'308, 61'476, 36'132, 86'820, 10'788, 13'956, 89'988, 39'300, 64'644, 67'812, 42'468,
        93'156, 17'124, 20'292, 96'324, 45'636, 70'980, 74'148, 48'804, 99'492, 23'460, 26'628,
        51'972, 1'284,  77'316, 80'484, 4'452,  55'140, 29'796, 32'964, 58'308, 7'620,  83'652,
        86'820, 10'788, 61'476, 36'132, 39'300, 64'644, 13'956, 89'988, 93'156, 17'124, 67'812,
        42'468, 45'636, 70'980, 20'292, 96'324, 99'492, 23'460, 74'148, 48'804, 0,      76'032,
        25'344, 50'688, 53'856, 28'512, 79'200, 3'168,  6'336,  82'368, 31'680, 57'024, 60'192,
        34'848, 85'536, 9'504,  12'672, 88'704, 38'016, 63'360, 66'528, 41'184, 91'872, 15'840,
        19'008, 95'040, 44'352, 69'696, 72'864, 47'520, 98'208, 22'176, 25'344, 50'688, 0,
        76'032, 79'200, 3'168,  53'856, 28'512, 31'680, 57'024, 6'336,  82'368, 85'536, 9'504,
        60'192, 34'848, 38'016, 63'360, 12'672, 88'704, 91'872, 15'840, 66'528, 41'184, 44'352,
        69'696, 19'008, 95'040, 98'208, 22'176, 72'864, 47'520};
    return kFired_ns[group];
  }
};

/// PandarXT-16.
struct PandarXt16 : ModelOf<sensor::SensorModel::kPandarXt16> {
  static constexpr int kDefaultColumns = 2000;  ///< Firings a frame at 10 Hz.
  [[nodiscard]] static constexpr std::int32_t group_ns(std::size_t group) noexcept {
    return static_cast<std::int32_t>(group) * 3'024;
  }
};

/// PandarXT-32.
struct PandarXt32 : ModelOf<sensor::SensorModel::kPandarXt32> {
  static constexpr int kDefaultColumns = 2000;  ///< Firings a frame at 10 Hz.
  [[nodiscard]] static constexpr std::int32_t group_ns(std::size_t group) noexcept {
    return static_cast<std::int32_t>(group) * 1'512;
  }
};

/// PandarXT-32M. Two lasers fire at a time, 16 channels apart.
struct PandarXt32m : ModelOf<sensor::SensorModel::kPandarXt32m> {
  static constexpr int kDefaultColumns = 2000;  ///< Firings a frame at 10 Hz.
  [[nodiscard]] static constexpr std::int32_t group_ns(std::size_t group) noexcept {
    return static_cast<std::int32_t>(group % 16) * 2'888;
  }
};

/// OT128. Lasers have one of 16 times, which differ between its two kinds of blocks by at most
/// 2.144 us; their mean is taken. The second half of a block is that of every other block at high
/// resolution.
struct Ot128 : ModelOf<sensor::SensorModel::kOt128> {
  static constexpr int kDefaultColumns = 1800;  ///< Firings a frame at 10 Hz.
  static constexpr std::size_t kGroups = 16;
  [[nodiscard]] static constexpr std::size_t group(std::size_t channel) noexcept {
    constexpr std::size_t kFirst = 24, kLast = 87;  // of the dense middle
    constexpr std::array<std::uint8_t, 64> kMiddle{6, 5, 3, 5, 6, 1, 4, 2, 4, 2, 3, 0, 0, 1, 7, 7,
                                                   4, 5, 6, 2, 3, 5, 0, 1, 3, 7, 4, 1, 6, 2, 4, 5,
                                                   0, 2, 3, 7, 0, 1, 6, 7, 4, 5, 6, 2, 3, 5, 0, 1,
                                                   3, 7, 4, 1, 6, 2, 4, 5, 0, 2, 3, 7, 0, 1, 6, 7};
    const bool is_middle = channel >= kFirst && channel <= kLast;
    return is_middle ? 8U + kMiddle[channel - kFirst] : channel % 8;
  }
  [[nodiscard]] static constexpr std::int32_t group_ns(std::size_t group) noexcept {
    constexpr std::array<std::int32_t, kGroups> kFired_ns{
        46'645, 34'067, 19'939, 6'289,  40'356, 27'778, 13'650, 0,
        1'653,  3'971,  7'942,  10'260, 15'303, 17'621, 21'592, 23'910};
    return kFired_ns[group];
  }
};

/// Pandar128. As of an OT128, but that the lasers of all 16 times are spread over the rows; its two
/// kinds of blocks differ by at most 0.7 us. Some of the lasers fire a second time for what is
/// nearer than 2.85 m, up to 17 us later, which is not corrected.
struct Pandar128 : ModelOf<sensor::SensorModel::kPandar128> {
  static constexpr int kDefaultColumns = 1800;  ///< Firings a frame at 10 Hz.
  static constexpr std::size_t kGroups = 16;
  [[nodiscard]] static constexpr std::size_t group(std::size_t channel) noexcept {
    constexpr std::array<std::uint8_t, 128> kGroup{
        2,  8,  0,  1,  2,  9,  3,  10, 11, 0,  1,  3,  8,  11, 9,  8,  10, 3,  10, 0,  1,  9,
        11, 10, 2,  13, 14, 4,  14, 6,  6,  12, 4,  4,  13, 15, 5,  15, 14, 14, 6,  5,  4,  7,
        12, 7,  13, 13, 7,  12, 12, 6,  4,  4,  15, 15, 5,  7,  5,  14, 13, 14, 5,  5,  12, 6,
        6,  13, 15, 13, 7,  4,  13, 14, 7,  12, 6,  5,  12, 6,  15, 15, 15, 5,  7,  12, 4,  7,
        14, 1,  0,  2,  3,  11, 9,  0,  8,  1,  1,  2,  10, 8,  9,  3,  2,  9,  8,  10, 3,  11,
        11, 10, 0,  2,  10, 1,  9,  11, 0,  8,  2,  3,  11, 9,  1,  0,  3,  8};
    return kGroup[channel];
  }
  [[nodiscard]] static constexpr std::int32_t group_ns(std::size_t group) noexcept {
    constexpr std::array<std::int32_t, kGroups> kFired_ns{
        0,      1'830,  3'660,  5'490,  11'890, 16'460, 18'745, 21'030,
        27'778, 29'608, 31'438, 33'268, 35'098, 37'383, 41'953, 51'093};
    return kFired_ns[group];
  }
};

/// All models above, for code that folds over models.
using Models = table::ModelList<Pandar40p, Pandar64, PandarQt64, PandarQt128, PandarXt16,
                                PandarXt32, PandarXt32m, Ot128, Pandar128>;
/// A macro for code that needs the preprocessor: expands to DO(Template<model>) for each model
/// above.
#define TERRACUT_FOR_HESAI_MODELS(DO, Template) \
  DO(Template<terracut::hesai::Pandar40p>)      \
  DO(Template<terracut::hesai::Pandar64>)       \
  DO(Template<terracut::hesai::PandarQt64>)     \
  DO(Template<terracut::hesai::PandarQt128>)    \
  DO(Template<terracut::hesai::PandarXt16>)     \
  DO(Template<terracut::hesai::PandarXt32>)     \
  DO(Template<terracut::hesai::PandarXt32m>)    \
  DO(Template<terracut::hesai::Ot128>)          \
  DO(Template<terracut::hesai::Pandar128>)

}  // namespace terracut::hesai
