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
                fmt::format("{}: no report of `terracut eval`", path.string()));
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
  auto comparison = evaluation::compare(*before, options.method, *after, method_after);
  if (!comparison) return refuse(comparison.error());
  comparison->before = options.method + " of " + options.before.string();
  comparison->after = method_after + " of " + options.after.string();
  fmt::print("{}", evaluation::comparison_text(*comparison));
  if (!options.json.empty()) {
    const Status written =
        rt::write_whole_file(options.json, json_text(evaluation::comparison_json(*comparison)));
    if (!written) return refuse(written.error());
  }
  for (const evaluation::MeasureChange& change : comparison->changes) {
    // Times of two runs on a shared machine differ without anybody's doing.
    if (change.measure != "ms" && change.worse(options.significance)) return kGotWorse;
  }
  return kOk;
}

}  // namespace terracut::cli
