// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "metrics_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <string_view>
#include <utility>
#include <vector>

#include "pipeline/status/figures.hpp"

namespace terracut::cli {
namespace {

using Labels = std::vector<std::pair<std::string_view, std::string>>;

/// Limits from well below a fast stage to well above a deadline of one frame.
constexpr std::array<std::int64_t, 19> kLimits_us{
    100,    250,    500,    1'000,  2'000,  3'000,  5'000,   7'500,   10'000,   15'000,
    20'000, 25'000, 30'000, 40'000, 50'000, 75'000, 100'000, 200'000, 1'000'000};

/// Escapes a text inside the quotes of a label.
std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '\\' || c == '"') result += '\\';
    result += c == '\n' ? std::string_view("\\n") : std::string_view(&c, 1);
  }
  return result;
}

/// The samples of one metric, which the format wants next to each other.
class Family {
 public:
  explicit Family(const status::Metric& metric, bool is_histogram)
      : name(metric.name),
        text_(fmt::format("# HELP {} {}\n# TYPE {} {}\n", name, metric.help, name,
                          is_histogram               ? "histogram"
                          : name.ends_with("_total") ? "counter"
                                                     : "gauge")) {}

  const std::string_view name;

  void add(const status::Value& value, const Labels& labels) {
    std::visit(status::EachKind{[&](const auto& /*text or nothing*/) {},
                                [&](bool of) { sample("", of ? 1 : 0, labels); },
                                [&](std::uint64_t of) { sample("", of, labels); },
                                [&](const status::Number& of) { sample("", of.value, labels); },
                                [&](const status::TimeOfDay& of) {
                                  sample("", static_cast<double>(of.ns) * 1e-9, labels);
                                },
                                [&](const status::Duration& of) {
                                  sample("", static_cast<double>(of.ns) * 1e-9, labels);
                                },
                                [&](const status::State& of) {
                                  for (std::size_t i = 0; i < of.names.size(); ++i) {
                                    sample("", i == of.index ? 1 : 0,
                                           with(labels, "state", of.names[i]));
                                  }
                                },
                                [&](status::Histogram of) { histogram(*of, labels); },
                                [&]<class Each>(const status::ByName<Each>& of) {
                                  for (const auto& [which, each] : of.each) {
                                    add(each, with(labels, of.label, which));
                                  }
                                }},
               value);
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  static Labels with(Labels labels, std::string_view name, std::string_view value) {
    labels.emplace_back(name, value);
    return labels;
  }
  template <class Number>
  void sample(std::string_view suffix, Number value, const Labels& labels) {
    std::string listed;
    for (const auto& [label, text] : labels) {
      listed += fmt::format("{}{}=\"{}\"", listed.empty() ? "{" : ",", label, escaped(text));
    }
    if (!listed.empty()) listed += '}';
    fmt::format_to(std::back_inserter(text_), "{}{}{} {}\n", name, suffix, listed, value);
  }
  void histogram(const measure::LogLinearHistogram& times, const Labels& labels) {
    for (const std::int64_t limit_us : kLimits_us) {
      sample("_bucket", times.count_not_above(limit_us * 1000),
             with(labels, "le", fmt::format("{}", static_cast<double>(limit_us) / 1e6)));
    }
    sample("_bucket", times.count(), with(labels, "le", "+Inf"));
    sample("_sum", times.sum_ns() * 1e-9, labels);
    sample("_count", times.count(), labels);
  }

  std::string text_;
};

}  // namespace

std::string metrics_text(const status::MonitorSnapshot& figures) {
  std::vector<Family> families;
  for (const status::Figure& figure : status::figures_of(figures)) {
    if (figure.metric.name.empty()) continue;
    auto family = std::ranges::find(families, figure.metric.name, &Family::name);
    if (family == families.end()) {
      const bool is_histogram = std::holds_alternative<status::Histogram>(figure.value) ||
                                std::holds_alternative<status::Histograms>(figure.value);
      families.emplace_back(figure.metric, is_histogram);
      family = families.end() - 1;
    }
    family->add(figure.value, figure.metric.labels);
  }
  std::string text;
  for (const Family& family : families) text += family.text();
  return text;
}

}  // namespace terracut::cli
