// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Simulates live runs, seed after seed: see ./tools/simulate_live.
#include <fmt/format.h>
#include <unistd.h>

#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <optional>
#include <string>
#include <string_view>

#include "tests/simulation/simulated_run.hpp"

namespace terracut::simulation {
namespace {

constexpr int kUsage = 2, kBroken = 1;
constexpr unsigned kLongestRun_s =
    300;  ///< No run takes so long unless something goes on for ever.

/// The run that is simulated now, told where it ends the program.
std::string simulated_now;

/// Tells which run it was, and ends the program.
void tell_of_crash(int signal) {
  const std::string& run = simulated_now;
  (void)!::write(STDOUT_FILENO, run.data(), run.size());
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

struct Options {
  std::uint64_t seed = 1;
  double hours = 0.1;
  std::optional<Faults> faults;
  std::optional<bool> has_real_method;
  bool goes_on = false;
};

template <class Number>
bool read(std::string_view text, Number& number) {
  const char* const end = text.data() + text.size();
  return std::from_chars(text.data(), end, number).ptr == end;
}

std::optional<Options> options_of(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string_view option = argv[i];
    if (option == "--real" || option == "--cached") {
      options.has_real_method = option == "--real";
      continue;
    }
    if (option == "--go-on") {
      options.goes_on = true;
      continue;
    }
    if (++i == argc) return std::nullopt;
    if (option == "--seed" && read(argv[i], options.seed)) continue;
    if (option == "--hours" && read(argv[i], options.hours)) continue;
    if (option != "--faults") return std::nullopt;
    auto faults = parse_faults(argv[i]);
    if (!faults) {
      fmt::print(stderr, "error: {}\n", faults.error().message);
      return std::nullopt;
    }
    options.faults = *std::move(faults);
  }
  return options;
}

std::string repeat(const Plan& plan) {
  return fmt::format("./tools/simulate_live --seed {} {} --faults \"{}\"", plan.seed,
                     plan.has_real_method ? "--real" : "--cached", to_string(plan.faults));
}

Outcome told_simulation(const Plan& plan) {
  simulated_now =
      fmt::format("seed {}: crashed or went on for ever\n  {}\n", plan.seed, repeat(plan));
  ::alarm(kLongestRun_s);
  return simulate(plan);
}

int run(const Options& options) {
  for (const int signal : {SIGABRT, SIGALRM, SIGBUS, SIGFPE, SIGILL, SIGSEGV}) {
    std::signal(signal, tell_of_crash);
  }
  using Clock = std::chrono::steady_clock;
  const auto began = Clock::now();
  auto told = began;
  double simulated_s = 0;
  std::uint64_t frames = 0, compared = 0, runs = 0, broken = 0;
  const auto wall_s = [&] { return std::chrono::duration<double>(Clock::now() - began).count(); };
  const auto tell = [&] {
    fmt::print(
        "{} runs, {:.2f} simulated hours, {} frames, {} compared, {} broken, {:.0f} s; {:.0f} "
        "simulated seconds a second\n",
        runs, simulated_s / 3600, frames, compared, broken, wall_s(), simulated_s / wall_s());
    std::fflush(stdout);
  };
  for (std::uint64_t seed = options.seed;; ++seed) {
    Plan plan = plan_of(seed);
    if (options.faults) plan.faults = *options.faults;
    if (options.has_real_method) plan.has_real_method = *options.has_real_method;
    const Outcome outcome = told_simulation(plan);
    ++runs;
    simulated_s += outcome.simulated_s;
    frames += outcome.frames;
    compared += outcome.frames_compared;
    if (outcome.broken) {
      ++broken;
      fmt::print("seed {}: {}\n", seed, *outcome.broken);
      ::alarm(0);
      const Plan least = shrunk(plan);
      fmt::print("  {}\n  all of it: {}\n", repeat(least), to_string(plan.faults));
      std::fflush(stdout);
      if (!options.goes_on) break;
    } else if (options.faults) {
      fmt::print("seed {}: holds, digest {:016x}\n", seed, outcome.digest);
    }
    if (options.faults || simulated_s >= options.hours * 3600) break;
    if (Clock::now() - told > std::chrono::seconds(30)) {
      told = Clock::now();
      tell();
    }
  }
  tell();
  return broken > 0 ? kBroken : 0;
}

}  // namespace
}  // namespace terracut::simulation

int main(int argc, char** argv) {
  const auto options = terracut::simulation::options_of(argc, argv);
  if (!options) {
    fmt::print(stderr,
               "usage: simulate_live [--seed N] [--hours H] [--real | --cached] [--go-on] "
               "[--faults \"KIND@AT_MS+SPAN_MS*AMOUNT ...\"]\n");
    return terracut::simulation::kUsage;
  }
  try {
    return terracut::simulation::run(*options);
  } catch (const std::exception& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return terracut::simulation::kUsage;
  }
}
