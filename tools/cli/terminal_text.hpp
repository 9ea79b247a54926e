// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>
#include <string_view>

/// Makes texts from elsewhere, above all file names, safe for a terminal or a shell.
namespace terracut::cli {

/// Replaces control characters except line ends, and invalid UTF-8, by '?', so that a text cannot
/// move the cursor, set a title or clear a line.
[[nodiscard]] std::string for_terminal(std::string_view text);
/// Replaces line ends as well, so that the text stays on one line; otherwise like for_terminal().
[[nodiscard]] std::string line_for_terminal(std::string_view text);

/// Returns one word of a POSIX shell, quoted. A text with control characters or invalid UTF-8 is
/// written as bash, zsh and ksh take it: $'a\x1bb'.
[[nodiscard]] std::string shell_word(std::string_view text);

[[nodiscard]] bool is_utf8(std::string_view text);

}  // namespace terracut::cli
