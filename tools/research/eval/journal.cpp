// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "journal.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

namespace terracut::eval {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kKind = "terracut evaluation journal";
constexpr int kVersion = 3;

Error write_failed(const std::filesystem::path& path) {
  return {ErrorCode::kWriteFailed, fmt::format("{}: {}", path.string(), std::strerror(errno))};
}

Status append(const std::filesystem::path& path, int file, const std::string& line) {
  // Makes one call per line: a killed process leaves only whole lines, except perhaps the last.
  const std::string text = line + "\n";
  std::size_t done = 0;
  while (done < text.size()) {
    const ::ssize_t written = ::write(file, text.data() + done, text.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return tl::unexpected(write_failed(path));
    done += static_cast<std::size_t>(written);
  }
  return {};
}

std::string header_line(const std::string& settings) {
  return Json{{"kind", kKind}, {"version", kVersion}, {"settings", settings}}.dump();
}

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

/// Returns those words of `text` that are missing from `other`, but no more than a person wants to
/// read.
std::string words_missing(const std::string& text, const std::string& other) {
  constexpr std::size_t kShown = 8;
  const std::vector<std::string> others = words_of(other);
  std::string missing;
  std::size_t count = 0;
  for (const std::string& word : words_of(text)) {
    if (std::ranges::find(others, word) != others.end()) continue;
    if (++count <= kShown) missing += (missing.empty() ? "" : " ") + word;
  }
  if (count > kShown) missing += fmt::format(" and {} more", count - kShown);
  return missing.empty() ? "nothing else" : missing;
}

Status check_header(const std::filesystem::path& path, const std::string& line,
                    const std::string& settings) {
  const Json header = Json::parse(line, nullptr, false);
  if (!header.is_object() || header.value("kind", "") != kKind ||
      header.value("version", 0) != kVersion) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("{} is no journal of this program's evaluations; remove it or choose "
                            "another --json",
                            path.string()));
  }
  const std::string found = header.value("settings", "");
  if (found == settings) return {};
  return fail(
      ErrorCode::kInvalidArgument,
      fmt::format("{} was begun with other settings; go on with those, remove it, or "
                  "choose another --json.\n  there: {}\n  now:   {}",
                  path.string(), words_missing(found, settings), words_missing(settings, found)));
}

Json counts_json(const statistics::FrameCounts& counts) {
  Json list = Json::array();
  for (const auto& [key, labels] : counts.by_class_and_band()) {
    list.push_back({key.class_id, key.band, labels.ground, labels.obstacle, labels.other_ground});
  }
  return list;
}

statistics::FrameCounts counts_of(const Json& list) {
  statistics::FrameCounts counts;
  for (const Json& entry : list) {
    counts.add({entry.at(0).get<std::uint16_t>(), entry.at(1).get<std::uint8_t>()},
               {entry.at(2).get<std::uint64_t>(), entry.at(3).get<std::uint64_t>(),
                entry.at(4).get<std::uint64_t>()});
  }
  return counts;
}

}  // namespace

std::string journal_line(const FrameKey& key, const FrameResult& result) {
  Json json{{"sequence", key.sequence}, {"frame", key.frame}, {"method", key.method}};
  json["points"] = result.points;
  json["non_finite"] = result.non_finite;
  json["no_ring"] = result.no_ring;
  json["not_placed"] = result.not_placed;
  json["rings_realigned"] = result.rings_realigned;
  json["counts"] = counts_json(result.counts);
  json["tall"] = {result.tall.returns, result.tall.as_ground};
  json["flips"] = {result.flips.returns, result.flips.flips, result.flips.true_flips};
  json["stage_ns"] = result.times.stage_ns;
  json["decode_ns"] = result.times.decode_ns;
  json["segment_ns"] = result.times.segment_ns;
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Expected<std::pair<FrameKey, FrameResult>> parse_journal_line(const std::string& line) {
  try {
    const Json json = Json::parse(line);
    std::pair<FrameKey, FrameResult> entry;
    entry.first = {json.at("sequence").get<std::string>(), json.at("frame").get<std::string>(),
                   json.at("method").get<std::string>()};
    FrameResult& result = entry.second;
    result.points = json.at("points").get<std::uint64_t>();
    result.non_finite = json.at("non_finite").get<std::uint64_t>();
    result.no_ring = json.at("no_ring").get<std::uint64_t>();
    result.not_placed = json.at("not_placed").get<std::uint64_t>();
    result.rings_realigned = json.at("rings_realigned").get<bool>();
    result.counts = counts_of(json.at("counts"));
    const Json& tall = json.at("tall");
    result.tall = {tall.at(0).get<std::uint64_t>(), tall.at(1).get<std::uint64_t>()};
    const Json& flips = json.at("flips");
    result.flips = {flips.at(0).get<std::uint64_t>(), flips.at(1).get<std::uint64_t>(),
                    flips.at(2).get<std::uint64_t>()};
    json.at("stage_ns").get_to(result.times.stage_ns);
    result.times.decode_ns = json.at("decode_ns").get<std::int64_t>();
    result.times.segment_ns = json.at("segment_ns").get<std::int64_t>();
    return entry;
  } catch (const Json::exception& error) {
    return fail(ErrorCode::kMalformed, error.what());
  }
}

Expected<Journal> Journal::open(const std::filesystem::path& path, const std::string& settings) {
  std::error_code ignored;  // a failure shows when the file is opened below
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), ignored);
  files::OwnedDescriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666));
  if (file.get() < 0) return tl::unexpected(write_failed(path));
  if (::flock(file.get(), LOCK_EX | LOCK_NB) != 0) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("{}: another evaluation is writing it; wait for it, or choose another "
                            "--json",
                            path.string()));
  }
  std::string text;
  {
    std::ifstream written(path, std::ios::binary);
    text.assign(std::istreambuf_iterator<char>(written), {});
  }
  const std::size_t whole = text.rfind('\n') + 1;  // npos + 1 is 0
  FrameResults results;
  std::size_t number = 0;
  for (std::size_t begin = 0; begin < whole;) {
    const std::size_t end = text.find('\n', begin);
    const std::string line = text.substr(begin, end - begin);
    begin = end + 1;
    if (number++ == 0) {
      const Status fits = check_header(path, line, settings);
      if (!fits) return tl::unexpected(fits.error());
      continue;
    }
    auto entry = parse_journal_line(line);
    if (!entry) {
      return fail(ErrorCode::kMalformed,
                  fmt::format("{}: line {}: {}", path.string(), number, entry.error().message));
    }
    results.insert_or_assign(std::move(entry->first), std::move(entry->second));
  }

  const auto length = static_cast<::off_t>(whole);
  if (::ftruncate(file.get(), length) != 0 || ::lseek(file.get(), length, SEEK_SET) != length) {
    return tl::unexpected(write_failed(path));
  }
  if (number == 0) {
    const Status begun = append(path, file.get(), header_line(settings));
    if (!begun) return tl::unexpected(begun.error());
  }
  return Journal(path, std::move(file), std::move(results));
}

Status Journal::add(const FrameKey& key, const FrameResult& result) {
  const std::string line = journal_line(key, result);
  const std::scoped_lock lock(*mutex_);
  return append(path_, file_.get(), line);
}

}  // namespace terracut::eval
