// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/vehicle/dbc_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "calib/text/bounded_file.hpp"
#include "calib/text/number_text.hpp"
#include "rt/number_of.hpp"

namespace terracut::vehicle {
namespace {

constexpr std::uint32_t kExtendedMark = 0x80000000;
/// The id of the pseudo-message that holds signals of no message.
constexpr std::uint32_t kIndependentSignals = 0xC0000000;
constexpr std::string_view kSpace = " \t\r";
constexpr std::string_view kNameCharacters =
    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";
constexpr std::string_view kNumberCharacters = "0123456789+-.eEinfaN";

/// Parses a line from left to right. Each function returns whether it found what it looks for, or
/// what it found.
class LineReader {
 public:
  explicit LineReader(std::string_view text) : rest_(text) {}

  bool symbol(char wanted) {
    skip_space();
    if (!rest_.starts_with(wanted)) return false;
    rest_.remove_prefix(1);
    return true;
  }
  std::optional<std::string_view> name() { return run_of(kNameCharacters); }
  std::optional<double> number() {
    const auto text = run_of(kNumberCharacters);
    return text ? text::number_from(*text) : std::nullopt;
  }
  template <class Whole>
  std::optional<Whole> whole() {
    const auto text = run_of(kNumberCharacters);
    return text ? rt::number_of<Whole>(*text) : std::nullopt;
  }
  /// Reads a text between quotation marks.
  std::optional<std::string_view> quoted() {
    if (!symbol('"')) return std::nullopt;
    const std::size_t end = rest_.find('"');
    if (end == std::string_view::npos) return std::nullopt;
    const std::string_view text = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    return text;
  }

 private:
  void skip_space() {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(kSpace), rest_.size()));
  }
  std::optional<std::string_view> run_of(std::string_view characters) {
    skip_space();
    const std::size_t end = std::min(rest_.find_first_not_of(characters), rest_.size());
    if (end == 0) return std::nullopt;
    const std::string_view run = rest_.substr(0, end);
    rest_.remove_prefix(end);
    return run;
  }

  std::string_view rest_;
};

/// Parses "M", "m3" or "m3M" after a signal's name.
std::optional<DbcMultiplex> multiplex_from(std::string_view mark) {
  if (mark == "M") return DbcMultiplex::kSelector;
  if (!mark.starts_with('m')) return std::nullopt;
  mark.remove_prefix(1);
  if (mark.ends_with('M')) mark.remove_suffix(1);
  if (mark.empty() || mark.find_first_not_of("0123456789") != mark.npos) return std::nullopt;
  return DbcMultiplex::kSelected;
}

std::optional<DbcMessage> message_from(LineReader line) {
  DbcMessage message;
  const auto id = line.whole<std::uint32_t>();
  const auto name = line.name();
  if (!id || !name || !line.symbol(':')) return std::nullopt;
  const auto length = line.whole<int>();
  if (!length || *length < 0) return std::nullopt;
  message.written_id = *id;
  message.name = *name;
  message.length = *length;
  return message;
}

std::optional<DbcSignal> signal_from(LineReader line) {
  DbcSignal signal;
  const auto name = line.name();
  if (!name) return std::nullopt;
  signal.name = *name;
  if (const auto mark = line.name()) {
    const auto multiplex = multiplex_from(*mark);
    if (!multiplex) return std::nullopt;
    signal.multiplex = *multiplex;
  }
  if (!line.symbol(':')) return std::nullopt;
  const auto start = line.whole<int>();
  if (!start || !line.symbol('|')) return std::nullopt;
  const auto count = line.whole<int>();
  if (!count || !line.symbol('@')) return std::nullopt;
  if (line.symbol('0')) {
    signal.motorola = true;
  } else if (!line.symbol('1')) {
    return std::nullopt;
  }
  if (line.symbol('-')) {
    signal.number = DbcNumber::kSigned;
  } else if (!line.symbol('+')) {
    return std::nullopt;
  }
  if (!line.symbol('(')) return std::nullopt;
  const auto factor = line.number();
  if (!factor || !std::isfinite(*factor) || !line.symbol(',')) return std::nullopt;
  const auto offset = line.number();
  if (!offset || !std::isfinite(*offset) || !line.symbol(')')) return std::nullopt;
  signal.start_bit = *start;
  signal.bit_count = *count;
  signal.factor = *factor;
  signal.offset = *offset;
  // The minimum and maximum that the file states for a signal are not used.
  if (!line.symbol('[') || !line.number() || !line.symbol('|') || !line.number() ||
      !line.symbol(']')) {
    return std::nullopt;
  }
  const auto unit = line.quoted();
  if (!unit || unit->find('\n') != unit->npos) return std::nullopt;
  signal.unit = *unit;
  return signal;
}

class Parser {
 public:
  explicit Parser(std::string name) { file_.name = std::move(name); }

  /// Reads one logical line, which may hold line ends inside quotation marks.
  Status read(std::string_view text, int line) {
    LineReader reader(text);
    const auto keyword = reader.name();
    if (!keyword) return {};
    if (*keyword == "BO_") return read_message(reader, line);
    if (*keyword == "SG_") return read_signal(reader, line);
    // The list of symbols at the head of a file has the same keywords, with nothing after them.
    if (*keyword == "SIG_VALTYPE_" && text.find_first_of("0123456789") != text.npos) {
      return read_value_type(reader, line);
    }
    return {};
  }

