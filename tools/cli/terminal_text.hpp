// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>
#include <string_view>

/// Texts that others wrote, names of files above all, on their way to a terminal or a shell.
namespace terracut::cli {

/// Control characters but for line ends, and bytes that are no UTF-8, become '?': nothing in it can
/// move the cursor, set a title or wipe a line.
[[nodiscard]] std::string for_terminal(std::string_view text);
/// The same with line ends: what is one line stays one.
[[nodiscard]] std::string line_for_terminal(std::string_view text);

/// One word of a POSIX shell, in quotes. A text with control characters or bytes that are no UTF-8
/// is written as bash, zsh and ksh take it: $'a\x1bb'.
[[nodiscard]] std::string shell_word(std::string_view text);

[[nodiscard]] bool is_utf8(std::string_view text);

}  // namespace terracut::cli
