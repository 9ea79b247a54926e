// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "known_sensor.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <string_view>

#include "firmware_io/net/ipv4_endpoint.hpp"
#include "pipeline/page/status_page_file.hpp"
#include "rt/files/owned_descriptor.hpp"
#include "rt/files/trusted_file.hpp"
#include "rt/files/whole_file.hpp"
#include "tools/cli/console.hpp"

namespace terracut::cli {
namespace {

std::filesystem::path folder() {
  const char* const of_service = std::getenv("STATE_DIRECTORY");
  const std::string_view folders = of_service == nullptr ? "" : of_service;
  // $STATE_DIRECTORY of a systemd unit may list several folders; the first one is used.
  return folders.empty() ? page::status_page_folder() : folders.substr(0, folders.find(':'));
}

}  // namespace

KnownSensor::KnownSensor(std::string name)
    : path_(folder() / (std::move(name) + ".terracut-sensor")) {}

std::optional<net::Sender> KnownSensor::sender() const {
  const files::OwnedDescriptor file(
      ::open(path_.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  struct stat status{};
  if (!file || ::fstat(file.get(), &status) != 0) return std::nullopt;
  if (const Status trusted = files::check_trusted(status, path_); !trusted) {
    warn(trusted.error().message);
    return std::nullopt;
  }
  std::array<char, 64> bytes{};
  const ::ssize_t got = ::read(file.get(), bytes.data(), bytes.size());
  const std::string_view text(bytes.data(), got < 0 ? 0 : static_cast<std::size_t>(got));
  const auto sender = net::parse_ipv4_sender(text.substr(0, text.find('\n')));
  return sender ? std::optional(*sender) : std::nullopt;
}

void KnownSensor::remember(const net::Sender& sender) const {
  if (this->sender() == sender) return;
  const Status written = files::write_whole_file(path_, to_string(sender) + "\n");
  if (!written) warn("the sensor in use is not remembered: " + written.error().message);
}

}  // namespace terracut::cli
