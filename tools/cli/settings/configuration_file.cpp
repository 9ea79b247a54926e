// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "configuration_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "calib/text/bounded_file.hpp"
#include "calib/text/yaml_document.hpp"
#include "pipeline/ground/parameter_table.hpp"
#include "rt/nearest_word.hpp"
#include "setting_text.hpp"

namespace terracut::cli {
namespace {

constexpr std::string_view kMethod = "method.";

/// Returns all keys that a file may have, in the order in which they are written.
std::vector<std::string> all_keys() {
  std::vector<std::string> keys;
  for (const Setting& setting : settings()) {
    if (setting.key.empty()) continue;
    keys.emplace_back(setting.key);
    if (setting.key != "method.stages") continue;
    for (const ground::Parameter& parameter : ground::parameters()) {
      keys.push_back(fmt::format("{}{}", kMethod, parameter.key));
    }
  }
  return keys;
}

class Reader {
 public:
  Reader(std::string name, std::filesystem::path base)
      : name_(std::move(name)), base_(std::move(base)), keys_(all_keys()) {}

  Status read(const YAML::Node& root) {
    if (root.IsNull()) return {};  // only comments
    if (!root.IsMap()) return refuse(root, "expected sections such as `sensor:` with keys below");
    return read_section(root, "");
  }

  [[nodiscard]] Options take() && { return std::move(options_); }

 private:
  /// Reads the keys of a section. `section` is empty for the whole file; else it ends with a dot.
  Status read_section(const YAML::Node& map, const std::string& section) {
    std::map<std::string, int> line_of;
    for (const auto& entry : map) {
      if (!entry.first.IsScalar()) return refuse(entry.first, "a key has to be a word");
      const std::string key = section + entry.first.Scalar();
      const int line = entry.first.Mark().line + 1;
      if (const auto [before, fresh] = line_of.emplace(key, line); !fresh) {
        return refuse(entry.first, fmt::format("'{}' stands here a second time, after line {}", key,
                                               before->second));
      }
      if (Status read = read_entry(entry.first, entry.second, key); !read) return read;
    }
    return {};
  }

  Status read_entry(const YAML::Node& key_node, const YAML::Node& value, const std::string& key) {
    const bool is_section = std::ranges::any_of(
        keys_, [&](const std::string& known) { return known.starts_with(key + "."); });
    if (!is_section && std::ranges::find(keys_, key) == keys_.end()) {
      return refuse(key_node, unknown(key));
    }
    if (is_section) {
      if (value.IsNull()) return {};  // none of its keys is given
      if (!value.IsMap()) {
        return refuse(value, fmt::format("{}: expected keys below it, found {}", key, kind(value)));
      }
      return read_section(value, key + ".");
    }
    if (!value.IsScalar()) {
      return refuse(value.IsNull() ? key_node : value,
                    fmt::format("{}: expected one value, found {}", key, kind(value)));
    }
    return apply(value, key);
  }

  Status apply(const YAML::Node& value, const std::string& key) {
    if (const Setting* setting = find_setting(key)) {
      const Status applied = apply_text(*setting, value.Scalar(), base_, options_);
      return applied ? applied : refuse(value, fmt::format("{}: {}", key, applied.error().message));
    }
    std::string text = fmt::format("{}={}", key.substr(kMethod.size()), value.Scalar());
    ground::SegmenterConfig scratch;
    if (const Status valid = ground::apply_setting(scratch, text); !valid) {
      return refuse(value, fmt::format("{}{}", kMethod, valid.error().message));
    }
    options_.method.settings.push_back(std::move(text));
    return {};
  }

  /// Suggests known keys or sections similar to the unknown one.
  [[nodiscard]] std::string unknown(const std::string& key) const {
    const std::size_t dot = key.rfind('.');
    const std::string section = dot == std::string::npos ? "" : key.substr(0, dot + 1);
    std::vector<std::string_view> beside;
    for (const std::string_view known : keys_) {
      if (!known.starts_with(section)) continue;
      const std::string_view rest = known.substr(section.size());
      const std::string_view word = rest.substr(0, rest.find('.'));
      if (std::ranges::find(beside, word) == beside.end()) beside.push_back(word);
    }
    const std::string_view meant =
        rt::nearest_word(std::string_view(key).substr(section.size()), beside);
    return fmt::format("unknown key '{}'{}; {} {}", key,
                       meant.empty() ? "" : fmt::format(" (did you mean {}{}?)", section, meant),
                       section.empty() ? std::string("there are the sections")
                                       : fmt::format("'{}' has", key.substr(0, dot)),
                       fmt::join(beside, ", "));
  }

  static std::string_view kind(const YAML::Node& value) {
    if (value.IsMap()) return "keys";
    if (value.IsSequence()) return "a list";
    return value.IsNull() ? "none" : "a value";
  }

  [[nodiscard]] Status refuse(const YAML::Node& node, std::string_view what) const {
    return fail(ErrorCode::kMalformed, fmt::format("{}: {}", text::where_is(node, name_), what));
  }

  std::string name_;
  std::filesystem::path base_;
  std::vector<std::string> keys_;
  Options options_;
};

}  // namespace

Expected<Options> parse_configuration(std::string_view text, const std::string& name,
                                      const std::filesystem::path& base) {
  const Expected<YAML::Node> document = text::load_yaml_document(text, name);
  if (!document) return tl::unexpected(document.error());
  Reader reader(name, base);
  if (const Status read = reader.read(*document); !read) return tl::unexpected(read.error());
  return std::move(reader).take();
}

Expected<Options> read_configuration(const std::filesystem::path& path) {
  const Expected<std::string> text = text::read_bounded_file(path, "a configuration of terracut");
  if (!text) return tl::unexpected(text.error());
  return parse_configuration(*text, path.string(), path.parent_path());
}

}  // namespace terracut::cli
