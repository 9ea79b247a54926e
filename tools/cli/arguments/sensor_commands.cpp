// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Of a sensor that sends now or what plays one, and what belongs to a live run.
#include <CLI/CLI.hpp>

#include "command_options.hpp"
#include "firmware_io/sinks/stream_address.hpp"
#include "option_checks.hpp"
#include "option_groups.hpp"

namespace terracut::cli {

void add_live(CLI::App& sub, LiveOptions& o) {
  sub.add_option("--listen", o.listen.address,
                 "ADDRESS:PORT; address 0.0.0.0 hears broadcasts, too")
      ->capture_default_str();
  sub.add_option("--interface", o.listen.interface, "Only what comes in by this interface");
  sub.add_option("--via", o.listen.via,
                 "libpcap hears what a socket does not: a mirror port, a port another program "
                 "holds; it needs --interface and CAP_NET_RAW")
      ->check(one_of("input.via"))
      ->capture_default_str();
  sub.add_option("--device-port", o.listen.device_port,
                 "Ruby128: port of its device information, heard at the start for its angles; "
                 "0: do not")
      ->capture_default_str();
  sub.add_option("--patience", o.patience_s,
                 "Seconds to wait for the sensor at the start (default: as long as it takes)")
      ->check(range_of("input.patience_s"))
      ->capture_default_str();
  sub.add_option("--multicast", o.listen.multicast, "Group to join")->check(CLI::ValidIPV4);
  sub.add_flag("--share-port", o.listen.share_port, "Let other programs hear the same port");
  add_decoding(sub, o.capture);
  sub.add_option("--duration", o.capture.duration_s, "Stop after this many seconds")
      ->check(range_of("input.duration_s"));
  add_mount(sub, o.mount);
  add_method(sub, o.method);
  refuse_rivals(sub,
                "a rival cannot stop at a deadline with the best labels so far, so only ours runs "
                "live; `terracut replay FILE --method` shows what it does");
  const bool can_of_file = !o.can.empty();
  CLI::Option* can = sub.add_option(
      "--can", o.can, "CAN interface of the vehicle (can0): its motion is taken out of every turn");
  add_motion(sub, can_of_file ? nullptr : can, o.motion);
  sub.add_option("--deadline-ms", o.deadline_ms, "From a turn's last packet to its labels")
      ->check(range_of("deadline.limit_ms"))
      ->capture_default_str();
  sub.add_option("--receive-priority", o.realtime.receive_priority, "SCHED_FIFO, 0: shared")
      ->check(range_of("realtime.receive_priority"))
      ->capture_default_str();
  sub.add_option("--segment-priority", o.realtime.segment_priority, "SCHED_FIFO, 0: shared")
      ->check(range_of("realtime.segment_priority"))
      ->capture_default_str();
  sub.add_option("--receive-core", o.realtime.receive_core, "Core of the receiving thread")
      ->check(range_of("realtime.receive_core"));
  sub.add_option("--segment-core", o.realtime.segment_core, "Core of the segmenting thread")
      ->check(range_of("realtime.segment_core"));
  sub.add_option("--can-priority", o.realtime.can_priority,
                 "SCHED_FIFO of the thread that hears the vehicle, 0: shared")
      ->check(range_of("realtime.can_priority"))
      ->capture_default_str();
  sub.add_flag("!--no-lock-memory", o.realtime.lock_memory, "Leave memory to the system");
  sub.add_option("--labels", o.labels, "Folder for NNNNNN.label, SemanticKITTI predictions");
  sub.add_option("--stream", o.stream,
                 "ADDRESS:PORT or socket path where other programs get every turn's labelled "
                 "points (docs/labelled_stream.md); a port alone: this machine's programs")
      ->check([](const std::string& text) {
        const auto address = firmware_io::parse_stream_address(text);
        return address ? std::string() : address.error().message;
      });
  sub.add_option(
         "--stream-mode", o.stream_mode,
         "Rights of that socket's path: 600 its owner may read, 660 its group, too, 666 all")
      ->check(one_of("output.stream_mode"))
      ->capture_default_str();
  sub.add_option("--recorder-folder", o.recorder.folder,
                 "Folder for the last seconds of packets, written when a deadline is missed or "
                 "`terracut dump` asks");
  sub.add_option("--recorder-seconds", o.recorder.seconds, "How many seconds")
      ->check(range_of("recorder.seconds"))
      ->capture_default_str();
  sub.add_option(
         "--metrics", o.watch.metrics,
         "ADDRESS:PORT of /metrics for Prometheus, or off; a port alone: this machine's programs")
      ->capture_default_str();
  sub.add_option("--name", o.watch.name, "Name for `terracut top` and `terracut dump`")
      ->capture_default_str();
  sub.add_option("--health-can", o.watch.health_can,
                 "CAN interface on which to say how terracut is (terracut_health.dbc)");
  sub.add_option("--json", o.json, "File for the summary at the end");
  sub.add_option("--trace", o.trace, "File for the last frames as a trace, for ui.perfetto.dev");
}

void add_dump(CLI::App& sub, DumpOptions& o) {
  sub.add_option("NAME", o.name, "Name of the process (default: the only one that runs)");
  sub.add_option("--wait", o.wait_s, "Seconds to wait for its answer")
      ->check(number(0, 3600))
      ->capture_default_str();
}

void add_top(CLI::App& sub, TopOptions& o) {
  sub.add_option("NAME", o.name, "Status page of the process (default: the only one that runs)");
  sub.add_flag("--once", o.once, "Print once and exit");
  sub.add_flag("--json", o.json, "Print the figures once, for programs");
  sub.add_option("--interval", o.interval_s, "Seconds between two looks")
      ->check(number(0.1, 3600))
      ->capture_default_str();
}

void add_doctor(CLI::App& sub, DoctorOptions& o) {
  sub.add_option("--interface", o.interface,
                 "Network interface of the sensor (default: all that are up)");
  sub.add_option("--port", o.port, "UDP port of the sensor")
      ->check(CLI::Range(1, 65535))
      ->capture_default_str();
  sub.add_flag("--json", o.json, "Print the findings for programs");
}

void add_send(CLI::App& sub, SendOptions& o) {
  sub.add_option("FILE", o.file, "Any capture with UDP, pcap or pcapng")->required();
  sub.add_option("--to", o.to,
                 "ADDRESS:PORT to send to; a multicast group and broadcast will do.\n"
                 "ADDRESS alone: every datagram to the port it was captured on")
      ->required();
  sub.add_option("--port", o.port, "Only UDP datagrams to this port (default: any)");
  sub.add_option("--from", o.from, "Only datagrams of this IPv4 address")->check(CLI::ValidIPV4);
  sub.add_option("--rate", o.rate, "Pace by the capture's stamps: 1 as recorded, 0 flat out")
      ->check(range_of("replay.rate"))
      ->capture_default_str();
  add_sending(sub, o);
}

void add_simulate(CLI::App& sub, SimulateOptions& o) {
  add_sensor(sub, o.sensor);
  sub.add_option("--scene", o.scene, "street, highway, rural, flat or hill")->capture_default_str();
  sub.add_option("--seed", o.seed, "The same seed gives the same drive")->capture_default_str();
  sub.add_option("--duration", o.duration_s, "Seconds to drive")
      ->check(range_of("simulate.duration_s"))
      ->capture_default_str();
  sub.add_option("--spin-hz,--rate", o.spin_hz, "Turns a second: 5, 10 and 20 are the sensors' own")
      ->check(range_of("simulate.spin_hz"))
      ->capture_default_str();
  sub.add_option("--returns", o.returns, "single: the strongest; dual: the strongest and the last")
      ->check(one_of("simulate.returns"))
      ->capture_default_str();
  sub.add_option("--timestamp", o.timestamp, "Ruby128: how its stamps are encoded")
      ->check(one_of("simulate.timestamp"))
      ->capture_default_str();
  sub.add_option("--noise", o.noise_m, "Standard deviation of the range noise, metres")
      ->check(range_of("simulate.noise_m"))
      ->capture_default_str();
  sub.add_option("--speed", o.speed_mps, "Of the vehicle, m/s (default: what is usual there)")
      ->check(CLI::Range(0.0, 60.0));
  sub.add_option("--yaw-rate", o.yaw_rate_dps,
                 "Degrees a second, left positive: drive on an arc instead of along the road")
      ->check(CLI::Range(-57.0, 57.0));
  sub.add_option("--calibration", o.calibration, "Unit to simulate (default: a nominal one)");
  add_mount(sub, o.mount);
  auto* output =
      sub.add_option("-o,--output", o.output, "Capture to write; its table and truth go beside it");
  sub.add_flag("--can-log", o.can_log,
               "Write the vehicle's speed and yaw rate beside it: NAME.can.log, NAME.can.dbc")
      ->needs(output);
  auto* udp = sub.add_option("--udp", o.udp.to,
                             "ADDRESS[:PORT]: be the sensor, and send the drive in real time once "
                             "it is computed");
  for (CLI::Option* option : add_sending(sub, o.udp)) option->needs(udp);
}

void add_config(CLI::App& sub, ConfigOptions& o) {
  sub.add_flag("--print-default", o.print_default,
               "Print a file with every key, its range and default (else: the one in force)");
  sub.add_flag("--print-table", o.print_table, "Print the table of docs/configuration.md");
}

}  // namespace terracut::cli
