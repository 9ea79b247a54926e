// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "relabel_record.hpp"

#include <fmt/format.h>

#include <cstddef>

#include "content_hash.hpp"
#include "tools/cli/json_text.hpp"

namespace terracut::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t kMostBytes = std::size_t{1} << 20;

/// Returns the path of a drive's record: the last part of the drive's name, for people, and a hash
/// of the whole name, so that no two drives share a file.
fs::path place_of(const fs::path& state, const std::string& drive) {
  constexpr std::size_t kLongestName = 100;
  const std::string name = fs::path(drive).filename().string().substr(0, kLongestName);
  return state / "records" / fmt::format("{}-{}.json", name, short_hash(drive));
}

/// True if `output` is a possible name of the drive's folder; any other path must not be read as
/// labels.
bool is_output_of(const std::string& output, const std::string& drive) {
  const std::string before = drive + "-";
  return output.starts_with(before) && output.size() == before.size() + kShortHashDigits &&
         output.find_first_not_of("0123456789abcdef", before.size()) == std::string::npos;
}

/// Reads a record. Throws nlohmann::json::exception if a member has the wrong type.
RelabelRecord record_in(const Json& json) {
  RelabelRecord record;
  record.drive = json.at("drive").get<std::string>();
  record.done = json.value("state", "") == "done";
  record.output = json.value("output", "");
  record.cause = json.value("cause", "");
  record.message = json.value("message", "");
  record.shard = json.value("shard", "");
  record.host = json.value("host", "");
  record.started_ns = json.value("started_ns", std::int64_t{0});
  record.ended_ns = json.value("ended_ns", std::int64_t{0});
  record.run.seconds = json.value("seconds", 0.0);
  record.frames = json.value("frames", std::uint64_t{0});
  record.label_bytes = json.value("label_bytes", std::uint64_t{0});
  record.losses = json.value("losses", Json::object());
  record.stamps = json.value("stamps", Json::object());
  return record;
}

}  // namespace

RelabelRecord read_record(const fs::path& state, const std::string& drive) {
  const auto json = read_json(place_of(state, drive), kMostBytes);
  if (!json || !are_counts(*json, {"started_ns", "ended_ns", "frames", "label_bytes"})) return {};
  try {
    RelabelRecord record = record_in(*json);
    if (record.drive == drive && (!record.done || is_output_of(record.output, drive))) {
      return record;
    }
  } catch (const nlohmann::json::exception&) {  // another program's file: as if there were none
  }
  return {};
}

Status write_record(const RelabelJob& job, const RelabelRecord& record) {
  Json json{{"drive", record.drive}, {"state", record.done ? "done" : "failed"}};
  if (record.done) {
    json["output"] = record.output;
    json["frames"] = record.frames;
    json["returns"] = record.returns;
    json["losses"] = record.losses;
    json["label_bytes"] = record.label_bytes;
  } else {
    json["cause"] = record.cause;
    json["message"] = record.message;
    json["exit_code"] = record.run.exit_code;
    json["signal"] = record.run.signal;
  }
  json.update(Json{{"shard", record.shard},
                   {"host", record.host},
                   {"pid", record.pid},
                   {"terracut", TERRACUT_VERSION},
                   {"program", job.program},
                   {"started_ns", record.started_ns},
                   {"ended_ns", record.ended_ns},
                   {"seconds", record.run.seconds},
                   {"cpu_seconds", record.run.cpu_seconds},
                   {"peak_memory_bytes", record.run.peak_memory_bytes},
                   {"stamps", record.stamps}});
  return write_json(place_of(job.state(), record.drive), json);
}

}  // namespace terracut::cli
