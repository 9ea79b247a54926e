// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "rt/error.hpp"

struct evp_md_ctx_st;  // OpenSSL's EVP_MD_CTX

namespace terracut::cli {

/// Computes the SHA-256 (FIPS 180-4) of data added piece by piece. For one thread.
class ContentHash {
 public:
  /// Throws std::bad_alloc if OpenSSL cannot be used.
  ContentHash();

  void add(std::span<const std::byte> bytes);
  void add(std::string_view text) { add(std::as_bytes(std::span(text.data(), text.size()))); }
  /// Returns the 64 digits that sha256sum prints. Call it once.
  [[nodiscard]] std::string digits();

 private:
  struct Free {
    void operator()(evp_md_ctx_st* context) const noexcept;
  };
  std::unique_ptr<evp_md_ctx_st, Free> context_;
};

/// Hashes a whole file. Fails with kNotFound, kUnreadable, or kNothingCameOut when stop_wanted().
[[nodiscard]] Expected<std::string> sha256_of_file(const std::filesystem::path& path);

[[nodiscard]] std::string sha256_of(std::string_view text);
/// Number of digits for the first 64 bits of a hash.
inline constexpr std::size_t kShortHashDigits = 16;
[[nodiscard]] std::string short_hash(std::string_view text);

}  // namespace terracut::cli
