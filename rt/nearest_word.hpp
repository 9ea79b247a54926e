// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <span>
#include <string_view>

namespace terracut::rt {

/// Returns which of `words` was probably meant by `word`, which is none of them: the one fewest
/// edits away (a letter added, left out, replaced, or two swapped); of equally near words the
/// first. A word that begins with `word` counts as one edit away. Returns an empty text if all need
/// more edits than one plus one for every four letters.
[[nodiscard]] std::string_view nearest_word(std::string_view word,
                                            std::span<const std::string_view> words);

}  // namespace terracut::rt
