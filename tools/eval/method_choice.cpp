// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "method_choice.hpp"

namespace terracut::evaluation {

Expected<MethodChoice> method_named(std::string_view name) {
  const auto config = pipeline::method_named(name);
  if (!config) return tl::unexpected(config.error());
  MethodChoice choice{std::string(name), {}, *config};
  for (const pipeline::MethodName& known : pipeline::method_names()) {
    if (known.name == name) choice.about = known.about;
  }
  return choice;
}

}  // namespace terracut::evaluation
