// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "console.hpp"
#include "json_text.hpp"
#include "rt/whole_file.hpp"
#include "tools/eval/comparison.hpp"

namespace terracut::cli {
namespace {

using Json = nlohmann::ordered_json;

Expected<Json> read_report(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return fail(ErrorCode::kNotFound, fmt::format("{}: cannot be opened", path.string()));
  Json report = Json::parse(file, nullptr, false);
  if (!report.is_object()) {
    return fail(ErrorCode::kMalformed,
                fmt::format("{}: expected a report of `terracut eval --json`, found no JSON object",
                            path.string()));
  }
  return report;
}

}  // namespace

ExitCode run(const CompareOptions& options) {
  const auto before = read_report(options.before);
  if (!before) return refuse(before.error());
  const auto after = read_report(options.after);
  if (!after) return refuse(after.error());
  const std::string& method_after =
      options.method_after.empty() ? options.method : options.method_after;
  const auto comparison = evaluation::compare({*before, options.before.string(), options.method},
                                              {*after, options.after.string(), method_after});
  if (!comparison) return refuse(comparison.error());
  fmt::print("{}", evaluation::comparison_text(*comparison, options.significance));
  if (!options.json.empty()) {
    const Status written =
        rt::write_whole_file(options.json, json_text(evaluation::comparison_json(*comparison)));
    if (!written) return refuse(written.error());
  }
  return comparison->worse(options.significance).empty() ? kOk : kGotWorse;
}

}  // namespace terracut::cli
