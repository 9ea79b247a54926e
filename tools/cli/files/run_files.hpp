// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "rt/error.hpp"
#include "rt/files/output_claim.hpp"

namespace terracut::cli {

/// The files and folders that a run reads and writes, as its command line names them.
struct RunFiles {
  struct Input {
    std::string option;  ///< "--calibration", or "FILE" of an argument.
    std::filesystem::path path;
    std::string what;  ///< "the calibration"
  };
  enum class Kind : std::uint8_t {
    kFile,
    kFrames,          ///< Folder with a file a frame, all of one ending (FrameFolder).
    kFolder,          ///< Folder for this run's files, which may lie beside others.
    kReplacedFolder,  ///< Folder that is replaced as a whole.
    kSharedFolder,    ///< Folder in which runs tell their files apart by themselves.
  };
  struct Output {
    std::string option;
    std::filesystem::path path;
    Kind kind = Kind::kFile;
    std::string ending{};  ///< Of kFrames: ".label".
  };

  std::vector<Input> inputs;
  std::vector<Output> outputs;
  std::string made_of{};         ///< What the outputs come of; empty: unknown.
  bool replaces_others = false;  ///< In folders of frames also what came of something else.

  /// Both leave out what was not given, an empty path.
  void read(std::string option, const std::filesystem::path& path, std::string what);
  void write(std::string option, const std::filesystem::path& path, Kind kind = Kind::kFile,
             std::string ending = {});
};

/// The one check of all commands, before any work: that no output is, lies in or replaces an input,
/// that no two outputs are one, and that each can be what it is named for. Files are compared by
/// what they are, not by their names (files::FilePlace). Then every output is held against other
/// runs as long as the claims live. The errors of files::OutputClaim, and for folders of frames of
/// FrameFolder::check(), naming options and files. What cannot be written to now
/// (kWriteFailed, and what FrameFolder::check() says) is put into `unwritable` instead, where that
/// is given.
[[nodiscard]] Expected<std::vector<files::OutputClaim>> claim_outputs(
    const RunFiles& files, std::vector<Error>* unwritable = nullptr);

/// "will be replaced: r.json, d.mcap": files and folders that stand where the run will put its
/// own as a whole. Empty: there are none.
[[nodiscard]] std::string replaced_by(const RunFiles& files);

}  // namespace terracut::cli
