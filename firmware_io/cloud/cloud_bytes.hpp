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

/// The largest file read: 256 bytes per point of the largest frame.
inline constexpr std::uintmax_t kMostCloudBytes = std::uintmax_t{1} << 28;

/// Returns the whole file. Fails with kNotFound, kUnreadable, or kMalformed (larger than any
/// frame); the message names the file.
[[nodiscard]] Expected<std::string> read_cloud_bytes(const std::filesystem::path& path);

[[nodiscard]] constexpr bool is_printable(char c) noexcept {
  return c >= ' ' && c <= '~';
}
/// Makes a message that quotes a file printable, and shortens it if needed.
[[nodiscard]] std::string quotable(std::string message);

/// Removes the byte order mark with which some editors begin a file.
[[nodiscard]] std::string_view without_byte_order_mark(std::string_view content) noexcept;

/// Splits a line at blanks into at most `most` words, because a whole file may be one line.
void split_words(std::string_view line, std::size_t most, std::vector<std::string_view>& words);
[[nodiscard]] std::vector<std::string_view> words_of(std::string_view line, std::size_t most);
/// Returns the number of words as text: "3", or "more than 3" if the line has more than `expected`.
/// split_words() must have been called with `expected` + 1.
[[nodiscard]] std::string count_of(std::span<const std::string_view> words, std::size_t expected);
/// Each returns the number that the whole word spells; nothing for any other word. NaN and infinity
/// may be spelled as Microsoft's compilers did (1.#QNAN, -1.#IND, 1.#INF).
[[nodiscard]] std::optional<std::size_t> whole_number(std::string_view word) noexcept;
[[nodiscard]] std::optional<double> number(std::string_view word) noexcept;

/// Reads a number of `bytes` bytes (1, 2, 4 or 8; floats 4 or 8) at any alignment. `type` is 'I'
/// for signed, 'U' for unsigned, 'F' for float, as in PCD files.
[[nodiscard]] double binary_value(const char* at, char type, std::size_t bytes,
                                  std::endian order = std::endian::little) noexcept;

}  // namespace terracut::cloud
