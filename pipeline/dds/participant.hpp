// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <dds/dds.h>

#include <optional>
#include <string>
#include <utility>

#include "rt/error.hpp"

/// ROS 2 messages over DDS, by Cyclone DDS and without ROS (docs/guide/ros2.md). Not for threads
/// with a deadline: writing and taking allocate and lock.
namespace terracut::dds {

/// Returns an error that names `what` was tried and Cyclone's reason for refusing it.
[[nodiscard]] tl::unexpected<Error> refused(ErrorCode code, const std::string& what,
                                            dds_return_t returned);

/// Owns a participant, reader, writer or other entity of Cyclone, and deletes it at the end.
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

/// Connects this process to a DDS domain.
class Participant {
 public:
  struct Config {
    std::optional<int> domain;  ///< [0, 232]; if empty, ROS_DOMAIN_ID, or 0 if that is not set.
    std::string
        interface;  ///< Network interface; empty: Cyclone's choice, or lo by ROS_LOCALHOST_ONLY.
    /// Bytes in a fragment of a message, [1000, 65000]. With 63000, readers on the same machine
    /// lose nothing; over Ethernet each fragment is sent as 43 IP fragments.
    int fragment_bytes = 63000;
    int receive_buffer_bytes = 8 << 20;  ///< Requested; the system may grant less.
  };

  /// CYCLONEDDS_URI overrides `config`. Fails with kInvalidArgument or kUnsupported.
  [[nodiscard]] static Expected<Participant> open(const Config& config);

  [[nodiscard]] dds_entity_t id() const noexcept { return participant_.id(); }
  [[nodiscard]] int domain() const noexcept { return domain_; }

 private:
  Participant(Entity domain, Entity participant, int number) noexcept
      : domain_entity_(std::move(domain)), participant_(std::move(participant)), domain_(number) {}

  Entity domain_entity_;
  Entity participant_;  ///< Declared after its domain, so that it is deleted first.
  int domain_;
};

}  // namespace terracut::dds
