// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "content_hash.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <new>
#include <system_error>
#include <vector>

#include "rt/files/plain_file.hpp"
#include "tools/cli/stop_signal.hpp"

namespace terracut::cli {
namespace {

/// Large enough for network file systems, small enough for the processor's cache.
constexpr std::size_t kReadBytes = std::size_t{1} << 20;

}  // namespace

void ContentHash::Free::operator()(evp_md_ctx_st* context) const noexcept {
  EVP_MD_CTX_free(context);
}

ContentHash::ContentHash() : context_(EVP_MD_CTX_new()) {
  if (!context_ || EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) != 1) {
    throw std::bad_alloc();
  }
}

void ContentHash::add(std::span<const std::byte> bytes) {
  EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size());
}

std::string ContentHash::digits() {
  std::array<unsigned char, EVP_MAX_MD_SIZE> hash{};
  unsigned int size = 0;
  EVP_DigestFinal_ex(context_.get(), hash.data(), &size);
  std::string digits;
  for (unsigned int i = 0; i < size; ++i) digits += fmt::format("{:02x}", hash[i]);
  return digits;
}

Expected<std::string> sha256_of_file(const std::filesystem::path& path) {
  const auto file = files::open_plain_file(path);
  if (!file) return tl::unexpected(file.error());
  ContentHash hash;
  std::vector<std::byte> part(kReadBytes);
  for (;;) {
    if (const Status on = go_on(); !on) return tl::unexpected(on.error());
    const ::ssize_t read = ::read(file->get(), part.data(), part.size());
    if (read < 0 && errno == EINTR) continue;
    if (read < 0) {
      return fail(ErrorCode::kUnreadable,
                  fmt::format("{}: {}", path.string(), std::generic_category().message(errno)));
    }
    if (read == 0) break;
    hash.add(std::span(part).first(static_cast<std::size_t>(read)));
  }
  return hash.digits();
}

std::string sha256_of(std::string_view text) {
  ContentHash hash;
  hash.add(text);
  return hash.digits();
}

std::string short_hash(std::string_view text) {
  return sha256_of(text).substr(0, kShortHashDigits);
}

}  // namespace terracut::cli
