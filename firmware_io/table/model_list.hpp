// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <type_traits>

#include "calib/sensor/sensor_model.hpp"

namespace terracut::table {

/// A list of models of one maker, types with `kModel` and `kLayout`.
template <class First, class... Rest>
struct ModelList {
  static constexpr std::array kLayouts{First::kLayout, Rest::kLayout...};
  [[nodiscard]] static constexpr bool has(sensor::SensorModel model) noexcept {
    return model == First::kModel || ((model == Rest::kModel) || ...);
  }
  /// `Template` with the models of the list as arguments.
  template <template <class...> class Template>
  using In = Template<First, Rest...>;

  /// Calls `use` with the std::type_identity of the given model and returns the result. For a model
  /// not in the list, calls it with the list's last model.
  template <class Use>
  static decltype(auto) with(sensor::SensorModel model, const Use& use) {
    if constexpr (sizeof...(Rest) == 0) {
      return use(std::type_identity<First>{});
    } else {
      if (model == First::kModel) return use(std::type_identity<First>{});
      return ModelList<Rest...>::with(model, use);
    }
  }
};

}  // namespace terracut::table
