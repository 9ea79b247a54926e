// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "dump_signal.hpp"

#include <sys/signalfd.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <system_error>

namespace terracut::cli {

DumpSignal::DumpSignal() {
  ::sigset_t only_this;
  ::sigemptyset(&only_this);
  ::sigaddset(&only_this, SIGUSR1);
  if (const int error = ::pthread_sigmask(SIG_BLOCK, &only_this, nullptr); error != 0) {
    throw std::system_error(error, std::generic_category(), "cannot block SIGUSR1");
  }
  descriptor_ = files::OwnedDescriptor(::signalfd(-1, &only_this, SFD_NONBLOCK | SFD_CLOEXEC));
  if (!descriptor_) {
    throw std::system_error(errno, std::generic_category(), "cannot listen for SIGUSR1");
  }
}

bool DumpSignal::take() noexcept {
  ::signalfd_siginfo info;
  bool came = false;
  while (::read(descriptor_.get(), &info, sizeof info) == sizeof info) came = true;
  return came;
}

}  // namespace terracut::cli
