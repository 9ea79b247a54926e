// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Threads that may do less than the test, or have a network of their own. Rights, system call
// filters and namespaces belong to a thread on Linux: the rest of the test keeps its own.
#pragma once

#include <fcntl.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <net/if.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/syscall.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <string>
#include <thread>

#include "rt/files/owned_descriptor.hpp"

namespace terracut::test {

/// Runs `body` without any privilege.
template <class Body>
void as_nobody(Body&& body) {
  std::thread([&] {
    constexpr unsigned kNobody = 65534;
    if (::syscall(SYS_setresuid, kNobody, kNobody, kNobody) != 0 && ::geteuid() == 0) return;
    body();
  }).join();
}

/// Runs `body` where the system's calls pass `filter`; false when the system has no such filters.
template <std::size_t Steps, class Body>
[[nodiscard]] bool filtered(std::array<sock_filter, Steps> filter, Body&& body) {
  bool done = false;
  std::thread([&] {
    const sock_fprog program{static_cast<unsigned short>(filter.size()), filter.data()};
    if (::prctl(PR_SET_NO_NEW_PRIVS, 1UL, 0UL, 0UL, 0UL) != 0) return;
    if (::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) != 0) return;
    body();
    done = true;
  }).join();
  return done;
}

[[nodiscard]] inline sock_filter load(std::size_t offset) {
  return {BPF_LD | BPF_W | BPF_ABS, 0, 0, static_cast<std::uint32_t>(offset)};
}
[[nodiscard]] inline sock_filter unless(int value, std::uint8_t skip) {
  return {BPF_JMP | BPF_JEQ | BPF_K, 0, skip, static_cast<std::uint32_t>(value)};
}
[[nodiscard]] inline sock_filter fail_by(int error) {
  return {BPF_RET | BPF_K, 0, 0, SECCOMP_RET_ERRNO | static_cast<std::uint32_t>(error)};
}
inline constexpr sock_filter kAllow{BPF_RET | BPF_K, 0, 0, SECCOMP_RET_ALLOW};

/// Runs `body` where setsockopt(SOL_SOCKET, `option`) fails by `error`; by 0 it says that it
/// worked, but does nothing. False when the system has no such filters.
template <class Body>
[[nodiscard]] bool without_socket_option(int option, int error, Body&& body) {
  return filtered(
      std::array{load(offsetof(seccomp_data, nr)), unless(SYS_setsockopt, 5),
                 load(offsetof(seccomp_data, args[1])), unless(SOL_SOCKET, 3),
                 load(offsetof(seccomp_data, args[2])), unless(option, 1), fail_by(error), kAllow},
      body);
}

/// Runs `body` where the system call `number` fails by `error`; false when the system has no such
/// filters.
template <class Body>
[[nodiscard]] bool without_call(int number, int error, Body&& body) {
  return filtered(
      std::array{load(offsetof(seccomp_data, nr)), unless(number, 1), fail_by(error), kAllow},
      body);
}

/// Two machines joined by a cable, without hardware: the calling thread sees only this one.
class PrivateNetwork {
 public:
  /// Runs `body(PrivateNetwork&)` on a machine of its own, loopback up. False when the system does
  /// not let the test make networks.
  template <class Body>
  [[nodiscard]] static bool run(Body&& body) {
    bool done = false;
    std::thread([&] {
      PrivateNetwork network;
      if (!network.there_ || !network.here_) return;
      body(network);
      done = true;
    }).join();
    return done;
  }

  /// What `body` returns when it is run on the other machine.
  template <class Body>
  [[nodiscard]] auto on_the_other(Body&& body) const {
    enter(there_);
    auto result = body();
    enter(here_);
    return result;
  }

  /// "sensor0" here, 10.77.0.1, and "wire0" on the other machine, 10.77.0.2. False without the
  /// program ip, or where the kernel has no virtual cables.
  [[nodiscard]] bool plug_in() const {
    return ip("link add sensor0 type veth peer name wire0 netns " + path_of(there_)) &&
           ip("addr add 10.77.0.1/24 dev sensor0") && ip("link set sensor0 up") &&
           on_the_other(
               [&] { return ip("addr add 10.77.0.2/24 dev wire0") && ip("link set wire0 up"); });
  }
  [[nodiscard]] bool ip(const std::string& arguments) const {
    const std::string command = "PATH=$PATH:/usr/sbin:/sbin ip " + arguments + " 2>/dev/null";
    return std::system(command.c_str()) == 0;
  }

 private:
  using Descriptor = files::OwnedDescriptor;

  PrivateNetwork() : there_(make()), here_(make()) {}

  [[nodiscard]] static Descriptor make() {
    if (::unshare(CLONE_NEWNET) != 0) return {};
    const Descriptor socket(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
    ifreq request{};
    std::strcpy(request.ifr_name, "lo");
    request.ifr_flags = IFF_UP | IFF_RUNNING;
    if (::ioctl(socket.get(), SIOCSIFFLAGS, &request) != 0) return {};
    return Descriptor(::open("/proc/thread-self/ns/net", O_RDONLY | O_CLOEXEC));
  }
  static void enter(const Descriptor& network) {
    if (::setns(network.get(), CLONE_NEWNET) != 0) std::abort();
  }
  [[nodiscard]] static std::string path_of(const Descriptor& network) {
    return "/proc/" + std::to_string(::getpid()) + "/fd/" + std::to_string(network.get());
  }

  Descriptor there_, here_;
};

}  // namespace terracut::test
