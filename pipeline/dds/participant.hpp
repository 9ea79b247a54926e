// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <dds/dds.h>

#include <optional>
#include <string>
#include <utility>

#include "rt/error.hpp"

/// ROS 2 messages over DDS, by Cyclone DDS and without ROS (docs/guide/ros2.md). Nothing here is
/// for a thread with a deadline: writing and taking allocate and lock.
namespace terracut::dds {

/// What Cyclone answered, where it refused; `what`: was tried.
[[nodiscard]] tl::unexpected<Error> refused(ErrorCode code, const std::string& what,
                                            dds_return_t returned);

/// A participant, reader, writer or what else Cyclone made; gone with this object.
class Entity {
 public:
  explicit Entity(dds_entity_t entity) noexcept : entity_(entity) {}
  Entity(Entity&& other) noexcept : entity_(std::exchange(other.entity_, 0)) {}
  Entity& operator=(Entity&& other) noexcept {
    std::swap(entity_, other.entity_);
    return *this;
  }
  ~Entity() {
    if (entity_ > 0) (void)dds_delete(entity_);
  }

  [[nodiscard]] dds_entity_t id() const noexcept { return entity_; }

 private:
  dds_entity_t entity_;
};

/// This process on a DDS domain.
class Participant {
 public:
  struct Config {
    std::optional<int> domain;  ///< [0, 232]; none: ROS_DOMAIN_ID, else 0.
    std::string
        interface;  ///< Of the network; empty: Cyclone's choice, or lo by ROS_LOCALHOST_ONLY.
    /// Of a message, bytes, [1000, 65000]. 63000 is what readers on this machine lose nothing of;
    /// over Ethernet each becomes 43 IP fragments.
    int fragment_bytes = 63000;
    int receive_buffer_bytes = 8 << 20;  ///< Asked of the system, which may grant less.
  };

  /// What CYCLONEDDS_URI says wins over `config`. kInvalidArgument, kUnsupported.
  [[nodiscard]] static Expected<Participant> open(const Config& config);

  [[nodiscard]] dds_entity_t id() const noexcept { return participant_.id(); }
  [[nodiscard]] int domain() const noexcept { return domain_; }

 private:
  Participant(Entity domain, Entity participant, int number) noexcept
      : domain_entity_(std::move(domain)), participant_(std::move(participant)), domain_(number) {}

  Entity domain_entity_;
  Entity participant_;  ///< After its domain, so that it goes before it.
  int domain_;
};

}  // namespace terracut::dds
