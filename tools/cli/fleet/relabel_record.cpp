// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "relabel_record.hpp"

#include <fmt/format.h>

#include <fstream>

#include "tools/cli/json_text.hpp"

namespace terracut::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

fs::path place_of(const fs::path& state, const std::string& drive) {
  return state / "records" / (drive + ".json");
}

}  // namespace

RelabelRecord read_record(const fs::path& state, const std::string& drive) {
  std::ifstream file(place_of(state, drive), std::ios::binary);
  RelabelRecord record;
  const Json json = Json::parse(file, nullptr, false);
  if (!json.is_object()) return record;
  try {
    record.drive = json.value("drive", "");
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
  } catch (const nlohmann::json::exception&) {
    return {};  // somebody else's file: as good as none
  }
  return record;
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
