// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// DBC files as canmatrix understands them: a second opinion on bit numbering, ids and scaling.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <fstream>

#include "firmware_io/vehicle/signal_plan.hpp"
#include "random_dbc.hpp"
#include "tests/firmware_io/can/frames.hpp"
#include "tests/support/places.hpp"
#include "tests/support/scratch_folder.hpp"

namespace terracut::test {
namespace {

using can::CanFrame;
using vehicle::DbcFile;
using vehicle::SignalPlan;

/// A Python that has canmatrix: the first one of the path need not be the distribution's.
std::string python_with_canmatrix() {
  for (const char* python : {"python3", "/usr/bin/python3"}) {
    const std::string command = std::string(python) + " -c 'import canmatrix' >/dev/null 2>&1";
    if (std::system(command.c_str()) == 0) return python;
  }
  return {};
}

TEST(Canmatrix, DecodesRandomSignalsToTheSameValues) {
  const std::string python = python_with_canmatrix();
  if (python.empty()) GTEST_SKIP() << "no python3 with canmatrix (package python3-canmatrix)";
  const ScratchFolder folder;
  std::mt19937 random(77);
  DbcFile file;
  std::ofstream frames(folder / "frames");
  std::vector<CanFrame> sent;
  for (std::uint32_t i = 0; i < 60; ++i) {
    const int length = i % 3 == 2 ? 64 : 8;
    file.messages.push_back(
        random_message(random, i % 2 == 0 ? 100 + i : 0x98FEF000 + i, length, 8));
    CanFrame frame;
    frame.id = *file.messages.back().id();
    frame.length = static_cast<std::uint8_t>(length);
    frame.fd = length > 8;
    std::string hex;
    for (int byte = 0; byte < length; ++byte) {
      frame.data[static_cast<std::size_t>(byte)] = static_cast<std::uint8_t>(random());
      hex += fmt::format("{:02x}", frame.data[static_cast<std::size_t>(byte)]);
    }
    frames << file.messages.back().written_id << ' ' << hex << '\n';
    sent.push_back(frame);
  }
  frames.close();
  std::ofstream(folder / "random.dbc") << dbc_text(file);
  const std::string command = fmt::format(
      "{} {}/tests/firmware_io/vehicle/decode_with_canmatrix.py {}/random.dbc < {}/frames > "
      "{}/values",
      python, test::source_folder().string(), folder.path().string(), folder.path().string(),
      folder.path().string());
  ASSERT_EQ(std::system(command.c_str()), 0) << command;

  const auto parsed = vehicle::read_dbc(folder / "random.dbc");
  ASSERT_TRUE(parsed) << parsed.error().message;
  std::ifstream values(folder / "values");
  std::string message, signal, text;
  std::size_t compared = 0;
  while (values >> message >> signal >> text) {
    const auto plan = SignalPlan::make(*parsed, message + "." + signal);
    ASSERT_TRUE(plan) << plan.error().message;
    const auto frame = std::ranges::find(sent, plan->id(), &CanFrame::id);
    ASSERT_NE(frame, sent.end());
    const auto value = plan->value(*frame);
    ASSERT_TRUE(value);
    const double theirs = std::strtod(text.c_str(), nullptr);
    ASSERT_NEAR(*value, theirs, 1e-9 + std::abs(theirs) * 1e-12) << message << '.' << signal;
    ++compared;
  }
  EXPECT_EQ(compared, 60U * 8U);
}

}  // namespace
}  // namespace terracut::test
