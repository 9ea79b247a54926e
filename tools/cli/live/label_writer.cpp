// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "label_writer.hpp"

#include <fmt/format.h>

#include "pipeline/output/label_sink.hpp"
#include "rt/caught.hpp"
#include "rt/files/room_left.hpp"
#include "rt/measure/thread_cpu_clock.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/files/frame_folder_of.hpp"

namespace terracut::cli {

LabelWriter::LabelWriter(const OutputOptions& options, Slots& slots)
    : place_(options.labels),
      folder_(frame_folder_of(options, options.labels, ".label")),
      slots_(slots),
      thread_(
          [this] { work(); },
          [](std::string_view why) { warn(fmt::format("no more labels are written: {}", why)); }) {}

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
  constexpr std::int64_t kAgainAfter_ns = 1'000'000'000;
  const std::int64_t now_ns = measure::monotonic_ns();
  if (now_ns < try_again_ns_) return false;
  const Status written = rt::caught([&] { return try_to_write(frame); });
  const bool was_written = try_again_ns_ == 0;
  try_again_ns_ = written ? 0 : now_ns + kAgainAfter_ns;
  if (written && !was_written) say("labels are written again: " + place_.string());
  if (written) return true;
  if (was_written) {
    warn(fmt::format("no labels are written, which is tried again every second: {}",
                     written.error().message));
  }
  if (outcome_) outcome_ = written;
  return false;
}

Status LabelWriter::try_to_write(const Slots::Frame& frame) {
  if (Status room = files::check_room_left(place_); !room) return room;
  return folder_.place(fmt::format("{:06}.label", frame.record.info.number))
      .and_then([&](const std::filesystem::path& path) {
        return output::write_label_file(path, frame.items);
      });
}

}  // namespace terracut::cli
