// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <fmt/format.h>
#include <lz4frame.h>

#include <algorithm>
#include <memory>

#include "firmware_io/bag/unpacked.hpp"

namespace terracut::bag {
namespace {

struct FreeContext {
  void operator()(LZ4F_dctx* context) const noexcept { LZ4F_freeDecompressionContext(context); }
};

}  // namespace

Status unpack_lz4(std::span<const std::byte> packed, std::vector<std::byte>& plain) {
  constexpr std::size_t kStep = std::size_t{1} << 20;
  LZ4F_dctx* made = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&made, LZ4F_VERSION)) != 0) {
    return fail(ErrorCode::kMalformed, "lz4: no memory to unpack it");
  }
  const std::unique_ptr<LZ4F_dctx, FreeContext> context(made);
  std::size_t filled = 0, left = 1;
  while (left != 0 || !packed.empty()) {
    if (filled == plain.size()) {
      if (filled == kMostBytes) {
        return fail(ErrorCode::kMalformed,
                    fmt::format("unpacks to more than {} MiB", kMostBytes >> 20));
      }
      plain.resize(std::min(kMostBytes, filled + std::max(kStep, filled)));
    }
    std::size_t out = plain.size() - filled, in = packed.size();
    left = LZ4F_decompress(context.get(), plain.data() + filled, &out, packed.data(), &in, nullptr);
    filled += LZ4F_isError(left) != 0 ? 0 : out;
    if (LZ4F_isError(left) != 0 || (left != 0 && out == 0 && in == 0)) {
      plain.resize(filled);
      return fail(ErrorCode::kMalformed,
                  fmt::format("lz4: {}", LZ4F_isError(left) != 0 ? LZ4F_getErrorName(left)
                                                                 : "the data end too early"));
    }
    packed = packed.subspan(in);
  }
  plain.resize(filled);
  return {};
}

}  // namespace terracut::bag
