// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <span>
#include <string_view>

namespace terracut::rt {

/// Which of `words` was meant by one that is none of them: the nearest by edits (a letter added,
/// left out, replaced, or two swapped), of equally near ones the first; a word that begins with it
/// is one edit away. Empty where none is near: more than one edit, and one more for every four
/// letters.
[[nodiscard]] std::string_view nearest_word(std::string_view word,
                                            std::span<const std::string_view> words);

}  // namespace terracut::rt
