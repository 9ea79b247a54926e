// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "label_writer.hpp"

#include <fmt/format.h>

#include "pipeline/output/label_sink.hpp"
#include "tools/cli/console.hpp"

namespace terracut::cli {

LabelWriter::LabelWriter(const std::filesystem::path& folder, Slots& slots)
    : folder_(folder, ".label"), slots_(slots), thread_([this] { work(); }) {}

bool LabelWriter::finish(std::chrono::milliseconds patience) {
  finish_ = true;
  return thread_.ends_within(patience);
}

void LabelWriter::work() {
  while (true) {
    const bool last_round = finish_;
    for (Slots::Frame frame; slots_.take(frame);) slots_.give_back(write(frame));
    if (last_round) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

bool LabelWriter::write(const Slots::Frame& frame) {
  if (!outcome_) return false;
  outcome_ = folder_.place(fmt::format("{:06}.label", frame.record.info.number))
                 .and_then([&](const std::filesystem::path& path) {
                   return output::write_label_file(path, frame.items);
                 });
  if (!outcome_) warn("no more labels are written: " + outcome_.error().message);
  return outcome_.has_value();
}

}  // namespace terracut::cli
