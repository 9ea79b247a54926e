// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/can/candump_source.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <limits>
#include <system_error>
#include <utility>

#include "firmware_io/can/candump_line.hpp"

namespace terracut::can {

Expected<CandumpSource> CandumpSource::open(const std::filesystem::path& path,
                                            std::string interface) {
  std::error_code error;
  const auto kind = std::filesystem::status(path, error).type();
  if (kind == std::filesystem::file_type::not_found) {
    return fail(ErrorCode::kNotFound,
                fmt::format("{}: no such file; expected a log of `candump -l`", path.string()));
  }
  if (kind == std::filesystem::file_type::directory) {
    return fail(ErrorCode::kUnreadable,
                fmt::format("{}: is a folder; name the log file inside it", path.string()));
  }
  auto file = std::make_unique<std::ifstream>(path, std::ios::binary);
  if (!*file) {
    return fail(ErrorCode::kUnreadable,
                fmt::format("{}: cannot be read: {}", path.string(), std::strerror(errno)));
  }
  return CandumpSource(std::move(file), path.string(), std::move(interface));
}

CandumpSource::CandumpSource(std::unique_ptr<std::istream> stream, std::string name,
                             std::string interface)
    : stream_(std::move(stream)), name_(std::move(name)), interface_(std::move(interface)) {}

std::optional<std::string_view> CandumpSource::read_line() {
  // If only failbit is set, the line is longer than the buffer; getline() has left the remaining
  // characters in the stream.
  stream_->getline(line_.data(), static_cast<std::streamsize>(line_.size()));
  const auto count = static_cast<std::size_t>(stream_->gcount());
  too_long_ = stream_->fail() && count == kMostLine;
  if (too_long_) {
    stream_->clear(stream_->rdstate() & ~std::ios::failbit);
    stream_->ignore(std::numeric_limits<std::streamsize>::max(), '\n');
    return std::string_view(line_.data(), count);
  }
  if (stream_->fail()) return std::nullopt;
  // The count includes the end of line, unless the file ends without one.
  return std::string_view(line_.data(), stream_->eof() ? count : count - 1);
}

void CandumpSource::note(std::string_view what, bool malformed) {
  ++(malformed ? counters_.malformed : counters_.no_frame);
  std::string& first = malformed ? first_fault_ : first_no_frame_;
  if (first.empty()) first = fmt::format("{}:{}: {}", name_, counters_.records, what);
}

Expected<std::optional<CanFrame>> CandumpSource::next() {
  while (const auto line = read_line()) {
    ++counters_.records;
    if (too_long_) {
      static_assert(kMostLine == 511);
      note("the line has more than 511 characters", true);
      continue;
    }
    const auto parsed = parse_candump_line(*line);
    if (!parsed) {
      note(parsed.error().what, parsed.error().malformed);
    } else if (!interface_.empty() && parsed->interface != interface_) {
      ++counters_.other_interface;
      if (first_other_interface_.empty()) first_other_interface_ = parsed->interface;
    } else {
      ++counters_.delivered;
      return parsed->frame;
    }
  }
  if (Status ended = end(); !ended) return tl::unexpected(ended.error());
  return std::nullopt;
}

Status CandumpSource::end() const {
  if (stream_->bad()) {
    return fail(ErrorCode::kUnreadable,
                fmt::format("{}: could not be read on after line {}", name_, counters_.records));
  }
  if (counters_.delivered > 0) return {};
  if (counters_.other_interface > 0) {
    return fail(ErrorCode::kNothingCameOut,
                fmt::format("{}: no frame of interface '{}'; found frames of '{}'", name_,
                            interface_, first_other_interface_));
  }
  const std::string& reason = first_fault_.empty() ? first_no_frame_ : first_fault_;
  return fail(ErrorCode::kMalformed,
              fmt::format("{}: no frame in {} lines; expected a log of `candump -l`, a line of "
                          "which reads (1700000000.123456) can0 0AA#1A2B{}{}",
                          name_, counters_.records, reason.empty() ? "" : "; ", reason));
}

}  // namespace terracut::can
