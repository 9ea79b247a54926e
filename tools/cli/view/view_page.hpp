// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <span>
#include <string_view>

namespace terracut::cli {

/// A file of the page, built into the program (page/, joined by CMake).
struct PageFile {
  std::string_view path;  ///< "/view.js"
  std::string_view type;  ///< "text/javascript; charset=utf-8"
  std::string_view text;
};

[[nodiscard]] std::span<const PageFile> view_page() noexcept;

}  // namespace terracut::cli
