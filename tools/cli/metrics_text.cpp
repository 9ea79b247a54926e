// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "metrics_text.hpp"

#include <fmt/format.h>

#include <array>
#include <iterator>
#include <string_view>
#include <utility>

#include "blind_text.hpp"

namespace terracut::cli {
namespace {

/// From well below a quick stage to well above a deadline of one turn.
constexpr std::array<std::int64_t, 19> kLimits_us{
    100,    250,    500,    1'000,  2'000,  3'000,  5'000,   7'500,   10'000,   15'000,
    20'000, 25'000, 30'000, 40'000, 50'000, 75'000, 100'000, 200'000, 1'000'000};

double seconds(std::int64_t ns) {
  return static_cast<double>(ns) * 1e-9;
}

/// Inside the quotes of a label.
std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '\\' || c == '"') result += '\\';
    if (c == '\n') {
      result += "\\n";
    } else {
      result += c;
    }
  }
  return result;
}

/// `name="value"`.
std::string label(std::string_view name, std::string_view value) {
  return fmt::format("{}=\"{}\"", name, escaped(value));
}

class MetricsText {
 public:
  /// What stands before the samples of `name`, once for all of them.
  void begin(std::string_view name, std::string_view type, std::string_view help) {
    name_ = name;
    append("# HELP {} {}\n# TYPE {} {}\n", name, help, name, type);
  }
  template <class Number>
  void sample(Number value, std::string_view labels = {}) {
    if (labels.empty()) {
      append("{} {}\n", name_, value);
    } else {
      append("{}{{{}}} {}\n", name_, labels, value);
    }
  }
  template <class Number>
  void single(std::string_view name, std::string_view type, std::string_view help, Number value) {
    begin(name, type, help);
    sample(value);
  }
  void histogram(const rt::LogLinearHistogram& histogram, const std::string& labels = {}) {
    const std::string prefix = labels.empty() ? "" : labels + ",";
    for (const std::int64_t limit_us : kLimits_us) {
      append("{}_bucket{{{}le=\"{}\"}} {}\n", name_, prefix, static_cast<double>(limit_us) / 1e6,
             histogram.count_not_above(limit_us * 1000));
    }
    append("{}_bucket{{{}le=\"+Inf\"}} {}\n", name_, prefix, histogram.count());
    const std::string braced = labels.empty() ? "" : "{" + labels + "}";
    append("{}_sum{} {}\n", name_, braced, histogram.sum_ns() * 1e-9);
    append("{}_count{} {}\n", name_, braced, histogram.count());
  }
  [[nodiscard]] std::string take() && { return std::move(text_); }

 private:
  template <class... Values>
  void append(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Values>(values)...);
  }

  std::string text_;
  std::string_view name_;
};

void add_process(const rt::MonitorSnapshot& figures, MetricsText& text) {
  text.begin("terracut_info", "gauge", "Always 1; what is running in its labels.");
  text.sample(1, label("version", figures.version.view()) + "," +
                     label("sensor", figures.sensor.view()) + "," +
                     label("input", figures.input.view()));
  text.single("terracut_start_time_seconds", "gauge", "Start of the process, since 1970.",
              seconds(figures.started_ns));
  text.single("terracut_snapshot_time_seconds", "gauge",
              "When these figures were taken, since 1970; stands still if the process hangs.",
              seconds(figures.taken_ns));
  text.single("terracut_deadline_seconds", "gauge",
              "Allowed from a turn's last packet to its labels.", seconds(figures.deadline_ns));
  text.begin("terracut_page_faults_total", "counter",
             "Page faults of the real-time threads after their start.");
  for (const rt::ThreadStatus& thread : figures.threads_in_use()) {
    const std::string name = label("thread", thread.name.view());
    text.sample(thread.minor_faults, name + ",kind=\"minor\"");
    text.sample(thread.major_faults, name + ",kind=\"major\"");
  }
}

