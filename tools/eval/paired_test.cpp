// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "paired_test.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace terracut::evaluation {
namespace {

PairedTest summary_of(std::span<const double> differences) {
  PairedTest test;
  test.pairs = differences.size();
  for (const double difference : differences) {
    test.better += difference > 0 ? 1 : 0;
    test.worse += difference < 0 ? 1 : 0;
    test.mean += difference;
  }
  if (!differences.empty()) test.mean /= static_cast<double>(differences.size());
  return test;
}

/// Ranks of the sizes, ties at their mean rank.
struct Ranking {
  double positive_sum = 0;  ///< Of the ranks of positive differences.
  double tie_term = 0;      ///< Sum of t^3 - t over groups of t ties.
};

Ranking rank(std::vector<double>& differences) {
  std::ranges::sort(differences, {}, [](double d) { return std::abs(d); });
  Ranking ranking;
  for (std::size_t begin = 0, end = 0; begin < differences.size(); begin = end) {
    while (end < differences.size() && std::abs(differences[end]) == std::abs(differences[begin])) {
      ++end;
    }
    const double mean_rank = 0.5 * static_cast<double>(begin + 1 + end);
    for (std::size_t i = begin; i < end; ++i) {
      if (differences[i] > 0) ranking.positive_sum += mean_rank;
    }
    const auto ties = static_cast<double>(end - begin);
    ranking.tie_term += ties * ties * ties - ties;
  }
  return ranking;
}

/// Of the 2^n ways to sign the ranks 1..n, the share whose positive sum is at most `sum`.
double exact_tail(std::size_t n, double sum) {
  std::vector<double> ways(n * (n + 1) / 2 + 1);
  ways[0] = 1;
  for (std::size_t r = 1; r <= n; ++r) {
    for (std::size_t s = ways.size(); s-- > r;) ways[s] += ways[s - r];
  }
  const auto last = static_cast<std::size_t>(std::floor(sum));
  const double at_most = std::accumulate(
      ways.begin(), ways.begin() + static_cast<std::ptrdiff_t>(std::min(last + 1, ways.size())),
      0.0);
  return at_most / std::ldexp(1.0, static_cast<int>(n));
}

}  // namespace

PairedTest signed_rank_test(std::span<const double> differences) {
  PairedTest test = summary_of(differences);
  std::vector<double> nonzero;
  std::ranges::copy_if(differences, std::back_inserter(nonzero), [](double d) { return d != 0; });
  if (nonzero.empty()) return test;
  const Ranking ranking = rank(nonzero);
  const auto n = static_cast<double>(nonzero.size());
  const double all = n * (n + 1) / 2;
  const double smaller = std::min(ranking.positive_sum, all - ranking.positive_sum);
  constexpr std::size_t kExact = 25;
  if (nonzero.size() <= kExact && ranking.tie_term == 0) {
    test.p = std::min(1.0, 2 * exact_tail(nonzero.size(), smaller));
    return test;
  }
  const double variance = n * (n + 1) * (2 * n + 1) / 24 - ranking.tie_term / 48;
  const double z = std::max(0.0, all / 2 - smaller - 0.5) / std::sqrt(variance);
  test.p = std::erfc(z / std::sqrt(2.0));
  return test;
}

PairedTest sign_flip_test(std::span<const double> differences) {
  constexpr std::size_t kMost = 20;
  if (differences.size() > kMost) throw std::invalid_argument("too many differences for all signs");
  PairedTest test = summary_of(differences);
  const double size = std::abs(std::accumulate(differences.begin(), differences.end(), 0.0));
  if (size == 0) return test;
  const double allowance = 1e-12 * size;  // sums in another order round differently
  const std::uint32_t ways = std::uint32_t{1} << differences.size();
  std::uint32_t as_large = 0;
  for (std::uint32_t signs = 0; signs < ways; ++signs) {
    double sum = 0;
    for (std::size_t i = 0; i < differences.size(); ++i) {
      sum += (signs >> i & 1U) != 0 ? -differences[i] : differences[i];
    }
    as_large += std::abs(sum) >= size - allowance ? 1 : 0;
  }
  test.p = static_cast<double>(as_large) / static_cast<double>(ways);
  return test;
}

}  // namespace terracut::evaluation
