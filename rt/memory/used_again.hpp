// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace terracut::memory {

/// Recycles objects: an object whose last holder has dropped it is handed out again, with the
/// memory it holds. Keeps at most as many objects as are held at a time, plus kMostSpare. Any
/// thread without a deadline.
template <class T>
class UsedAgain {
 public:
  /// Returns an object, which may still have the content of a former use and may outlive this pool.
  [[nodiscard]] std::shared_ptr<T> take() {
    std::unique_ptr<T> thing;
    {
      const std::scoped_lock lock(spare_->mutex);
      if (!spare_->things.empty()) {
        thing = std::move(spare_->things.back());
        spare_->things.pop_back();
      }
    }
    if (!thing) thing = std::make_unique<T>();
    return {thing.release(), [spare = spare_](T* dropped) {
              std::unique_ptr<T> owned(dropped);
              const std::scoped_lock lock(spare->mutex);
              if (spare->things.size() < kMostSpare) spare->things.push_back(std::move(owned));
            }};
  }

 private:
  /// The most spares kept: one just dropped, and one that the next user fills.
  static constexpr std::size_t kMostSpare = 2;
  struct Spare {
    Spare() { things.reserve(kMostSpare); }
    std::mutex mutex;
    std::vector<std::unique_ptr<T>> things;
  };
  std::shared_ptr<Spare> spare_ = std::make_shared<Spare>();
};

}  // namespace terracut::memory