void add_input(const rt::MonitorSnapshot& figures, MetricsText& text) {
  text.begin("terracut_link_state", "gauge", "1 for the state that the sensor's link is in.");
  for (std::size_t i = 0; i < static_cast<std::size_t>(rt::LinkState::kCount); ++i) {
    const auto state = static_cast<rt::LinkState>(i);
    text.sample(state == figures.link ? 1 : 0, label("state", to_string(state)));
  }
  text.single("terracut_packets_total", "counter", "Datagrams taken in.", figures.packets);
  text.single("terracut_last_packet_time_seconds", "gauge",
              "Kernel's stamp of the newest packet, since 1970.", seconds(figures.last_packet_ns));
  text.single("terracut_silences_total", "counter", "Times no packet came for a second or longer.",
              figures.silences);
  text.single("terracut_silent_seconds_total", "counter", "How long no packets came in these.",
              seconds(figures.silent_ns));
  text.single("terracut_datagrams_received_total", "counter",
              "Datagrams the kernel handed over: the sum of terracut_datagrams_total and "
              "terracut_datagrams_in_doubt.",
              figures.received);
  text.single("terracut_datagrams_in_doubt", "gauge",
              "Datagrams that contradict the stream, until others bear them out or the stream goes "
              "on.",
              figures.in_doubt);
  text.begin("terracut_datagrams_total", "counter",
             "Datagrams by what became of them; each is counted once.");
  for (const rt::NamedCount& outcome : figures.outcomes_in_use()) {
    text.sample(outcome.count, label("outcome", outcome.name.view()));
  }
  text.single("terracut_head_stands", "gauge",
              "1 while packets come that say that the sensor's head does not turn.",
              figures.head_stands ? 1 : 0);
  const firmware_io::BlindAzimuths blind = blind_of(figures);
  text.single("terracut_blind_degrees", "gauge",
              "How wide the sector is in which the sensor sends nothing; 0 where none is known.",
              blind.width_cdeg() / 100.0);
  if (!blind.is_none()) {
    text.begin("terracut_blind_azimuth_degrees", "gauge",
               "Where that sector begins and ends, as the head turns, by its edge.");
    text.sample(blind.from_cdeg / 100.0, label("edge", "from"));
    text.sample(blind.to_cdeg / 100.0, label("edge", "to"));
  }
  text.begin("terracut_losses_total", "counter",
             "What was lost between sensor and label, by cause; the cause names the unit.");
  for (const rt::NamedCount& loss : figures.losses_in_use()) {
    text.sample(loss.count, label("cause", loss.name.view()));
  }
}

void add_frames(const rt::MonitorSnapshot& figures, MetricsText& text) {
  text.begin("terracut_frames_total", "counter",
             "Frames judged, by the rung of the ladder they got to.");
  for (std::size_t i = 0; i < rt::kRungs; ++i) {
    text.sample(figures.rungs[i], label("rung", to_string(static_cast<rt::Rung>(i))));
  }
  text.single("terracut_returns_total", "counter", "Returns in these frames.", figures.returns);
  text.single("terracut_unjudged_frames_total", "counter", "Frames whose stamps give no latency.",
              figures.unjudged);
  text.begin("terracut_deadline_misses_total", "counter",
             "Frames labelled after the deadline or not at all, by cause.");
  for (std::size_t i = 0; i < rt::kMissCauses; ++i) {
    text.sample(figures.misses[i], label("cause", to_string(static_cast<rt::FrameMissCause>(i))));
  }
  text.single("terracut_consecutive_misses", "gauge",
              "Deadlines missed one after another, up to the newest frame.",
              figures.consecutive_misses);
}

void add_mount(const rt::MountFigures& mount, MetricsText& text) {
  text.single("terracut_mount_contradicted", "gauge",
              "1 where the near ground shows another mount than the one given.",
              mount.contradicted != 0 ? 1 : 0);
  if (mount.contradicted == 0) return;
  text.begin("terracut_mount_height_metres", "gauge", "The sensor above the ground.");
  text.sample(mount.height_m, label("by", "given"));
  text.sample(mount.seen_height_m, label("by", "ground"));
  text.begin("terracut_mount_tilt_degrees", "gauge", "How the sensor is tilted, by axis.");
  text.sample(mount.roll_deg, label("by", "given") + "," + label("axis", "roll"));
  text.sample(mount.pitch_deg, label("by", "given") + "," + label("axis", "pitch"));
  text.sample(mount.seen_roll_deg, label("by", "ground") + "," + label("axis", "roll"));
  text.sample(mount.seen_pitch_deg, label("by", "ground") + "," + label("axis", "pitch"));
}

