// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rt/error.hpp"

/// Functions shared by the readers of cloud files.
namespace terracut::cloud {

/// Enough for 256 bytes a point of any frame.
inline constexpr std::uintmax_t kMostCloudBytes = std::uintmax_t{1} << 28;

/// Returns the whole file. kNotFound, kUnreadable, kMalformed (larger than any frame), naming it.
[[nodiscard]] Expected<std::string> read_cloud_bytes(const std::filesystem::path& path);

[[nodiscard]] constexpr bool is_printable(char c) noexcept {
  return c >= ' ' && c <= '~';
}
/// Makes a message that quotes a file printable and not too long.
[[nodiscard]] std::string quotable(std::string message);

/// Removes the byte order mark that some editors write first.
[[nodiscard]] std::string_view without_byte_order_mark(std::string_view content) noexcept;

/// Splits a line at blanks into at most `most` words: a line may be a whole file.
void split_words(std::string_view line, std::size_t most, std::vector<std::string_view>& words);
[[nodiscard]] std::vector<std::string_view> words_of(std::string_view line, std::size_t most);
/// Returns "3", or "more than 3" for a line that was split into one word more than `expected`.
[[nodiscard]] std::string count_of(std::span<const std::string_view> words, std::size_t expected);
/// Return the number if the word is nothing else. NaN and infinity may be written as Microsoft's
/// compilers did (1.#QNAN, -1.#IND, 1.#INF).
[[nodiscard]] std::optional<std::size_t> whole_number(std::string_view word) noexcept;
[[nodiscard]] std::optional<double> number(std::string_view word) noexcept;

/// Returns a number of `bytes` bytes (1, 2, 4, 8; floats 4, 8) at any address. `type`: 'I' signed,
/// 'U' unsigned, 'F' float, as in PCD files.
[[nodiscard]] double binary_value(const char* at, char type, std::size_t bytes,
                                  std::endian order = std::endian::little) noexcept;

}  // namespace terracut::cloud
