// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/cloud/cloud_bytes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <limits>
#include <system_error>

#include "rt/files/record_file.hpp"

namespace terracut::cloud {
namespace {

template <class T>
std::optional<T> all_of_word(std::string_view word) noexcept {
  T value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

template <class T>
double value_of(const char* at) noexcept {
  T value;
  std::memcpy(&value, at, sizeof(T));
  return static_cast<double>(value);
}

}  // namespace

Expected<std::string> read_cloud_bytes(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    return fail(ErrorCode::kNotFound, path.string() + ": no such file");
  }
  const std::uintmax_t bytes = std::filesystem::file_size(path, error);
  if (error) return fail(ErrorCode::kUnreadable, path.string() + ": " + error.message());
  if (bytes > kMostCloudBytes) {
    return fail(ErrorCode::kMalformed, fmt::format("{}: {} bytes, expected at most {}, one frame",
                                                   path.string(), bytes, kMostCloudBytes));
  }
  std::string content(static_cast<std::size_t>(bytes), '\0');
  const Status read = files::read_bytes(path, content.data(), content.size());
  if (!read) return tl::unexpected(read.error());
  return content;
}

std::string quotable(std::string message) {
  constexpr std::size_t kMostCharacters = 200;
  if (message.size() > kMostCharacters) {
    message.replace(kMostCharacters, std::string::npos, "...");
  }
  std::ranges::replace_if(
      message, [](char c) { return !is_printable(c); }, '?');
  return message;
}

std::string_view without_byte_order_mark(std::string_view content) noexcept {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  return content.starts_with(kMark) ? content.substr(kMark.size()) : content;
}

void split_words(std::string_view line, std::size_t most, std::vector<std::string_view>& words) {
  constexpr std::string_view kBlank = " \t\r";
  words.clear();
  while (words.size() < most) {
    const std::size_t first = line.find_first_not_of(kBlank);
    if (first == std::string_view::npos) return;
    line.remove_prefix(first);
    const std::size_t end = std::min(line.find_first_of(kBlank), line.size());
    words.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
}

std::vector<std::string_view> words_of(std::string_view line, std::size_t most) {
  std::vector<std::string_view> words;
  split_words(line, most, words);
  return words;
}

std::string count_of(std::span<const std::string_view> words, std::size_t expected) {
  if (words.size() <= expected) return std::to_string(words.size());
  return fmt::format("more than {}", expected);
}

std::optional<std::size_t> whole_number(std::string_view word) noexcept {
  return all_of_word<std::size_t>(word);
}

std::optional<double> number(std::string_view word) noexcept {
  if (const auto value = all_of_word<double>(word)) return value;
  const bool is_negative = word.starts_with('-');
  if (is_negative || word.starts_with('+')) word.remove_prefix(1);
  if (word.starts_with("1.#")) {
    const double infinity = std::numeric_limits<double>::infinity();
    if (word.starts_with("1.#INF")) return is_negative ? -infinity : infinity;
    return std::numeric_limits<double>::quiet_NaN();
  }
  if (is_negative || word.starts_with('-')) return std::nullopt;
  return all_of_word<double>(word);
}

double binary_value(const char* at, char type, std::size_t bytes, std::endian order) noexcept {
  std::array<char, 8> native{};
  std::memcpy(native.data(), at, bytes);
  if (order != std::endian::native) std::reverse(native.begin(), native.begin() + bytes);
  if (type == 'F')
    return bytes == 4 ? value_of<float>(native.data()) : value_of<double>(native.data());
  const bool is_signed = type == 'I';
  switch (bytes) {
    case 1:
      return is_signed ? value_of<std::int8_t>(native.data())
                       : value_of<std::uint8_t>(native.data());
    case 2:
      return is_signed ? value_of<std::int16_t>(native.data())
                       : value_of<std::uint16_t>(native.data());
    case 4:
      return is_signed ? value_of<std::int32_t>(native.data())
                       : value_of<std::uint32_t>(native.data());
    default:
      return is_signed ? value_of<std::int64_t>(native.data())
                       : value_of<std::uint64_t>(native.data());
  }
}

}  // namespace terracut::cloud
