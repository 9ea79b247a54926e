// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "dump_answer.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <nlohmann/json.hpp>
#include <system_error>

#include "rt/files/owned_descriptor.hpp"
#include "rt/files/trusted_file.hpp"
#include "rt/files/whole_file.hpp"

namespace terracut::cli {
namespace {

std::filesystem::path answer_path(const std::filesystem::path& folder, const std::string& name) {
  return folder / (name + ".terracut-dump");
}

/// Returns an absolute path, because the asking process may be in another folder.
std::string place_for_others(const std::filesystem::path& path) {
  std::error_code unknown;
  const auto absolute = std::filesystem::absolute(path, unknown);
  return unknown ? path.string() : absolute.string();
}

/// Returns a file's content if only the reader, root or a service can have written it; else
/// nothing.
std::string trusted_content(const std::filesystem::path& path) {
  constexpr std::size_t kMost = 65536;
  const files::OwnedDescriptor file(
      ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  struct ::stat status{};
  if (!file || ::fstat(file.get(), &status) != 0 || !files::check_trusted(status, path)) return {};
  std::string content(kMost, '\0');
  const ::ssize_t got = ::read(file.get(), content.data(), content.size());
  content.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
  return content;
}

}  // namespace

DumpAnswers::DumpAnswers(const std::filesystem::path& folder, const std::string& name)
    : path_(answer_path(folder, name)) {}

DumpAnswers::~DumpAnswers() {
  std::error_code ignored;
  if (serial_ > 0) std::filesystem::remove(path_, ignored);
}

Status DumpAnswers::publish(
    const tl::expected<recorder::DumpReport, recorder::RefusedDump>& outcome) {
  nlohmann::json json{{"pid", ::getpid()}, {"serial", ++serial_}};
  if (outcome) {
    json["capture"] = place_for_others(outcome->capture);
    json["datagrams"] = outcome->datagrams;
    if (!outcome->calibration.empty()) json["calibration"] = place_for_others(outcome->calibration);
    json["seconds"] = static_cast<double>(outcome->last_stamp_ns - outcome->first_stamp_ns) * 1e-9;
  } else {
    json["refusal"] = to_string(outcome.error().refusal);
    json["message"] = outcome.error().message;
  }
  // JSON allows only UTF-8, but a path may have any bytes: other bytes are replaced.
  constexpr auto kReplace = nlohmann::json::error_handler_t::replace;
  return files::write_whole_file(path_, json.dump(1, ' ', false, kReplace) + "\n");
}

std::optional<DumpAnswer> read_dump_answer(const std::filesystem::path& folder,
                                           const std::string& name) {
  const auto json =
      nlohmann::json::parse(trusted_content(answer_path(folder, name)), nullptr, false);
  if (!json.is_object()) return {};
  try {
    return DumpAnswer{.pid = json.at("pid"),
                      .serial = json.at("serial"),
                      .capture = json.value("capture", ""),
                      .calibration = json.value("calibration", ""),
                      .datagrams = json.value("datagrams", std::uint64_t{0}),
                      .seconds = json.value("seconds", 0.0),
                      .refusal = json.value("refusal", ""),
                      .message = json.value("message", "")};
  } catch (const nlohmann::json::exception&) {
    return {};  // not written by this program
  }
}

}  // namespace terracut::cli
