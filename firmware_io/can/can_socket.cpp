// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/can/can_socket.hpp"

#include <fmt/format.h>
#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

namespace terracut::can {
namespace {

using Step = CanSocketFailure::Step;

template <class Value>
bool set_option(int socket, int level, int option, const Value& value) noexcept {
  return ::setsockopt(socket, level, option, &value, sizeof value) == 0;
}

/// Returns a filter that passes exactly this message (number and format), but not a request for it.
::can_filter filter_of(const CanId& id) noexcept {
  constexpr ::canid_t kKind = CAN_EFF_FLAG | CAN_RTR_FLAG;
  if (id.extended) return {id.number | CAN_EFF_FLAG, CAN_EFF_MASK | kKind};
  return {id.number, CAN_SFF_MASK | kKind};
}

}  // namespace

tl::expected<files::OwnedDescriptor, CanSocketFailure> open_can_socket(int interface_index,
                                                                       std::span<const CanId> ids,
                                                                       bool error_frames) noexcept {
  const auto failed = [](Step step) { return tl::unexpected(CanSocketFailure{step, errno}); };
  files::OwnedDescriptor socket(::socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC | SOCK_NONBLOCK, CAN_RAW));
  if (!socket) return failed(Step::kSocket);
  const int descriptor = socket.get();

  // All filters are set before bind(), which starts reception.
  std::array<::can_filter, kMostCanFilters> filters{};
  const std::size_t count = std::min(ids.size(), filters.size());
  std::transform(ids.begin(), ids.begin() + static_cast<std::ptrdiff_t>(count), filters.begin(),
                 filter_of);
  if (::setsockopt(descriptor, SOL_CAN_RAW, CAN_RAW_FILTER, filters.data(),
                   static_cast<socklen_t>(count * sizeof filters[0])) != 0) {
    return failed(Step::kFilter);
  }
  const int on = 1;
  const ::can_err_mask_t errors = error_frames ? CAN_ERR_MASK : 0;
  if (!set_option(descriptor, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, errors) ||
      !set_option(descriptor, SOL_CAN_RAW, CAN_RAW_FD_FRAMES, on) ||
      !set_option(descriptor, SOL_SOCKET, SO_TIMESTAMPNS, on) ||
      !set_option(descriptor, SOL_SOCKET, SO_RXQ_OVFL, on)) {
    return failed(Step::kOptions);
  }
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = interface_index;
  if (::bind(descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    return failed(Step::kBind);
  }
  return socket;
}

Error explain(const CanSocketFailure& failure, const std::string& interface) {
  const std::string reason = std::strerror(failure.error_number);
  if (failure.step == Step::kSocket &&
      (failure.error_number == EAFNOSUPPORT || failure.error_number == EPROTONOSUPPORT)) {
    return {ErrorCode::kUnsupported,
            "this kernel has no CAN sockets; `modprobe can_raw` loads them where it has the "
            "modules"};
  }
  if (failure.step == Step::kBind && failure.error_number == ENODEV) {
    return {ErrorCode::kNotFound,
            fmt::format("'{}' is no CAN interface; `ip link show type can` and `ip link show type "
                        "vcan` list those there are",
                        interface)};
  }
  return {ErrorCode::kUnreadable, fmt::format("CAN socket on '{}': {}", interface, reason)};
}

}  // namespace terracut::can
