// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/cloud/cloud_bytes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <fstream>
#include <iterator>
#include <system_error>

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
  std::ifstream file(path, std::ios::binary);
  std::string content{std::istreambuf_iterator<char>(file), {}};
  if (!file || content.size() != bytes) {
    return fail(ErrorCode::kUnreadable, path.string() + ": cannot be read; check its permissions");
  }
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

std::vector<std::string_view> words_of(std::string_view line) {
  constexpr std::string_view kBlank = " \t\r";
  std::vector<std::string_view> words;
  while (true) {
    const std::size_t first = line.find_first_not_of(kBlank);
    if (first == std::string_view::npos) return words;
    line.remove_prefix(first);
    const std::size_t end = std::min(line.find_first_of(kBlank), line.size());
    words.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
}

std::optional<std::size_t> whole_number(std::string_view word) noexcept {
  return all_of_word<std::size_t>(word);
}

std::optional<double> number(std::string_view word) noexcept {
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
