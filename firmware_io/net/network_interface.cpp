// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/net/network_interface.hpp"

#include <fmt/format.h>
#include <net/if.h>
#include <sys/ioctl.h>

#include <algorithm>
#include <memory>

namespace terracut::net {
namespace {

struct FreeNames {
  void operator()(struct if_nameindex* names) const noexcept { ::if_freenameindex(names); }
};

/// Returns the names of all interfaces: "lo, eth0".
std::string interface_names() {
  const std::unique_ptr<struct if_nameindex, FreeNames> names(::if_nameindex());
  std::string text;
  for (const struct if_nameindex* each = names.get(); each != nullptr && each->if_index != 0;
       ++each) {
    text += (text.empty() ? "" : ", ") + std::string(each->if_name);
  }
  return text.empty() ? "none" : text;
}

}  // namespace

InterfaceStatus interface_status(int socket, const std::string& name) noexcept {
  static_assert(kInterfaceNameLength == IFNAMSIZ - 1);
  ifreq request{};
  std::copy_n(name.data(), std::min(name.size(), kInterfaceNameLength), request.ifr_name);
  // The kernel answers from its table without waiting, and it is asked only while no packet is
  // there to be read.
  const auto ask = [&](unsigned long what) noexcept {
    return threads::trusted_call([&]() noexcept { return ::ioctl(socket, what, &request); }) == 0;
  };
  if (!ask(SIOCGIFINDEX)) return {};
  const int index = request.ifr_ifindex;
  if (!ask(SIOCGIFFLAGS)) return {};
  const unsigned flags = static_cast<unsigned short>(request.ifr_flags);
  const bool up = (flags & IFF_UP) != 0 && (flags & IFF_RUNNING) != 0;
  return {up ? LinkState::kUp : LinkState::kDown, index};
}

Error no_such_interface(const std::string& name) {
  return {ErrorCode::kNotFound,
          fmt::format("no such interface '{}'; there are: {}", name, interface_names())};
}

}  // namespace terracut::net
