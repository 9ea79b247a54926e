// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "dump_answer.hpp"

#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

#include "rt/whole_file.hpp"

namespace terracut::cli {
namespace {

std::filesystem::path answer_path(const std::filesystem::path& folder, const std::string& name) {
  return folder / (name + ".terracut-dump");
}

}  // namespace

DumpAnswers::DumpAnswers(const std::filesystem::path& folder, const std::string& name)
    : path_(answer_path(folder, name)) {}

DumpAnswers::~DumpAnswers() {
  std::error_code ignored;
  if (serial_ > 0) std::filesystem::remove(path_, ignored);
}

Status DumpAnswers::publish(
    const tl::expected<firmware_io::DumpReport, firmware_io::RefusedDump>& outcome) {
  nlohmann::json json{{"pid", ::getpid()}, {"serial", ++serial_}};
  if (outcome) {
    std::error_code unknown;
    const auto absolute = std::filesystem::absolute(outcome->capture, unknown);
    json["capture"] = unknown ? outcome->capture.string() : absolute.string();
    json["datagrams"] = outcome->datagrams;
    json["seconds"] = static_cast<double>(outcome->last_stamp_ns - outcome->first_stamp_ns) * 1e-9;
  } else {
    json["refusal"] = to_string(outcome.error().refusal);
    json["message"] = outcome.error().message;
  }
  // A path may hold any bytes; JSON may not.
  constexpr auto kReplace = nlohmann::json::error_handler_t::replace;
  return rt::write_whole_file(path_, json.dump(1, ' ', false, kReplace) + "\n");
}

std::optional<DumpAnswer> read_dump_answer(const std::filesystem::path& folder,
                                           const std::string& name) {
  std::ifstream file(answer_path(folder, name));
  const auto json = nlohmann::json::parse(file, nullptr, false);
  if (!json.is_object()) return {};
  try {
    return DumpAnswer{.pid = json.at("pid"),
                      .serial = json.at("serial"),
                      .capture = json.value("capture", ""),
                      .datagrams = json.value("datagrams", std::uint64_t{0}),
                      .seconds = json.value("seconds", 0.0),
                      .refusal = json.value("refusal", ""),
                      .message = json.value("message", "")};
  } catch (const nlohmann::json::exception&) {
    return {};  // somebody else's file
  }
}

}  // namespace terracut::cli
