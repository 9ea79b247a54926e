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

/// The files and folders that a run reads and writes, as named on the command line.
struct RunFiles {
  struct Input {
    std::string option;  ///< Option that names it: "--calibration"; or "FILE".
    std::filesystem::path path;
    std::string what;  ///< What it is for people: "the calibration".
  };
  enum class Kind : std::uint8_t {
    kFile,
    kFrames,          ///< Folder of one file per frame with one ending (FrameFolder).
    kFolder,          ///< Folder shared with files of other runs.
    kReplacedFolder,  ///< Folder that is replaced as a whole.
    kSharedFolder,    ///< Folder in which each run keeps files of its own.
  };
  struct Output {
    std::string option;
    std::filesystem::path path;
    Kind kind = Kind::kFile;
    std::string ending{};  ///< Ending of files for kFrames: ".label".
  };

  std::vector<Input> inputs;
  std::vector<Output> outputs;
  std::string made_of{};         ///< Input from which outputs are made; empty: unknown.
  bool replaces_others = false;  ///< kFrames: also replaces files made from another input.

  /// read() and write() add a path; an empty path (option not given) is ignored.
  void read(std::string option, const std::filesystem::path& path, std::string what);
  void write(std::string option, const std::filesystem::path& path, Kind kind = Kind::kFile,
             std::string ending = {});
};

/// Checks the files of a command before any work: no output is the same as, lies in or replaces an
/// input, no two outputs are the same, and each path suits its kind. Files are compared by
/// identity, not by name (files::FilePlace). Then each output is reserved against other runs as
/// long as its claim lives. Errors, which name options and files, are those of files::OutputClaim
/// and FrameFolder::check(). If `unwritable` is given, outputs that cannot be written now
/// (kWriteFailed, errors of FrameFolder::check()) are put there instead.
[[nodiscard]] Expected<std::vector<files::OutputClaim>> claim_outputs(
    const RunFiles& files, std::vector<Error>* unwritable = nullptr);

/// Returns "will be replaced: r.json, d.mcap", the existing files and folders that the run replaces
/// as a whole; empty if there are none.
[[nodiscard]] std::string replaced_by(const RunFiles& files);

}  // namespace terracut::cli
