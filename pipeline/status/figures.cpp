// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/status/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <span>
#include <utility>

#include "calib/beams/angle.hpp"
#include "pipeline/status/loss_causes.hpp"
#include "pipeline/visibility/sight_figures.hpp"

namespace terracut::status {
namespace {

constexpr double kMost = 1e12;  // the highest rate or percentage shown

/// Returns a difference of times that wraps instead of overflowing: times from a page may have any
/// value.
Duration between(std::int64_t from_ns, std::int64_t to_ns) noexcept {
  return {static_cast<std::int64_t>(static_cast<std::uint64_t>(to_ns) -
                                    static_cast<std::uint64_t>(from_ns))};
}

/// Converts to a whole number; INT64_MAX (never published) if it does not fit.
std::int64_t nanoseconds(double ns) noexcept {
  return std::abs(ns) < 1e18 ? static_cast<std::int64_t>(ns) : INT64_MAX;
}

Number degrees(double value) noexcept {
  return {value, -360, 360};
}
Number metres(double value) noexcept {
  return {value, -1e6, 1e6};
}
Number azimuth(std::int64_t cdeg) noexcept {
  return {static_cast<double>(cdeg) / 100.0, 0, 359.99};
}
constexpr Shown alarm_unless(bool well) noexcept {
  return well ? Shown::kAlways : Shown::kAlarm;
}

template <class Enumeration>
std::vector<std::string_view> names_of() {
  std::vector<std::string_view> names;
  for (std::size_t i = 0; i < static_cast<std::size_t>(Enumeration::kCount); ++i) {
    names.push_back(to_string(static_cast<Enumeration>(i)));
  }
  return names;
}
template <class Enumeration>
State state_of(Enumeration state) {
  return {static_cast<std::size_t>(state), names_of<Enumeration>()};
}

template <class Enumeration>
Counts counts_of(std::string_view label, std::span<const std::uint64_t> counts) {
  Counts result{label, {}};
  const auto names = names_of<Enumeration>();
  for (std::size_t i = 0; i < names.size(); ++i) result.each.emplace_back(names[i], counts[i]);
  return result;
}
/// Returns the losses of viewing clients if `of_onlookers`, else all other losses.
Counts losses_of(const MonitorSnapshot& f, bool of_onlookers) {
  Counts losses = counts_of("cause", f.losses_in_use());
  std::erase_if(losses.each,
                [&](const auto& each) { return is_of_onlookers(each.first) != of_onlookers; });
  return losses;
}
Histograms stages_of(const MonitorSnapshot& f) {
  Histograms result{"stage", {}};
  for (std::size_t i = 0; i < f.stages(); ++i) {
    result.each.emplace_back(f.stage_names[i].view(), &f.stage_cpu[i]);
  }
  return result;
}

class Table {
 public:
  void add(const std::string& group, std::initializer_list<Figure> figures) {
    for (const Figure& figure : figures) figures_.emplace_back(figure).group = group;
  }
  void add(std::vector<Figure> figures) {
    std::ranges::move(figures, std::back_inserter(figures_));
  }
  [[nodiscard]] std::vector<Figure> take() && { return std::move(figures_); }

