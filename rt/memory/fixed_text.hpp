// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <string_view>

namespace terracut::memory {

/// Holds a short text without a pointer, so that it can lie in memory shared between processes.
/// Text longer than Size bytes is cut off. Real-time safe. view() is safe on any bytes, even on a
/// page that another process wrote.
template <std::size_t Size>
class FixedText {
 public:
  FixedText() = default;
  /// Takes anything that converts to a string_view.
  template <class Text>
    requires std::convertible_to<const Text&, std::string_view>
  FixedText(const Text& any_text) noexcept {  // NOLINT(google-explicit-constructor): it is a text
    const std::string_view text = any_text;
    std::copy_n(text.begin(), std::min(text.size(), Size), bytes_.begin());
  }

  /// Returns the text up to the first zero byte; valid as long as this object.
  [[nodiscard]] std::string_view view() const noexcept {
    const auto end = std::find(bytes_.begin(), bytes_.end(), '\0');
    return {bytes_.data(), static_cast<std::size_t>(end - bytes_.begin())};
  }
  [[nodiscard]] bool empty() const noexcept { return bytes_[0] == '\0'; }

 private:
  std::array<char, Size> bytes_{};
};

}  // namespace terracut::memory
