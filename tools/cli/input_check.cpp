// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "input_check.hpp"

#include <string>

#include "calib/hdl64e_file.hpp"
#include "calib/ruby128_csv.hpp"
#include "firmware_io/can/dbc_file.hpp"
#include "firmware_io/sinks/listening_socket.hpp"
#include "firmware_io/sinks/stream_address.hpp"
#include "setup_choice.hpp"

namespace terracut::cli {
namespace {

template <class Calibration>
Status status_of(const Expected<Calibration>& read) {
  return read ? Status{} : tl::unexpected(read.error());
}

Status check_calibration(const CaptureOptions& capture) {
  const std::filesystem::path& file = capture.calibration;
  if (file.empty()) return {};
  const auto hdl64e = [&] { return status_of(calib::load_hdl64e_calibration(file)); };
  const auto ruby128 = [&] { return status_of(calib::read_ruby128_csv(file)); };
  if (capture.sensor == "hdl64e") return hdl64e();
  if (capture.sensor == "ruby128" || file.extension() == ".csv") return ruby128();
  const Status of_hdl64e = hdl64e();
  return of_hdl64e || ruby128() ? Status{} : of_hdl64e;
}

}  // namespace

Status check_inputs(const LiveOptions& options) {
  if (Status calibration = check_calibration(options.capture); !calibration) return calibration;
  if (Status mount = status_of(mount_of(options.mount)); !mount) return mount;
  if (options.motion.dbc.empty()) return {};
  return status_of(firmware_io::read_dbc(options.motion.dbc));
}

Status check_before_listening(const LiveOptions& options) {
  if (Status inputs = check_inputs(options); !inputs || options.stream.empty()) return inputs;
  const auto address = firmware_io::parse_stream_address(options.stream);
  if (!address) return tl::unexpected(address.error());
  return status_of(firmware_io::ListeningSocket::open(*address));
}

}  // namespace terracut::cli