 private:
  std::vector<Figure> figures_;
};

// clang-format off: a table reads better with an entry on two lines than one word a line.

void add_process(const MonitorSnapshot& f, Table& table) {
  const std::string version(f.version.view()), sensor(f.sensor.view()), input(f.input.view());
  table.add("", {
    {"terracut", version},
    {"sensor", sensor},
    {"input", input},
    {{}, true, {"terracut_info", "Always 1; what is running in its labels.",
                {{"version", version}, {"sensor", sensor}, {"input", input}}}},
    {"started_ns", TimeOfDay{f.started_ns},
     {"terracut_start_time_seconds", "Start of the process, since 1970."}},
    {"taken_ns", TimeOfDay{f.taken_ns},
     {"terracut_snapshot_time_seconds",
      "When these figures were taken, since 1970; stands still if the process hangs."}},
    {"interrupted", f.interrupted != 0, {},
     {"ended", "interrupted before its --duration was over", Shown::kAlarm}}});
}

void add_input(const MonitorSnapshot& f, Table& table) {
  const bool heard = f.last_packet_ns != 0;
  table.add("link", {
    {"state", state_of(f.link),
     {"terracut_link_state", "1 for the state that the sensor's link is in."},
     {"link", "{}", alarm_unless(f.link == LinkState::kReceiving)}},
    {{}, std::string(f.input.view()), {}, {"link", " on {}", Shown::kIfAny}},
    {{}, heard ? Value(between(f.last_packet_ns, f.taken_ns)) : Value("no packet yet"), {},
     {"link", heard ? "last packet {s:.3f} s ago" : "{}"}},
    {"packets", f.packets, {"terracut_packets_total", "Datagrams taken in."},
     {"link", "{} packets", f.before_labelling > 0 ? Shown::kIfAny : Shown::kAlways}},
    {{}, f.before_labelling, {}, {"link", "{} datagrams before labelling began", Shown::kIfAny}},
    {"last_packet_ns", TimeOfDay{f.last_packet_ns},
     {"terracut_last_packet_time_seconds", "Kernel's stamp of the newest packet, since 1970."}},
    {"head_stands", f.head_stands != 0,
     {"terracut_head_stands",
      "1 while packets come that say that the sensor's head does not rotate."},
     {"link", "the sensor's head does not rotate", Shown::kAlarm}},
    {"silences", f.silences,
     {"terracut_silences_total", "Times no packet came for a second or longer."},
     {"link", "times silent: {}", Shown::kIfAny}},
    {"silent_ms", Duration{f.silent_ns},
     {"terracut_silent_seconds_total", "How long no packets came in these."},
     {"link", " ({s:.1f} s in all)", Shown::kIfAny}}});
  table.add("datagrams", {
    {"received", f.received,
     {"terracut_datagrams_received_total", "Datagrams the kernel handed over: the sum of "
      "terracut_datagrams_total and terracut_datagrams_in_doubt."}},
    {"before_labelling", f.before_labelling,
     {"terracut_datagrams_before_labelling_total", "Datagrams that came while the sensor, its table "
      "and its mount were found; none of them is in terracut_datagrams_received_total."}},
    {"in_doubt", f.in_doubt,
     {"terracut_datagrams_in_doubt",
      "Datagrams that contradict the stream, until others bear them out or the stream goes on."}},
    {"outcomes", counts_of("outcome", f.outcomes_in_use()),
     {"terracut_datagrams_total", "Datagrams by what became of them; each is counted once."}}});
  table.add(figures_of(frame::BlindAzimuths{f.blind_from_cdeg, f.blind_to_cdeg}));
}

void add_frames(const MonitorSnapshot& f, Table& table) {
  const double misses = static_cast<double>(f.all_misses());
  const double percent = f.frames == 0 ? 0 : 100.0 * misses / static_cast<double>(f.frames);
  table.add("frames", {
    {"count", f.frames, {}, {"frames"}},
    {"per_second", Number{f.frames_per_s, 0, kMost},
     {"terracut_frames_per_second", "Frames a second, of the last few seconds."},
     {"frames", "{:.2f} a second", Shown::kIfAny}},
    {"returns", f.returns, {"terracut_returns_total", "Returns in these frames."},
     {"frames", "{} returns"}},
    {"returns_below", f.returns_below,
     {"terracut_ghost_returns_total", "Returns two obstacle heights or more below the ground: ghosts "
      "of a wet road or of glass, or a hole."},
     {"frames", "{} below the ground", Shown::kIfAny}},
    {"unjudged", f.unjudged,
     {"terracut_unjudged_frames_total", "Frames whose latency is not known: without stamps, or come "
      "before a node knew its sensor."},
     {"frames", "{} without a latency, so not judged", Shown::kIfAny}},
    {"levels", counts_of<Level>("level", f.levels),
     {"terracut_frames_total", "Frames judged, by the degradation level they got to."},
     {"levels", "{}", f.frames > 0 ? Shown::kAlways : Shown::kIfAny}}});
  table.add("", {
    {"deadline_ms", Duration{f.deadline_ns},
     {"terracut_deadline_seconds", "Allowed from a return's packet to its label."},
     {"deadline", "{ms:.1f} ms"}}});
  const auto waits = static_cast<std::int64_t>(f.firing_to_label_count);
  table.add("firing_to_label", {
    {"mean_ms", Duration{waits == 0 ? 0 : f.firing_to_label_sum_ns / waits},
     {"terracut_firing_to_label_mean_seconds",
      "Wall time from a return's packet to its label, the mean of the run."},
     {"labels", "{ms:.1f} ms after the firing in the mean", Shown::kIfAny}},
    {"late_sectors", f.late_sectors,
     {"terracut_late_sectors_total",
      "Ten degrees of a frame in which a label came after its deadline."},
     {"labels", "{} times ten degrees too late", Shown::kAlarm}}});
  table.add("misses", {
    {"total", f.all_misses(), {},
     {"deadline", "{} missed", alarm_unless(f.consecutive_misses == 0)}},
    {{}, Number{percent, 0, kMost}, {}, {"deadline", " ({:.3f} %)"}},
    {"causes", counts_of<FrameMissCause>("cause", f.misses),
     {"terracut_deadline_misses_total",
      "Frames labelled after the deadline or not at all, by cause."},
     {"deadline", ": {}", Shown::kIfAny}},
    {"consecutive", f.consecutive_misses,
     {"terracut_consecutive_misses", "Deadlines missed one after another, up to the newest frame."},
     {"deadline", "{} in a row now", Shown::kAlarm}},
    {"longest_run", f.longest_run_of_misses,
     {"terracut_longest_run_of_misses", "Deadlines missed one after another, at most."},
     {"deadline", "{} in a row at most", Shown::kIfAny}}});
  table.add("", {
    {"losses", counts_of("cause", f.losses_in_use()),
     {"terracut_losses_total",
      "What was lost between sensor and label, or did not reach an output, by cause; the cause "
      "names the unit."}},
    {{}, losses_of(f, false), {}, {"losses", "{}", Shown::kAlarmOrNone}},
    {{}, losses_of(f, true), {}, {"onlookers", "{}", Shown::kIfAny}}});
}

void add_motion(const MotionFigures& f, Table& table) {
  if (f.bus.empty()) return;
  const std::string bus(f.bus.view());
  const auto frames = [](frame::DeskewState motion) {
    return Metric{"terracut_motion_frames_total",
                  "Frames that were deskewed, and those whose motion was not known.",
                  {{"motion", std::string(to_string(motion))}}};
  };
  table.add("motion", {
    {"state", state_of(f.state),
     {"terracut_motion_state", "1 for what is known of the vehicle's motion, by its CAN bus.",
      {{"bus", bus}}},
     {"motion", "{}", alarm_unless(f.state == MotionState::kKnown)}},
    {"bus", bus, {}, {"motion", " on {}"}},
    {"deskewed_frames", f.deskewed, frames(frame::DeskewState::kDone),
     {"motion", ": {} frames deskewed"}},
    {"no_ego_motion_frames", f.no_ego_motion, frames(frame::DeskewState::kNoEgoMotion),
     {"motion", "no ego motion in {}"}},
    {"samples", f.samples,
     {"terracut_motion_samples_total", "Speeds with yaw rates, whole and fresh."}},
    {"spare_samples", f.spare_samples,
     {"terracut_motion_spare_samples_total",
      "Samples left out because there were more than are of use."}},
    {"last_sample_ns", TimeOfDay{f.last_sample_ns},
     {"terracut_motion_last_sample_time_seconds",
      "Kernel's stamp of the newest sample, since 1970."}},
    {"faults", counts_of("cause", f.faults_in_use()),
     {"terracut_motion_faults_total",
      "What went wrong between the vehicle's CAN bus and its motion, by cause."},
     {"motion", "{}", Shown::kAlarm}}});
  const std::string_view known_of_some = f.deskewed > 0 ? "motion" : "";
  table.add("motion.newest_sample_after_frame_ms", {
    {"newest", Duration{f.newest_sample_after_frame_ns},
     {"terracut_motion_sample_after_frame_seconds",
      "Stamp of the newest sample less the end of the newest frame; about 0."},
     {"motion", "newest sample {ms:+.1f} ms from its frame's end", Shown::kIfAny}},
    {"mean", Duration{nanoseconds(f.mean_sample_after_frame_ns())}, {},
     {known_of_some, "mean {ms:+.1f} ms"}},
    {"min", Duration{f.least_sample_after_frame_ns}, {}, {known_of_some, " ({ms:+.1f}"}},
    {"max", Duration{f.most_sample_after_frame_ns}, {}, {known_of_some, " to {ms:+.1f} ms)"}}});
}

void add_health(const HealthFigures& f, Table& table) {
  if (f.bus.empty()) return;
  const std::string bus(f.bus.view());
  const auto frames = [&](const char* outcome) {
    return Metric{"terracut_health_frames_total",
                  "CAN frames with terracut's health, sent or left out.",
                  {{"bus", bus}, {"outcome", outcome}}};
  };
  table.add("health", {
    {"sent", f.sent, frames("sent"), {"health", "{} CAN frames sent"}},
    {"bus", bus, {}, {"health", " on {}"}},
    {"queue_full", f.queue_full, frames("queue_full"),
     {"health", "{} left out: queue full", Shown::kAlarm}},
    {"link_down", f.link_down, frames("link_down"),
     {"health", "{} left out: link down", Shown::kAlarm}},
    {"failed", f.failed, frames("failed"), {"health", "{} left out: refused", Shown::kAlarm}}});
}

void add_threads(const MonitorSnapshot& f, Table& table) {
  int index = 0;
  for (const ThreadStatus& thread : f.threads_in_use()) {
    const std::string name(thread.name.view());
    const std::uint64_t all_faults = thread.minor_faults + thread.major_faults;
    const auto faults = [&](const char* kind) {
      return Metric{"terracut_page_faults_total",
                    "Page faults of the real-time threads after their start.",
                    {{"thread", name}, {"kind", kind}}};
    };
    table.add(fmt::format("threads.{}", index++), {
      {"name", name, {}, {"thread", "\n{:<9}"}},
      {"scheduling", std::string(thread.scheduling.view()), {}, {"thread", " {}"}},
      {{}, all_faults, {}, {"thread", "{} page faults", alarm_unless(all_faults == 0)}},
      {"minor_faults", thread.minor_faults, faults("minor")},
      {"major_faults", thread.major_faults, faults("major"),
       {"thread", "{} of them major", Shown::kAlarm}}});
  }
}

void add_times(const MonitorSnapshot& f, Table& table) {
  if (f.last_return_to_object.count() > 0) {
    table.add("ms", {
      {"last_return_to_object", &f.last_return_to_object,
       {"terracut_last_return_to_object_seconds",
        "Wall time from the packet of an object's last return to the object, where it came before "
        "its frame."},
       {"times", "return > object"}}});
  }
  table.add("ms", {
    {"firing_to_label", &f.firing_to_label,
     {"terracut_firing_to_label_seconds",
      "Wall time from a return's packet to its label: the longest in each ten degrees of a frame."},
     {"times", "firing > label"}},
    {"latency", &f.latency,
     {"terracut_latency_seconds", "Wall time from a frame's last packet to its last labels."},
     {"times", "latency"}},
    {"wall", &f.wall,
     {"terracut_hand_over_to_labels_seconds",
      "Wall time from the fetch of the packet that made a frame's last labels known to them."},
     {"times", "hand-over > labels"}},
    {"cpu_total", &f.total_cpu,
     {"terracut_frame_cpu_seconds", "Processor time of a frame, decoding and segmenting."},
     {"times", "cpu, all"}},
    {"cpu_decode", &f.decode_cpu,
     {"terracut_decode_cpu_seconds", "Processor time of decoding a frame."},
     {"times", "cpu, decode"}},
    {"cpu_segment", &f.segment_cpu,
     {"terracut_segment_cpu_seconds", "Processor time of segmenting a frame."},
     {"times", "cpu, segment"}},
    {"stages", stages_of(f),
     {"terracut_stage_cpu_seconds", "Processor time of a stage in a frame."}}});
}

}  // namespace

std::vector<Figure> figures_of(const frame::BlindAzimuths& blind) {
  const auto edge = [](const char* which) {
    return Metric{"terracut_blind_azimuth_degrees",
                  "Where that sector begins and ends, as the head rotates, by its edge.",
                  {{"edge", which}}};
  };
  const std::int64_t width_cdeg = std::int64_t{blind.to_cdeg} - blind.from_cdeg;
  Table table;
  table.add("", {
    {{}, azimuth(width_cdeg < 0 ? width_cdeg + beams::kRevolution_cdeg : width_cdeg),
     {"terracut_blind_degrees",
      "How wide the sector is in which the sensor sends nothing; 0 where none is known."}}});
  if (blind.is_none()) {
    table.add("", {{"blind", NotKnown{}}});
  } else {
    table.add("blind", {
      {"from_deg", azimuth(blind.from_cdeg), edge("from"), {"blind", "from {:.1f}"}},
      {"to_deg", azimuth(blind.to_cdeg), edge("to"), {"blind", " to {:.1f} deg of the head"}}});
  }
  return std::move(table).take();
}

std::vector<Figure> figures_of(const MountFigures& f) {
  const auto height = [](const char* by) {
    return Metric{"terracut_mount_height_metres", "The sensor above the ground.", {{"by", by}}};
  };
  const auto tilt = [](const char* by, const char* axis) {
    return Metric{"terracut_mount_tilt_degrees", "How the sensor is tilted, by axis.",
                  {{"by", by}, {"axis", axis}}};
  };
  Table table;
  table.add("mount", {
    {"height_m", metres(f.height_m), height("given")},
    {"roll_deg", degrees(f.roll_deg), tilt("given", "roll")},
    {"pitch_deg", degrees(f.pitch_deg), tilt("given", "pitch")},
    {"found_in_frames", f.found_in_frames},
    {"frames", f.frames},
    {"contradicted", f.contradicted != 0,
     {"terracut_mount_contradicted",
      "1 where the near ground shows another mount than the one in use."}},
    {"guessed", f.guessed != 0,
     {"terracut_mount_guessed",
      "1 where the ground did not show the mount: labels are made by a guess."}},
    {{}, guess_text(f), {}, {"mount", "{}", Shown::kAlarm}},
    {{}, contradiction_text(f), {}, {"mount", "{}", Shown::kAlarm}}});
  if (f.found_in_frames != 0) {
    const auto uncertain_tilt = [](const char* axis) {
      return Metric{"terracut_mount_uncertain_tilt_degrees",
                    "Within which of the tilt in use the true one lies in 95 of 100 cases.",
                    {{"axis", axis}}};
    };
    table.add("mount.uncertainty", {
      {"height_m", metres(f.uncertain_height_m),
       {"terracut_mount_uncertain_height_metres",
        "Within which of the height in use the true one lies in 95 of 100 cases."}},
      {"roll_deg", degrees(f.uncertain_roll_deg), uncertain_tilt("roll")},
      {"pitch_deg", degrees(f.uncertain_pitch_deg), uncertain_tilt("pitch")}});
  }
  if (f.seen_height_m == 0) return std::move(table).take();
  table.add("mount.seen", {
    {"height_m", metres(f.seen_height_m), height("ground")},
    {"roll_deg", degrees(f.seen_roll_deg), tilt("ground", "roll")},
    {"pitch_deg", degrees(f.seen_pitch_deg), tilt("ground", "pitch")}});
  return std::move(table).take();
}

std::vector<Figure> figures_of(const visibility::SightFigures& f) {
  Table table;
  if (f.is_watched == 0) return std::move(table).take();
  constexpr std::size_t kStates = static_cast<std::size_t>(visibility::State::kCount);
  const visibility::Condition worst = f.worst();
  std::vector<std::string_view> states{"learning"};
  std::ranges::copy(visibility::kStateNames, std::back_inserter(states));
  const std::size_t state = std::min(static_cast<std::size_t>(worst.state), kStates) + 1;
  Counts of_sectors{"cause", {}}, of_turns{"cause", {}};
  for (std::size_t i = 0; i < f.turns.size(); ++i) {
    const auto cause = static_cast<visibility::Cause>(i);
    const auto sectors = std::ranges::count_if(f.sectors, [&](const auto& sector) {
      return sector.has_view != 0 && sector.condition.cause == cause;
    });
    of_sectors.each.emplace_back(to_string(cause), static_cast<std::uint64_t>(sectors));
    of_turns.each.emplace_back(to_string(cause), f.turns[i]);
  }
  const bool is_well = worst.state == visibility::State::kClear;
  // The first turn is always left out, for it is not whole.
  const bool is_mostly_left_out = f.left_out_turns > 1 + f.learning_turns + f.turns[0];
  table.add("sight", {
    {"state", State{f.has_learnt == 0 ? 0 : state, states},
     {"terracut_sight_state", "1 for the state of the sensor's view, the worst of any direction."}},
    {{}, sight_text(f), {}, {"sight", "{}", alarm_unless(is_well)}},
    {"cause", std::string(to_string(worst.cause))},
    {"sectors", std::move(of_sectors),
     {"terracut_sight_sectors", "Sectors of ten degrees in which the sensor sees anything, by what "
      "is in its way."}},
    {"turns", std::move(of_turns),
     {"terracut_sight_turns_total", "Turns looked at, by the cause of their worst sector."}},
    {"learning_turns", f.learning_turns, {}, {}},
    {"left_out_turns", f.left_out_turns,
     {"terracut_sight_turns_left_out_total",
      "Turns not looked at because packets are missing; the state stays what it was."}},
    {{}, is_mostly_left_out ? f.left_out_turns : 0, {},
     {"sight", "turns left out for want of packets: {}", Shown::kAlarm}}});
  for (std::size_t i = 0; i < visibility::kDirections; ++i) {
    const auto direction = static_cast<visibility::Direction>(i);
    const visibility::SightFigures::Of of = f.in(direction);
    const std::string name(to_string(direction));
    table.add("sight.directions." + name, {
      {"sectors", static_cast<std::uint64_t>(of.with_view)},
      {"troubled_sectors", static_cast<std::uint64_t>(of.troubled),
       {"terracut_sight_troubled_sectors", "Sectors of ten degrees that are not clear.",
        {{"direction", name}}}},
      {"visible_m", of.with_view == 0 ? Value(NotKnown{}) : Value(metres(of.visible_m)),
       {"terracut_sight_visible_metres",
        "How far beams to the ground return, the median of a direction's sectors; 40 at most.",
        {{"direction", name}}}}});
  }
  return std::move(table).take();
}

// clang-format on

std::vector<Figure> figures_of(const MonitorSnapshot& snapshot) {
  Table table;
  add_process(snapshot, table);
  add_input(snapshot, table);
  add_frames(snapshot, table);
  table.add(figures_of(snapshot.mount));
  add_motion(snapshot.motion, table);
  add_health(snapshot.health, table);
  table.add(figures_of(snapshot.sight));
  add_threads(snapshot, table);
  add_times(snapshot, table);
  return std::move(table).take();
}

bool are_possible(const MonitorSnapshot& f) {
  const bool have_room = f.loss_count <= f.losses.size() && f.outcome_count <= f.outcomes.size() &&
                         f.thread_count <= f.threads.size() &&
                         f.stage_count <= f.stage_names.size() &&
                         f.motion.fault_count <= f.motion.faults.size();
  return have_room && std::ranges::all_of(figures_of(f), is_possible, &Figure::value);
}

std::string contradiction_text(const MountFigures& mount) {
  if (mount.contradicted == 0) return {};
  const auto origin = [&](double uncertainty) {
    if (mount.guessed != 0) return "guessed";
    return uncertainty > 0 ? "found at the start" : "stated";
  };
  return fmt::format(
      "the near ground contradicts the mount: it shows the sensor at height {:.2f} m, roll {:.1f}, "
      "pitch {:.1f} deg; in use are {:.2f} m ({}), {:.1f} ({}), {:.1f} deg ({}); labels suffer. "
      "`terracut calibrate` measures it from a capture, for --setup",
      mount.seen_height_m, mount.seen_roll_deg, mount.seen_pitch_deg, mount.height_m,
      origin(mount.uncertain_height_m), mount.roll_deg, origin(mount.uncertain_roll_deg),
      mount.pitch_deg, origin(mount.uncertain_pitch_deg));
}

std::string guess_text(const MountFigures& mount) {
  if (mount.guessed == 0) return {};
  return fmt::format(
      "not found and not stated: a guess, height {:.2f} m, roll {:.1f}, pitch {:.1f} deg",
      mount.height_m, mount.roll_deg, mount.pitch_deg);
}

}  // namespace terracut::status