void add_motion(const rt::MotionFigures& motion, MetricsText& text) {
  if (motion.bus.empty()) return;
  const std::string bus = label("bus", motion.bus.view());
  text.begin("terracut_motion_state", "gauge",
             "1 for what is known of the vehicle's motion, by its CAN bus.");
  for (std::size_t i = 1; i < static_cast<std::size_t>(rt::MotionState::kCount); ++i) {
    const auto state = static_cast<rt::MotionState>(i);
    text.sample(state == motion.state ? 1 : 0, bus + "," + label("state", to_string(state)));
  }
  text.begin("terracut_motion_frames_total", "counter",
             "Frames the vehicle's motion was taken out of, and those it was not known for.");
  text.sample(motion.taken_out, label("motion", to_string(rt::FrameMotion::kTakenOut)));
  text.sample(motion.no_ego_motion, label("motion", to_string(rt::FrameMotion::kNoEgoMotion)));
  text.single("terracut_motion_samples_total", "counter", "Speeds with yaw rates, whole and fresh.",
              motion.samples);
  text.single("terracut_motion_spare_samples_total", "counter",
              "Samples left out because there were more than are of use.", motion.spare_samples);
  text.single("terracut_motion_last_sample_time_seconds", "gauge",
              "Kernel's stamp of the newest sample, since 1970.", seconds(motion.last_sample_ns));
  text.single("terracut_motion_sample_after_turn_seconds", "gauge",
              "Stamp of the newest sample less the end of the newest turn; about 0.",
              seconds(motion.newest_sample_after_turn_ns));
  text.begin("terracut_motion_faults_total", "counter",
             "What went wrong between the vehicle's CAN bus and its motion, by cause.");
  for (const rt::NamedCount& fault : motion.faults_in_use()) {
    text.sample(fault.count, label("cause", fault.name.view()));
  }
}

void add_health(const rt::HealthFigures& health, MetricsText& text) {
  if (health.bus.empty()) return;
  text.begin("terracut_health_frames_total", "counter",
             "CAN frames with terracut's health, sent or left out.");
  const std::string bus = label("bus", health.bus.view());
  text.sample(health.sent, bus + ",outcome=\"sent\"");
  text.sample(health.queue_full, bus + ",outcome=\"queue_full\"");
  text.sample(health.link_down, bus + ",outcome=\"link_down\"");
  text.sample(health.failed, bus + ",outcome=\"failed\"");
}

void add_times(const rt::MonitorSnapshot& figures, MetricsText& text) {
  const auto add = [&](std::string_view name, std::string_view help,
                       const rt::LogLinearHistogram& histogram) {
    text.begin(name, "histogram", help);
    text.histogram(histogram);
  };
  add("terracut_latency_seconds", "Wall time from a turn's last packet to its labels.",
      figures.latency);
  add("terracut_hand_over_to_labels_seconds", "Wall time from the end of decoding to the labels.",
      figures.wall);
  add("terracut_frame_cpu_seconds", "Processor time of a frame, decoding and segmenting.",
      figures.total_cpu);
  add("terracut_decode_cpu_seconds", "Processor time of decoding a frame.", figures.decode_cpu);
  add("terracut_segment_cpu_seconds", "Processor time of segmenting a frame.", figures.segment_cpu);
  text.begin("terracut_stage_cpu_seconds", "histogram", "Processor time of a stage in a frame.");
  for (std::size_t i = 0; i < figures.stages(); ++i) {
    text.histogram(figures.stage_cpu[i], label("stage", figures.stage_names[i].view()));
  }
}

}  // namespace

std::string metrics_text(const rt::MonitorSnapshot& figures) {
  MetricsText text;
  add_process(figures, text);
  add_input(figures, text);
  add_frames(figures, text);
  add_mount(figures.mount, text);
  add_motion(figures.motion, text);
  add_health(figures.health, text);
  add_times(figures, text);
  return std::move(text).take();
}

}  // namespace terracut::cli
