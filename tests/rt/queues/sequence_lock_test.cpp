// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/queues/sequence_lock.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <optional>
#include <set>
#include <utility>

namespace terracut::queues {
namespace {

/// What one writer and one reader may see of each other in the C++ memory model.
///
/// Every place keeps all that was ever stored there. A thread may load any of it that is not older
/// than what it has seen of that place (coherence). A store with release carries along what its
/// thread had seen of all places, and a load of it with acquire takes that over; relaxed ones carry
/// and take nothing. So a load that was reordered, or a store that came late from a cache, is a
/// load of something old.
///
/// The reader stores nothing, so the writer never depends on it: whatever happens at the same time
/// is the writer's whole history, and one choice from it for each load of the reader. All choices
/// are gone through, by doing the same again with the next ones.
class Model {
 public:
  static constexpr std::size_t kPlaces = 4;
  static constexpr std::size_t kMostStores = 16;
  using Seen = std::array<std::size_t, kPlaces>;  // of each place, the newest store known

  void store(std::size_t place, std::uint64_t value, std::memory_order order) {
    ++stores_[place];
    seen_[place] = stores_[place];
    Store& stored = history_[place][stores_[place]];
    stored.value = value;
    stored.carried = Seen{};
    if (order == std::memory_order_release) stored.carried = seen_;
    stored.carried[place] = stores_[place];
  }

  std::uint64_t load(std::size_t place, std::memory_order order) {
    const std::size_t oldest = seen_[place];
    const Store& loaded = history_[place][oldest + choose(stores_[place] - oldest + 1)];
    seen_[place] = std::max(seen_[place], loaded.carried[place]);
    if (order == std::memory_order_acquire) {
      for (std::size_t i = 0; i < kPlaces; ++i) seen_[i] = std::max(seen_[i], loaded.carried[i]);
    }
    return loaded.value;
  }

  /// The reader begins, having seen nothing.
  void begin_reading() {
    seen_ = {};
    depth_ = 0;
  }
  /// Whether there are choices that were not gone through.
  bool has_more() {
    while (depth_ > 0 && ++choices_[depth_ - 1].taken == choices_[depth_ - 1].of) {
      choices_[--depth_] = {};
    }
    return depth_ > 0;
  }

 private:
  struct Store {
    std::uint64_t value = 0;
    Seen carried{};
  };
  struct Choice {
    std::size_t taken = 0, of = 0;
  };

  std::size_t choose(std::size_t of) {
    Choice& choice = choices_[depth_++];
    choice.of = of;
    return choice.taken;
  }

  std::array<std::array<Store, kMostStores>, kPlaces> history_{};  // from the initial value on
  std::array<std::size_t, kPlaces> stores_{};
  Seen seen_{};  // by the thread at work
  std::array<Choice, 32> choices_{};
  std::size_t depth_ = 0;
};

/// In the place of std::atomic<std::uint64_t>.
struct ModelAtomic {
  Model* model = nullptr;
  std::size_t place = 0;

  void store(std::uint64_t value, std::memory_order order) noexcept {
    model->store(place, value, order);
  }
  [[nodiscard]] std::uint64_t load(std::memory_order order) const noexcept {
    return model->load(place, order);
  }
};

/// Three words that belong together.
struct Wide {
  std::array<std::uint64_t, 3> words{};
  static Wide of(std::uint64_t number) { return {{number, 10 * number, 100 * number}}; }
  [[nodiscard]] bool is_whole() const { return *this == of(words[0]); }
  bool operator==(const Wide&) const = default;
};

/// The page of a writer that has published 1 .. `publications`.
struct ModelPage {
  using Lock = SequenceLock<Wide, ModelAtomic>;

  explicit ModelPage(std::uint64_t publications) {
    for (std::size_t i = 0; i < words.size(); ++i) words[i] = {&model, i + 1};
    for (std::uint64_t n = 1; n <= publications; ++n)
      Lock::write(Wide::of(n), sequence, words.data());
  }
  /// The number of the value read, 0 for none, kTorn for half of one and half of another.
  std::uint64_t read(int tries) {
    const auto value = Lock::read(sequence, words.data(), tries);
    if (!value) return 0;
    return value->is_whole() ? value->words[0] : kTorn;
  }
  static constexpr std::uint64_t kTorn = 1000;

  Model model;
  ModelAtomic sequence{&model, 0};
  std::array<ModelAtomic, 3> words;
};

TEST(SequenceLock, GivesNoTornValueWhateverTheMemoryModelAllows) {
  ModelPage page(3);
  std::set<std::uint64_t> read;
  do {
    page.model.begin_reading();
    read.insert(page.read(1));
  } while (page.model.has_more());
  EXPECT_EQ(read, (std::set<std::uint64_t>{0, 1, 2, 3})) << "each of them, and no mixture";
}

TEST(SequenceLock, NeverGoesBackToAnOlderValue) {
  ModelPage page(2);
  std::set<std::pair<std::uint64_t, std::uint64_t>> read;
  do {
    page.model.begin_reading();
    const std::uint64_t first = page.read(1), second = page.read(1);
    read.insert({first, second});
    ASSERT_TRUE(second == 0 || first <= second) << first << " and then " << second;
  } while (page.model.has_more());
  EXPECT_TRUE(read.contains({1, 2}));
}

TEST(SequenceLock, TriesAsOftenAsItIsAskedToWhileSomethingIsWritten) {
  std::atomic<std::uint64_t> sequence{0};
  std::array<std::atomic<std::uint64_t>, 3> words{};
  using Lock = SequenceLock<Wide>;
  EXPECT_EQ(Lock::read(sequence, words.data(), 3), std::nullopt) << "nothing was written yet";
  Lock::write(Wide::of(7), sequence, words.data());
  EXPECT_EQ(Lock::read(sequence, words.data(), 1), Wide::of(7));
  ++sequence;  // the writer stands still here
  EXPECT_EQ(Lock::read(sequence, words.data(), 3), std::nullopt);
}

/// Fills one word and a part of another.
struct Odd {
  std::array<std::uint8_t, 11> bytes{};
  bool operator==(const Odd&) const = default;
};

TEST(SequenceLock, KeepsAValueThatFillsItsLastWordInPart) {
  std::atomic<std::uint64_t> sequence{0};
  std::array<std::atomic<std::uint64_t>, 2> words{};
  static_assert(SequenceLock<Odd>::kWords == words.size());
  Odd odd;
  for (std::size_t i = 0; i < odd.bytes.size(); ++i)
    odd.bytes[i] = static_cast<std::uint8_t>(i + 1);
  SequenceLock<Odd>::write(odd, sequence, words.data());
  EXPECT_EQ(SequenceLock<Odd>::read(sequence, words.data(), 1), odd);
}

}  // namespace
}  // namespace terracut::queues