  Expected<DbcFile> finish() && {
    if (file_.messages.empty()) {
      return fail(ErrorCode::kMalformed,
                  fmt::format("{}: no message in it; expected a DBC file with lines like BO_ 291 "
                              "NAME: 8 SENDER",
                              file_.name));
    }
    for (DbcMessage& message : file_.messages) {
      for (DbcSignal& signal : message.signals) {
        const auto type = value_types_.find({message.written_id, signal.name});
        if (type != value_types_.end()) signal.number = type->second;
      }
    }
    std::erase_if(file_.messages, [](const DbcMessage& message) {
      return message.written_id == kIndependentSignals;
    });
    return std::move(file_);
  }

 private:
  Status read_message(const LineReader& reader, int line) {
    auto message = message_from(reader);
    if (!message) {
      return malformed(line, "a message has to read BO_ number NAME: bytes SENDER");
    }
    message->line = line;
    file_.messages.push_back(*std::move(message));
    return {};
  }

  Status read_signal(const LineReader& reader, int line) {
    auto signal = signal_from(reader);
    if (!signal) {
      return malformed(line,
                       "a signal has to read SG_ NAME : start|bits@order sign (factor,offset) "
                       "[least|most] \"unit\" RECEIVERS, order 0 or 1, sign + or -");
    }
    if (file_.messages.empty()) {
      return malformed(line, fmt::format("signal {} stands before any message", signal->name));
    }
    signal->line = line;
    file_.messages.back().signals.push_back(*std::move(signal));
    return {};
  }

  /// Reads "SIG_VALTYPE_ 291 NAME : 1;".
  Status read_value_type(LineReader reader, int line) {
    const auto id = reader.whole<std::uint32_t>();
    const auto name = reader.name();
    reader.symbol(':');  // some writers leave the colon out
    const auto type = reader.whole<int>();
    if (!id || !name || !type || *type < 0 || *type > 2) {
      return malformed(line, "a value type has to read SIG_VALTYPE_ number NAME : 0, 1 or 2;");
    }
    if (*type > 0) {
      value_types_[{*id, std::string(*name)}] = *type == 1 ? DbcNumber::kFloat : DbcNumber::kDouble;
    }
    return {};
  }

  [[nodiscard]] Status malformed(int line, std::string_view what) const {
    return fail(ErrorCode::kMalformed, fmt::format("{}:{}: {}", file_.name, line, what));
  }

  DbcFile file_;
  std::map<std::pair<std::uint32_t, std::string>, DbcNumber> value_types_;
};

/// Returns the end of the line that begins at `begin`. A line end between quotation marks does not
/// count, and a quotation mark after a backslash is part of the quoted text.
std::size_t end_of_line(std::string_view text, std::size_t begin) {
  bool inside = false;
  for (std::size_t at = begin; at < text.size(); ++at) {
    if (text[at] == '"' && !(inside && text[at - 1] == '\\')) inside = !inside;
    if (text[at] == '\n' && !inside) return at;
  }
  return text.size();
}

}  // namespace

std::optional<can::CanId> DbcMessage::id() const noexcept {
  const can::CanId id{written_id & ~kExtendedMark, (written_id & kExtendedMark) != 0};
  return id.valid() ? std::optional(id) : std::nullopt;
}

Expected<DbcFile> parse_dbc(std::string_view text, std::string name) {
  Parser parser(std::move(name));
  int line = 1;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = end_of_line(text, begin);
    const std::string_view whole = text.substr(begin, end - begin);
    if (Status read = parser.read(whole, line); !read) return tl::unexpected(read.error());
    line += static_cast<int>(std::ranges::count(whole, '\n')) + 1;
    begin = end + 1;
  }
  return std::move(parser).finish();
}

Expected<DbcFile> read_dbc(const std::filesystem::path& path) {
  const Expected<std::string> text = text::read_bounded_file(path, "a DBC file");
  if (!text) return tl::unexpected(text.error());
  return parse_dbc(*text, path.string());
}

Expected<DbcReference> find_signal(const DbcFile& file, std::string_view name) {
  const std::size_t dot = name.find('.');
  const std::string_view message_name = dot == name.npos ? "" : name.substr(0, dot);
  const std::string_view signal_name = dot == name.npos ? name : name.substr(dot + 1);
  DbcReference found;
  std::vector<std::string> all;
  bool message_is_there = false;
  for (const DbcMessage& message : file.messages) {
    if (dot != name.npos && message.name != message_name) continue;
    message_is_there = true;
    for (const DbcSignal& signal : message.signals) {
      if (signal.name != signal_name) continue;
      found = {&message, &signal};
      all.push_back(fmt::format("{}.{} (line {})", message.name, signal.name, signal.line));
    }
  }
  if (all.size() == 1) return found;
  if (all.size() > 1) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("{}: there are several signals '{}': {}; name one as MESSAGE.SIGNAL",
                            file.name, name, fmt::join(all, ", ")));
  }
  if (dot != name.npos && !message_is_there) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("{}: no message '{}' in it", file.name, message_name));
  }
  return fail(ErrorCode::kInvalidArgument,
              fmt::format("{}: no signal '{}' in it", file.name, name));
}

}  // namespace terracut::vehicle
