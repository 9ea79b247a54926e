// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "participant.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "rt/number_of.hpp"

namespace terracut::dds {
namespace {

constexpr int kMostDomain = 232;  // higher ones would have ports beyond 65535

std::string_view environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::string_view{} : std::string_view(value);
}

Expected<int> domain_of(const Participant::Config& config) {
  if (config.domain) return *config.domain;
  const std::string_view named = environment("ROS_DOMAIN_ID");
  if (named.empty()) return 0;
  const auto number = rt::number_of<int>(named);
  if (number && *number >= 0 && *number <= kMostDomain) return *number;
  return fail(ErrorCode::kInvalidArgument,
              fmt::format("ROS_DOMAIN_ID is '{}'; expected 0 to {}", named, kMostDomain));
}

/// Writes what Cyclone says to stderr, as Cyclone does itself; leaves out its remark about
/// loopback, on which the machine's participants find each other without multicast.
void pass_on(void* /*unused*/, const dds_log_data_t* said) {
  constexpr std::string_view kRemark = "selected interface \"lo\" is not multicast-capable";
  if (std::string_view(said->message, said->size).starts_with(kRemark)) return;
  (void)std::fwrite(said->message - said->hdrsize, 1, said->hdrsize + said->size + 1, stderr);
}

/// Returns the configuration for Cyclone: our part, a comma, then the user's part, which overrides
/// ours.
std::string configuration(const Participant::Config& config) {
  const std::string_view users = environment("CYCLONEDDS_URI");
  std::string interface = config.interface;
  if (interface.empty() && environment("ROS_LOCALHOST_ONLY") == "1") interface = "lo";
  // Cyclone uses the interfaces of all parts together and refuses one that is named twice, so ours
  // is left out if the user's part names any.
  if (users.find("NetworkInterface") != std::string_view::npos) interface.clear();
  const std::string interfaces =
      interface.empty()
          ? ""
          : fmt::format("<Interfaces><NetworkInterface name=\"{}\"/></Interfaces>", interface);
  // WhcHigh (the limit of a writer's backlog) is so large that a writer never waits for a reader
  // that has stopped reading, since other readers would wait, too. A writer's history bounds its
  // memory.
  const std::string own = fmt::format(
      "<CycloneDDS><Domain id=\"any\">"
      "<General>{}<MaxMessageSize>{}B</MaxMessageSize><FragmentSize>{}B</FragmentSize></General>"
      "<Internal><SocketReceiveBufferSize max=\"{}B\"/>"
      "<Watermarks><WhcHigh>1GB</WhcHigh></Watermarks></Internal>"
      "</Domain></CycloneDDS>",
      interfaces, config.fragment_bytes + 500, config.fragment_bytes, config.receive_buffer_bytes);
  return users.empty() ? own : fmt::format("{},{}", own, users);
}

}  // namespace

tl::unexpected<Error> refused(ErrorCode code, const std::string& what, dds_return_t returned) {
  return fail(code, fmt::format("DDS: {}: {}", what, dds_strretcode(-returned)));
}

Expected<Participant> Participant::open(const Config& config) {
  const auto number = domain_of(config);
  if (!number) return tl::unexpected(number.error());
  const auto domain_id = static_cast<dds_domainid_t>(*number);
  dds_set_log_sink(pass_on, nullptr);
  Entity domain(dds_create_domain(domain_id, configuration(config).c_str()));
  if (domain.id() < 0) {
    return refused(ErrorCode::kInvalidArgument,
                   fmt::format("domain {}, as configured here and by CYCLONEDDS_URI", *number),
                   domain.id());
  }
  Entity participant(dds_create_participant(domain_id, nullptr, nullptr));
  if (participant.id() < 0) {
    return refused(ErrorCode::kUnsupported, fmt::format("a participant of domain {}", *number),
                   participant.id());
  }
  return Participant(std::move(domain), std::move(participant), *number);
}

}  // namespace terracut::dds
