// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <sys/types.h>

#include "pipeline/stream/stream_address.hpp"
#include "rt/error.hpp"
#include "rt/files/owned_descriptor.hpp"

namespace terracut::stream {

/// A non-blocking stream socket that listens. Its destructor removes the file of a Unix socket.
class ListeningSocket {
 public:
  /// Opens the socket. Replaces a Unix socket's file on which nobody listens, as kill -9 leaves
  /// one, but no other file at that path. Fails with kNotFound if this machine has no such address
  /// or folder, kUnreadable if address or path is in use or the system refuses for another reason.
  /// `unix_mode` gives the rights of a Unix socket's file, whatever the umask; whoever may write to
  /// the file may connect.
  [[nodiscard]] static Expected<ListeningSocket> open(const StreamAddress& address,
                                                      ::mode_t unix_mode = kOwnerAndGroup);
  static constexpr ::mode_t kOwnerAndGroup = 0660;

  ListeningSocket(ListeningSocket&& other) noexcept;
  ListeningSocket& operator=(ListeningSocket&& other) noexcept;
  ~ListeningSocket() { close(); }

  [[nodiscard]] int descriptor() const noexcept { return socket_.get(); }
  /// Returns the address; its port is the system's choice if port 0 was asked for.
  [[nodiscard]] const StreamAddress& address() const noexcept { return address_; }

 private:
  ListeningSocket(files::OwnedDescriptor socket, StreamAddress address) noexcept
      : socket_(std::move(socket)), address_(std::move(address)) {}
  void close() noexcept;

  files::OwnedDescriptor socket_;
  StreamAddress address_;
  ::dev_t device_ = 0;  ///< With inode_, identifies the Unix socket's own file.
  ::ino_t inode_ = 0;
};

}  // namespace terracut::stream
