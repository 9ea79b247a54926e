// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/files/run_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <system_error>
#include <utility>

#include "pipeline/output/frame_folder.hpp"
#include "rt/files/file_place.hpp"
#include "rt/files/part_file.hpp"

namespace terracut::cli {
namespace {

namespace fs = std::filesystem;
using files::FilePlace;
using Kind = RunFiles::Kind;
using Output = RunFiles::Output;
using Input = RunFiles::Input;

std::string name_of(const Output& output) {
  return output.option + " " + output.path.string();
}

tl::unexpected<Error> refuse(std::string message) {
  return fail(ErrorCode::kInvalidArgument, std::move(message));
}

/// Checks that an existing path is of the kind that the option needs.
Status check_kind(const Output& output) {
  if (output.path == "-") {
    return refuse(name_of(output) +
                  ": a file is expected; standard output has the report for people");
  }
  std::error_code error;
  const fs::file_type standing = fs::status(output.path, error).type();
  if (standing == fs::file_type::not_found || standing == fs::file_type::none) return {};
  const bool file = output.kind == Kind::kFile;
  if (standing == (file ? fs::file_type::regular : fs::file_type::directory)) return {};
  return fail(ErrorCode::kWriteFailed,
              fmt::format("{} is to be a {}, but something else has that name; name another",
                          name_of(output), file ? "file" : "folder"));
}

Status check_against(const Output& output, const Input& input) {
  const FilePlace out(output.path), in(input.path);
  const std::string read =
      fmt::format("{} that the run reads ({} {})", input.what, input.option, input.path.string());
  if (out.is_same_as(in)) {
    return refuse(fmt::format("{} is {}; name another", name_of(output), read));
  }
  if (out.lies_in(in)) {
    return refuse(fmt::format("{} lies in {}; name a place outside it", name_of(output), read));
  }
  if (output.kind == Kind::kReplacedFolder && in.lies_in(out)) {
    return refuse(fmt::format("{} would be replaced, and in it lies {}; name another",
                              name_of(output), read));
  }
  return {};
}

bool hold_different_files(const Output& a, const Output& b) {
  const auto is_folder = [](Kind kind) {
    return kind != Kind::kFile && kind != Kind::kReplacedFolder;
  };
  return is_folder(a.kind) && is_folder(b.kind) && (a.ending.empty() || a.ending != b.ending);
}

Status check_against(const Output& a, const Output& b) {
  if (FilePlace(a.path).is_same_as(FilePlace(b.path)) && !hold_different_files(a, b)) {
    return refuse(fmt::format("{} and {} are the same; name two", name_of(a), name_of(b)));
  }
  const auto is_among_frames = [](const Output& file, const Output& frames) {
    return file.kind == Kind::kFile && frames.kind == Kind::kFrames &&
           file.path.extension() == frames.ending &&
           FilePlace(file.path).lies_in(FilePlace(frames.path));
  };
  if (is_among_frames(a, b) || is_among_frames(b, a)) {
    return refuse(fmt::format("{} and {}: the file would be one of the frames'; name another",
                              name_of(a), name_of(b)));
  }
  return {};
}

Expected<files::OutputClaim> claim(const Output& output) {
  using Use = files::OutputClaim::Use;
  if (const Status kind = check_kind(output); !kind) return tl::unexpected(kind.error());
  const bool from_beside = output.kind == Kind::kFile || output.kind == Kind::kReplacedFolder;
  auto claimed = from_beside ? files::OutputClaim::of_file(output.path)
                             : files::OutputClaim::of_folder(
                                   output.path,
                                   output.kind == Kind::kSharedFolder ? Use::kShared : Use::kAlone);
  if (!claimed) {
    return fail(claimed.error().code, output.option + ": " + claimed.error().message);
  }
  return claimed;
}

/// Removes incomplete files that killed runs left beside the output.
void tidy_up(const Output& output) {
  const fs::path place = FilePlace(output.path).path();
  if (output.kind == Kind::kFile || output.kind == Kind::kReplacedFolder) {
    files::remove_abandoned_parts(
        place.parent_path(),
        [name = place.filename().string()](std::string_view of) { return of == name; });
  } else if (output.kind == Kind::kFrames) {
    files::remove_abandoned_parts(place,
                                  [&](std::string_view of) { return of.ends_with(output.ending); });
  }
}

Status check_origin(const Output& output, const RunFiles& files) {
  if (output.kind != Kind::kFrames) return {};
  const Status own = output::FrameFolder({.folder = output.path,
                                          .ending = output.ending,
                                          .made_of = files.made_of,
                                          .replaces_others = files.replaces_others})
                         .check();
  return own ? own : fail(own.error().code, output.option + " " + own.error().message);
}

Status check_apart(const RunFiles& files) {
  for (auto output = files.outputs.begin(); output != files.outputs.end(); ++output) {
    for (const Input& input : files.inputs) {
      if (Status apart = check_against(*output, input); !apart) return apart;
    }
    for (auto other = files.outputs.begin(); other != output; ++other) {
      if (Status apart = check_against(*other, *output); !apart) return apart;
    }
  }
  return {};
}

}  // namespace

void RunFiles::read(std::string option, const fs::path& path, std::string what) {
  if (!path.empty()) inputs.push_back({std::move(option), path, std::move(what)});
}

void RunFiles::write(std::string option, const fs::path& path, Kind kind, std::string ending) {
  if (!path.empty()) outputs.push_back({std::move(option), path, kind, std::move(ending)});
}

Expected<std::vector<files::OutputClaim>> claim_outputs(const RunFiles& files,
                                                        std::vector<Error>* unwritable) {
  if (const Status apart = check_apart(files); !apart) return tl::unexpected(apart.error());
  std::vector<files::OutputClaim> claims;
  std::vector<FilePlace> held;  // several kinds of files may go to one folder
  for (const Output& output : files.outputs) {
    const FilePlace place(output.path);
    if (std::ranges::none_of(held, [&](const FilePlace& at) { return at.is_same_as(place); })) {
      auto claimed = claim(output);
      if (!claimed && unwritable != nullptr && claimed.error().code == ErrorCode::kWriteFailed) {
        unwritable->push_back(claimed.error());
        continue;
      }
      if (!claimed) return tl::unexpected(claimed.error());
      claims.push_back(*std::move(claimed));
      held.emplace_back(output.path);
    }
    const Status own = check_origin(output, files);
    if (!own && unwritable == nullptr) return tl::unexpected(own.error());
    if (!own) unwritable->push_back(own.error());
    tidy_up(output);
  }
  return claims;
}

std::string replaced_by(const RunFiles& files) {
  std::string text;
  for (const Output& output : files.outputs) {
    std::error_code error;
    const bool is_file = output.kind == Kind::kFile && fs::is_regular_file(output.path, error);
    const bool is_folder =
        output.kind == Kind::kReplacedFolder && fs::is_directory(output.path, error);
    if (!is_file && !is_folder) continue;
    text += (text.empty() ? "will be replaced: " : ", ") + output.path.string();
  }
  return text;
}

}  // namespace terracut::cli
