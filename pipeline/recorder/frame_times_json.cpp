// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/recorder/frame_times_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace terracut::recorder {
namespace {

using Text = std::back_insert_iterator<std::string>;

void append_frame(Text text, const status::FrameRecord& frame, bool whole,
                  std::span<const std::string_view> stages) {
  fmt::format_to(text,
                 "  {{\"number\": {}, \"whole\": {}, \"returns\": {}, \"level\": \"{}\", "
                 "\"motion\": \"{}\", \"missed\": {}",
                 frame.info.number, whole, frame.info.returns, to_string(frame.level),
                 to_string(frame.info.deskew.state), frame.missed);
  if (frame.missed) fmt::format_to(text, ", \"cause\": \"{}\"", to_string(frame.cause));
  fmt::format_to(text,
                 ",\n   \"first_packet_ns\": {}, \"last_packet_ns\": {}, "
                 "\"closing_packet_ns\": {}, \"newest_motion_ns\": {},\n   \"handed_over_ns\": {}, "
                 "\"labels_ns\": {},\n",
                 frame.info.first_packet_ns, frame.info.last_packet_ns, frame.closing_packet_ns,
                 frame.info.deskew.newest_motion_ns, frame.handed_over_ns, frame.labels_ns);
  fmt::format_to(text,
                 "   \"decode_cpu_ns\": {}, \"segment_cpu_ns\": {}, \"run_queue_wait_ns\": {}, "
                 "\"steal_ns\": {}, \"cut_operations\": {},\n   \"stage_cpu_ns\": {{",
                 frame.decode_cpu_ns, frame.segment_cpu_ns, frame.run_queue_wait_ns, frame.steal_ns,
                 frame.segmentation.cut.operations());
  const std::size_t named = std::min(stages.size(), frame.stages.stage_ns.size());
  for (std::size_t i = 0; i < named; ++i) {
    fmt::format_to(text, "{}\"{}\": {}", i == 0 ? "" : ", ", stages[i], frame.stages.stage_ns[i]);
  }
  fmt::format_to(text, "}}}}");
}

}  // namespace

std::string frame_times_json(const DumpReport& report, DumpReason reason,
                             std::span<const status::FrameRecord> frames,
                             std::span<const std::string_view> stages) {
  std::string json;
  const Text text(json);
  fmt::format_to(
      text,
      "{{\n \"reason\": \"{}\",\n \"clock\": \"CLOCK_REALTIME, nanoseconds since 1970; 0 "
      "is not known\",\n",
      to_string(reason));
  fmt::format_to(text,
                 " \"datagrams\": {}, \"overwritten\": {}, \"unwritable\": {},\n"
                 " \"first_stamp_ns\": {}, \"last_stamp_ns\": {},\n \"frames\": [",
                 report.datagrams, report.overwritten, report.unwritable, report.first_stamp_ns,
                 report.last_stamp_ns);
  const char* separator = "\n";
  for (const status::FrameRecord& frame : frames) {
    if (frame.info.last_packet_ns < report.first_stamp_ns ||
        frame.info.last_packet_ns > report.last_stamp_ns) {
      continue;
    }
    fmt::format_to(text, "{}", separator);
    append_frame(text, frame, frame.info.first_packet_ns > report.first_stamp_ns, stages);
    separator = ",\n";
  }
  fmt::format_to(text, "\n ]\n}}\n");
  return json;
}

}  // namespace terracut::recorder
