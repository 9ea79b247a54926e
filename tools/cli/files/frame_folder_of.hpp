// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <filesystem>
#include <string>

#include "pipeline/output/frame_folder.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// Returns a folder for --labels, --pcd or --png. It reports how many older files it removes.
[[nodiscard]] inline output::FrameFolder frame_folder_of(const OutputOptions& options,
                                                         const std::filesystem::path& folder,
                                                         const std::string& ending) {
  return output::FrameFolder({.folder = folder,
                              .ending = ending,
                              .made_of = options.made_of,
                              .replaces_others = options.overwrite,
                              .on_replaced = [folder, ending](std::size_t removed) {
                                say(fmt::format("{}: {} {} files of an earlier run were taken away",
                                                folder.string(), removed, ending));
                              }});
}

}  // namespace terracut::cli
