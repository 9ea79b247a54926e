// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/bag/bag.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>
#include <tuple>
#include <utility>

#include "firmware_io/bag/unpacked.hpp"
#include "rt/files/ending.hpp"
#include "rt/files/plain_file.hpp"

namespace terracut::bag {
namespace {

namespace fs = std::filesystem;

bool is_packed_name(const fs::path& path) {
  const std::string ending = files::ending_of(path);
  return ending == ".zstd" || ending == ".zst";
}

std::size_t read_first(const fs::path& path, std::span<std::byte> bytes) {
  const auto file = files::open_plain_file(path);
  if (!file) return 0;
  const ::ssize_t got = ::read(file->get(), bytes.data(), bytes.size());
  return got < 0 ? 0 : static_cast<std::size_t>(got);
}

/// What a name is sorted by: "drive_10.mcap" comes after "drive_9.mcap".
std::tuple<std::string, std::size_t, std::string, std::string> order_of(const fs::path& path) {
  std::string stem = (is_packed_name(path) ? path.stem() : path).stem().string();
  const std::size_t text = stem.find_last_not_of("0123456789") + 1;
  std::string number = stem.substr(text);
  number.erase(0, std::min(number.find_first_not_of('0'), number.size()));
  stem.resize(text);
  const std::size_t digits = number.size();
  return {std::move(stem), digits, std::move(number), path.filename().string()};
}

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code error;
  fs::directory_iterator entry(folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    const fs::path& path = entry->path();
    std::error_code vanished;
    const bool is_hidden = path.filename().string().starts_with('.');
    if (!is_hidden && is_bag_name(path) && entry->is_regular_file(vanished)) {
      found.push_back(path);
    }
  }
  std::ranges::sort(found, {}, order_of);
  return found;
}

OpenedFile open_plain(const fs::path& path, const std::string& name) {
  std::array<std::byte, kFirstBytes> bytes{};
  const auto first = std::span(bytes).first(read_first(path, bytes));
  if (begins_as_mcap(first)) return open_mcap(path, name);
  if (begins_as_sqlite(first)) return open_sqlite(path, name);
  return fail(
      ErrorCode::kMalformed,
      name + (first.empty() ? ": is empty, or cannot be read; expected MCAP or an SQLite bag"
                            : ": is neither MCAP nor an SQLite bag"));
}

}  // namespace

bool begins_as_sqlite(std::span<const std::byte> first_bytes) noexcept {
  constexpr std::string_view kMagic("SQLite format 3\0", kFirstBytes);
  return first_bytes.size() >= kMagic.size() &&
         std::ranges::equal(first_bytes.first(kMagic.size()), std::as_bytes(std::span(kMagic)));
}

bool is_bag_name(const fs::path& path) {
  const std::string ending = files::ending_of(is_packed_name(path) ? path.stem() : path);
  return ending == ".mcap" || ending == ".db3";
}

bool is_bag(const fs::path& path) {
  std::error_code none;
  if (fs::is_directory(path, none)) {
    const std::vector<fs::path> files = files_in(path);
    if (files.empty() || fs::exists(path / kMetadataFile, none)) return !files.empty();
    const std::string stem = std::get<0>(order_of(files.front()));
    return std::ranges::all_of(
        files, [&](const fs::path& file) { return std::get<0>(order_of(file)) == stem; });
  }
  std::array<std::byte, kFirstBytes> bytes{};
  const auto first = std::span(bytes).first(read_first(path, bytes));
  return begins_as_mcap(first) || begins_as_sqlite(first) ||
         (begins_as_zstd(first) && is_packed_name(path) && is_bag_name(path));
}

std::vector<fs::path> files_of(const fs::path& bag) {
  std::error_code none;
  return fs::is_directory(bag, none) ? files_in(bag) : std::vector{bag};
}

Expected<Bag> Bag::open(const fs::path& path) {
  Bag bag(path.string());
  bag.files_ = files_of(path);
  if (bag.files_.empty()) {
    return fail(ErrorCode::kNotFound, bag.name_ + ": holds no file of a bag (.mcap, .db3)");
  }
  // From the last file to the first, which is then open. One that cannot be read, such as the last
  // one of a recorder that was killed, is an error when it is reached.
  for (std::size_t i = bag.files_.size(); i-- > 0;) {
    const Status opened = bag.open_file(i);
    if (!opened && i == 0) return tl::unexpected(opened.error());
  }
  return bag;
}

Status Bag::open_file(std::size_t index) {
  file_.reset();
  unpacked_.reset();
  open_ = index;
  const fs::path& path = files_[index];
  std::array<std::byte, kFirstBytes> bytes{};
  const auto first = std::span(bytes).first(read_first(path, bytes));
  if (begins_as_zstd(first)) {
    auto temporary = TemporaryFile::make();
    if (!temporary) return tl::unexpected(temporary.error());
    unpacked_.emplace(*std::move(temporary));
    if (Status done = unpack_zstd_file(path, unpacked_->descriptor()); !done) {
      return fail(done.error().code, path.string() + ": " + done.error().message);
    }
  }
  auto opened = open_plain(unpacked_ ? unpacked_->path() : path, path.string());
  if (!opened) return tl::unexpected(opened.error());
  file_ = *std::move(opened);
  topic_of_.clear();
  for (const Topic& topic : file_->topics()) {
    const auto known = std::ranges::find(topics_, topic);
    topic_of_.push_back(static_cast<std::size_t>(known - topics_.begin()));
    if (known == topics_.end()) topics_.push_back(topic);
  }
  return {};
}

Expected<std::optional<Bag::Found>> Bag::next(const std::vector<bool>& wanted) {
  while (!broke_off_ && file_ != nullptr) {
    wanted_here_.assign(topic_of_.size(), false);
    for (std::size_t i = 0; i < topic_of_.size(); ++i) {
      wanted_here_[i] = topic_of_[i] < wanted.size() && wanted[topic_of_[i]];
    }
    auto message = file_->next(wanted_here_);
    if (!message) {
      broke_off_ = message.error();
      break;
    }
    if (!*message) {
      if (open_ + 1 == files_.size()) return std::nullopt;
      if (const Status opened = open_file(open_ + 1); !opened) broke_off_ = opened.error();
      continue;
    }
    Found found{**message, {open_, (*message)->place}};
    found.message.topic = topic_of_[found.message.topic];
    if (begins_as_zstd(found.message.bytes)) {
      if (const Status done = unpack("zstd", found.message.bytes, plain_); !done) {
        broke_off_ = Error{done.error().code,
                           fmt::format("{}: a message of {}: {}", name_,
                                       topics_[found.message.topic].name, done.error().message)};
        break;
      }
      found.message.bytes = plain_;
    }
    return found;
  }
  return tl::unexpected(*broke_off_);
}

Status Bag::seek(Position position) {
  broke_off_.reset();
  if (file_ == nullptr || position.file != open_) {
    if (Status opened = open_file(position.file); !opened) {
      broke_off_ = opened.error();
      return opened;
    }
  }
  return file_->seek(position.place);
}

}  // namespace terracut::bag
