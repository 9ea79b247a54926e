// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "system_view.hpp"

#include <sys/timex.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <system_error>

#include "rt/number_of.hpp"

namespace terracut::doctor {
namespace {

using rt::number_of;

constexpr std::size_t kMostBytes = std::size_t{1} << 20;
constexpr int kMostCores = 8192;  // the kernel's own limit

std::optional<ClockState> clock_of_this_machine() {
  timex state{};  // modes is 0: only reads the clock
  const int answer = ::adjtimex(&state);
  if (answer < 0) return std::nullopt;
  return ClockState{.synchronised = answer != TIME_ERROR && (state.status & STA_UNSYNC) == 0,
                    .max_error_s = static_cast<double>(state.maxerror) * 1e-6};
}

}  // namespace

SystemView SystemView::of_this_machine() {
  return SystemView("/", clock_of_this_machine());
}

std::optional<std::string> SystemView::text(std::string_view path) const {
  std::ifstream file(root_ / path, std::ios::binary);
  if (!file) return std::nullopt;
  std::string content(kMostBytes, '\0');
  file.read(content.data(), static_cast<std::streamsize>(content.size()));
  if (file.bad() || (file.fail() && !file.eof())) return std::nullopt;
  content.resize(static_cast<std::size_t>(file.gcount()));
  // For a text of white space alone this is npos + 1, which is 0.
  content.resize(content.find_last_not_of(" \t\r\n") + 1);
  return content;
}

std::optional<std::int64_t> SystemView::number(std::string_view path) const {
  const std::optional<std::string> content = text(path);
  if (!content) return std::nullopt;
  const std::vector<std::string> words = words_of(*content);
  return words.empty() ? std::nullopt : number_of<std::int64_t>(words.front());
}

std::vector<std::string> SystemView::names_in(std::string_view folder) const {
  std::vector<std::string> names;
  std::error_code error;
  for (std::filesystem::directory_iterator entry(root_ / folder, error), end;
       !error && entry != end; entry.increment(error)) {
    names.push_back(entry->path().filename().string());
  }
  std::ranges::sort(names);
  return names;
}

bool SystemView::exists(std::string_view path) const {
  std::error_code error;
  return std::filesystem::exists(root_ / path, error);
}

const std::set<std::string>& SystemView::processes() const {
  if (!processes_) {
    processes_.emplace();
    for (const std::string& name : names_in("proc")) {
      if (!number_of<int>(name)) continue;
      if (auto command = text("proc/" + name + "/comm")) processes_->insert(*std::move(command));
    }
  }
  return *processes_;
}

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines;
  std::istringstream stream{std::string(text)};
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> words_of(std::string_view line) {
  std::vector<std::string> words;
  std::istringstream stream{std::string(line)};
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

std::set<int> numbers_of_list(std::string_view list) {
  std::set<int> numbers;
  while (!list.empty()) {
    const std::size_t comma = list.find(',');
    const std::string_view part = list.substr(0, comma);
    const std::size_t dash = part.find('-');
    const std::optional<int> first = number_of<int>(part.substr(0, dash));
    const std::optional<int> last =
        dash == std::string_view::npos ? first : number_of<int>(part.substr(dash + 1));
    if (!first || !last || *first < 0 || *last >= kMostCores) return {};
    for (int number = *first; number <= *last; ++number) numbers.insert(number);
    list = comma == std::string_view::npos ? std::string_view{} : list.substr(comma + 1);
  }
  return numbers;
}

std::optional<std::string> line_after(std::string_view text, std::string_view start) {
  for (const std::string& line : lines_of(text)) {
    if (!line.starts_with(start)) continue;
    const std::size_t begin = line.find_first_not_of(" \t", start.size());
    return begin == std::string::npos ? std::string() : line.substr(begin);
  }
  return std::nullopt;
}

}  // namespace terracut::doctor
