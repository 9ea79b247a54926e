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

/// The files and folders that a run reads and writes, as named on its command line.
struct RunFiles {
  struct Input {
    std::string option;  ///< "--calibration", or "FILE" of an argument.
    std::filesystem::path path;
    std::string what;  ///< "the calibration"
  };
  enum class Kind : std::uint8_t {
    kFile,
    kFrames,          ///< Folder with one file per frame, all with one ending (FrameFolder).
    kFolder,          ///< Folder that this run's files share with others.
    kReplacedFolder,  ///< Folder that is replaced as a whole.
    kSharedFolder,    ///< Folder in which runs keep their own files apart.
  };
  struct Output {
    std::string option;
    std::filesystem::path path;
    Kind kind = Kind::kFile;
    std::string ending{};  ///< For kFrames: ".label".
  };

  std::vector<Input> inputs;
  std::vector<Output> outputs;
  std::string made_of{};         ///< Input of the outputs; empty: unknown.
  bool replaces_others = false;  ///< In folders of frames also files made of another input.

  /// read() and write() ignore empty paths, which stand for options not given.
  void read(std::string option, const std::filesystem::path& path, std::string what);
  void write(std::string option, const std::filesystem::path& path, Kind kind = Kind::kFile,
             std::string ending = {});
};

/// Checks the files of a command before any work: no output is, lies in or replaces an input, no
/// two outputs are the same, and each can be of its kind. Files are compared by identity, not by
/// name (files::FilePlace). Then reserves each output against other runs as long as its claim
/// lives. Errors of files::OutputClaim and, for folders of frames, of FrameFolder::check(), naming
/// options and files. Outputs that cannot be written now (kWriteFailed, and errors of
/// FrameFolder::check()) are put into `unwritable` instead, if given.
[[nodiscard]] Expected<std::vector<files::OutputClaim>> claim_outputs(
    const RunFiles& files, std::vector<Error>* unwritable = nullptr);

/// Returns "will be replaced: r.json, d.mcap", the existing files and folders that the run replaces
/// as a whole; empty if there are none.
[[nodiscard]] std::string replaced_by(const RunFiles& files);

}  // namespace terracut::cli
