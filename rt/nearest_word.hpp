// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <span>
#include <string_view>

namespace terracut::rt {

/// Returns the word of `words` that was probably meant by one that is none of them: the nearest by
/// edits (a letter added, left out, replaced, or two swapped); of equally near ones the first. A
/// word that begins with `word` is one edit away. Empty if all are farther than one edit plus one
/// for every four letters.
[[nodiscard]] std::string_view nearest_word(std::string_view word,
                                            std::span<const std::string_view> words);

}  // namespace terracut::rt
