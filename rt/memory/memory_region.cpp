// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/memory/memory_region.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <limits>
#include <string>
#include <system_error>
#include <utility>

namespace terracut::memory {
namespace {

constexpr std::size_t kLargePage = std::size_t{2} << 20;

std::string in_mib(std::size_t bytes) {
  return std::to_string((bytes + (1U << 20) - 1) >> 20) + " MiB";
}

threads::Grant ask_for_large_pages(std::span<std::byte> region) {
  threads::Grant grant{.asked = "large pages for " + in_mib(region.size())};
  if (::madvise(region.data(), region.size(), MADV_HUGEPAGE) == 0) {
    grant.granted = true;
    grant.in_force = "used wherever memory is not fragmented";
    return grant;
  }
  grant.error_number = errno;
  grant.in_force = "small pages are used";
  grant.mend =
      "needs a kernel with transparent huge pages, and 'echo madvise | sudo tee "
      "/sys/kernel/mm/transparent_hugepage/enabled'";
  return grant;
}

threads::Grant ask_for_locking(std::span<std::byte> region) {
  threads::Grant grant{.asked = "locking of " + in_mib(region.size())};
  if (::mlock(region.data(), region.size()) == 0) {
    grant.granted = true;
    grant.in_force = "it stays in memory";
    return grant;
  }
  grant.error_number = errno;
  grant.in_force = "it can be swapped out when the machine runs short of memory";
  grant.mend = threads::mend_memory_lock();
  return grant;
}

}  // namespace

MemoryRegion::MemoryRegion(MemoryRegion&& other) noexcept
    : bytes_(std::exchange(other.bytes_, {})),
      mapping_(std::exchange(other.mapping_, {})),
      grants_(std::move(other.grants_)) {}

MemoryRegion& MemoryRegion::operator=(MemoryRegion&& other) noexcept {
  std::swap(bytes_, other.bytes_);
  std::swap(mapping_, other.mapping_);
  std::swap(grants_, other.grants_);
  return *this;
}

MemoryRegion::~MemoryRegion() {
  if (!mapping_.empty()) ::munmap(mapping_.data(), mapping_.size());
}

Expected<MemoryRegion> MemoryRegion::map(std::size_t bytes, const RegionRequest& request) {
  MemoryRegion region;
  if (bytes == 0) return region;
  const auto no_memory = [&](int error_number) {
    return fail(ErrorCode::kCapacityExceeded,
                "the system does not give " + in_mib(bytes) + " of memory (" +
                    std::generic_category().message(error_number) +
                    "). Free some, or raise the limit that 'ulimit -v' or the container sets");
  };
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  // A large page begins at a multiple of its size, so one more than needed is mapped.
  const std::size_t unit = request.large_pages ? kLargePage : page;
  if (bytes > std::numeric_limits<std::size_t>::max() - 2 * unit) return no_memory(ENOMEM);
  const std::size_t usable = (bytes + unit - 1) / unit * unit;
  const std::size_t mapped = usable + unit - page;
  // Maps without access at first: if all memory of the process is locked already, the kernel would
  // make the pages present at once, as small ones, before large ones can be asked for.
  void* base = ::mmap(nullptr, mapped, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (base == MAP_FAILED) return no_memory(errno);
  region.mapping_ = {static_cast<std::byte*>(base), mapped};
  const std::size_t skipped = (unit - reinterpret_cast<std::uintptr_t>(base) % unit) % unit;
  const std::span<std::byte> whole = region.mapping_.subspan(skipped, usable);
  region.bytes_ = whole.first(bytes);

  if (request.large_pages) region.grants_.push_back(ask_for_large_pages(whole));
  if (::mprotect(whole.data(), whole.size(), PROT_READ | PROT_WRITE) != 0) return no_memory(errno);
  for (std::size_t at = 0; at < whole.size(); at += page) {
    // Writes to each page: a read would only map the shared page of zeros.
    *const_cast<volatile std::byte*>(&whole[at]) = std::byte{0};
  }
  // Keeps the kernel from joining small pages into larger ones later, which would stop a thread
  // that touches them. A refusal does no harm.
  (void)::madvise(whole.data(), whole.size(), MADV_NOHUGEPAGE);
  if (request.lock) region.grants_.push_back(ask_for_locking(whole));
  return region;
}

}  // namespace terracut::memory
