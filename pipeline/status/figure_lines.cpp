// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/status/figure_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "rt/measure/milliseconds.hpp"

namespace terracut::status {
namespace {

constexpr std::size_t kIndent = 10;
constexpr std::size_t kComma = 1;  // a comma may follow in each line

/// Returns "full 98, coarse 2"; with zeros only if `with_zeros`.
std::string text_of(const Counts& counts, bool with_zeros) {
  std::string text;
  for (const auto& [name, count] : counts.each) {
    if (count == 0 && !with_zeros) continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name, count);
  }
  return text;
}

std::string phrase_of(const Figure& figure) {
  const Phrase& phrase = figure.phrase;
  if (phrase.shown == Shown::kAlarmOrNone && is_nothing(figure.value)) return "none";
  const auto text = fmt::runtime(phrase.text);
  return std::visit(
      EachKind{[&](const auto&) { return std::string(phrase.text); },
               [&](const std::string& of) { return fmt::format(text, of); },
               [&](std::uint64_t of) { return fmt::format(text, of); },
               [&](const Number& of) { return fmt::format(text, of.value); },
               [&](const Duration& of) {
                 const double ms = measure::milliseconds(of.ns);
                 return fmt::format(text, fmt::arg("ms", ms), fmt::arg("s", ms / 1000));
               },
               [&](const State& of) { return fmt::format(text, of.names[of.index]); },
               [&](const Counts& of) {
                 return fmt::format(text, text_of(of, phrase.shown == Shown::kAlways));
               }},
      figure.value);
}

class Lines {
 public:
  explicit Lines(const LineStyle& style)
      : style_(style),
        columns_(style.columns > 0 ? static_cast<std::size_t>(style.columns) - kComma : SIZE_MAX) {}

  void add(const Figure& figure) {
    const std::string phrase = phrase_of(figure);
    std::string_view text = phrase;
    const bool begins_anew = text.starts_with('\n');
    if (begins_anew) text.remove_prefix(1);
    if (figure.phrase.line != line_ || begins_anew) begin(figure.phrase.line);
    const bool is_joined = text.starts_with(' ') || text.starts_with(':');
    if (!is_joined && column_ > kIndent) put(",", false);
    const Shown shown = figure.phrase.shown;
    const bool alarms =
        (shown == Shown::kAlarm || shown == Shown::kAlarmOrNone) && !is_nothing(figure.value);
    put_words(is_joined || column_ == kIndent ? std::string(text) : " " + std::string(text),
              alarms);
  }
  [[nodiscard]] std::string take() && {
    if (!text_.empty()) text_ += '\n';
    return std::move(text_);
  }

 private:
  void begin(std::string_view line) {
    if (!text_.empty()) text_ += '\n';
    line_ = line;
    text_ += fmt::format("{:<{}}", line, kIndent);
    column_ = kIndent;
  }
  /// Breaks the line before the whole phrase or, if that is longer than a line, between words.
  void put_words(std::string_view words, bool alarms) {
    const bool fits_a_line = kIndent + words.size() < columns_;
    while (column_ + words.size() > columns_) {
      const std::size_t room = columns_ - std::min(column_, columns_);
      const std::size_t space = fits_a_line ? 0 : words.rfind(' ', room);
      const std::size_t end = space == std::string_view::npos ? 0 : space;
      if (end == 0 && column_ == kIndent) break;  // one long word is not broken
      put(words.substr(0, end), alarms);
      words.remove_prefix(end);
      words.remove_prefix(std::min(words.find_first_not_of(' '), words.size()));
      text_ += '\n' + std::string(kIndent, ' ');
      column_ = kIndent;
    }
    put(words, alarms);
  }
  void put(std::string_view words, bool alarms) {
    const bool is_red = alarms && style_.colours && !words.empty();
    text_ +=
        fmt::format("{}{}{}", is_red ? "\x1b[31m" : "", printable(words), is_red ? "\x1b[0m" : "");
    column_ += words.size();
  }

  LineStyle style_;
  std::size_t columns_;
  std::string_view line_;
  std::string text_;
  std::size_t column_ = 0;
};

}  // namespace

std::string figure_lines(std::span<const Figure> figures, const LineStyle& style) {
  Lines lines(style);
  for (const Figure& figure : figures) {
    if (is_shown(figure) && !std::holds_alternative<Histogram>(figure.value)) lines.add(figure);
  }
  return std::move(lines).take();
}

std::string in_bold(const std::string& text, const LineStyle& style) {
  return style.colours ? "\x1b[1m" + text + "\x1b[0m" : text;
}

std::string printable(std::string_view text) {
  std::string result(text);
  std::ranges::replace_if(result, [](char c) { return c < ' ' || c > '~'; }, '?');
  return result;
}

std::string counts_text(std::span<const NamedCount> counts) {
  return printable(text_of(counts_of({}, counts), false));
}

}  // namespace terracut::status
