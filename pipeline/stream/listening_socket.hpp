// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <sys/types.h>

#include "pipeline/stream/stream_address.hpp"
#include "rt/error.hpp"
#include "rt/files/owned_descriptor.hpp"

namespace terracut::stream {

/// A non-blocking stream socket that listens. It removes the file of a Unix socket at the end.
class ListeningSocket {
 public:
  /// Replaces a Unix socket's file on which nobody listens, as kill -9 leaves one; anything else at
  /// that path is not touched. kNotFound: no such address on this machine, or no such folder.
  /// kUnreadable: address or path taken, or another refusal of the system. `unix_mode` are the
  /// rights of a Unix socket's file, whatever the umask; whoever may write to it may connect.
  [[nodiscard]] static Expected<ListeningSocket> open(const StreamAddress& address,
                                                      ::mode_t unix_mode = kOwnerAndGroup);
  static constexpr ::mode_t kOwnerAndGroup = 0660;

  ListeningSocket(ListeningSocket&& other) noexcept;
  ListeningSocket& operator=(ListeningSocket&& other) noexcept;
  ~ListeningSocket() { close(); }

  [[nodiscard]] int descriptor() const noexcept { return socket_.get(); }
  /// Returns the address, with the port the system chose if asked to.
  [[nodiscard]] const StreamAddress& address() const noexcept { return address_; }

 private:
  ListeningSocket(files::OwnedDescriptor socket, StreamAddress address) noexcept
      : socket_(std::move(socket)), address_(std::move(address)) {}
  void close() noexcept;

  files::OwnedDescriptor socket_;
  StreamAddress address_;
  ::dev_t device_ = 0;  ///< Identify the Unix socket's file, which may have been replaced since.
  ::ino_t inode_ = 0;
};

}  // namespace terracut::stream
