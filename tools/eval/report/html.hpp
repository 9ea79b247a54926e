// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace terracut::evaluation::report {

/// Text as it may stand in an element or in a quoted attribute.
[[nodiscard]] std::string escaped(std::string_view text);

/// RFC 4648, with padding.
[[nodiscard]] std::string base64(std::span<const std::byte> bytes);

/// `<img>` with a PNG file inside. `alternative`: what stands there for who cannot see it.
/// width x height in pixels of the page.
[[nodiscard]] std::string png_element(std::span<const std::byte> png, int width, int height,
                                      std::string_view alternative);

}  // namespace terracut::evaluation::report
