// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/text/yaml_document.hpp"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>

#include <algorithm>
#include <exception>
#include <sstream>

#include "calib/text/bounded_file.hpp"

namespace terracut::text {
namespace {

/// Why a document is refused.
struct Refusal {
  int line;
  std::string what;
};

/// Returns a message of the parser, which may quote the text, with a '?' for what cannot be
/// printed.
std::string printable(std::string message) {
  std::ranges::replace_if(message, [](char c) { return c < ' ' || c > '~'; }, '?');
  return message;
}

/// Walks through the text without building a tree. Throws a Refusal at the first item that is too
/// large, or at a second document.
class Guard final : public YAML::EventHandler {
 public:
  void OnDocumentStart(const YAML::Mark& mark) override {
    // One that is empty is harmless behind the first; of some bytes the parser makes endlessly many.
    if (++documents_ > 2) throw Refusal{mark.line + 1, "a third document; expected one"};
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t) override {
    if (documents_ == 1) count(mark);  // an empty second document is harmless
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    throw Refusal{mark.line + 1, "aliases (*name) are not supported here"};
  }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                const std::string&) override {
    count(mark);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {
    enter(mark);
  }
  void OnSequenceEnd() override { --depth_; }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {
    enter(mark);
  }
  void OnMapEnd() override { --depth_; }

 private:
  void count(const YAML::Mark& mark) {
    if (documents_ > 1) {
      throw Refusal{mark.line + 1, "a second document (after a line '---'); expected one"};
    }
    if (++nodes_ > kMaxYamlNodes) {
      throw Refusal{mark.line + 1, fmt::format("more than {} values", kMaxYamlNodes)};
    }
  }
  void enter(const YAML::Mark& mark) {
    count(mark);
    if (++depth_ > kMaxYamlDepth) {
      throw Refusal{mark.line + 1, fmt::format("nested deeper than {} levels", kMaxYamlDepth)};
    }
  }

  int documents_ = 0;
  int depth_ = 0;
  int nodes_ = 0;
};

}  // namespace

Expected<YAML::Node> load_yaml_document(std::string_view text, const std::string& name) {
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) {
    return fail(ErrorCode::kMalformed, name + ": is empty, expected YAML");
  }
  if (text.size() > kMaxFileBytes) {
    return fail(ErrorCode::kUnsupported, name + ": is larger than 4 MiB");
  }
  // Counts brackets before parsing: the scanner reads ahead without a limit and would take 1 GB for
  // 4 MiB of brackets before the guard sees the first of them.
  const auto is_opening = [](char c) { return c == '[' || c == '{'; };
  if (std::count_if(text.begin(), text.end(), is_opening) > kMaxYamlNodes) {
    return fail(ErrorCode::kUnsupported,
                fmt::format("{}: more than {} lists and maps", name, kMaxYamlNodes));
  }
  try {
    const std::string document(text);
    std::istringstream stream(document);
    Guard guard;
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(guard)) {
    }
    return YAML::Load(document);
  } catch (const Refusal& refusal) {
    return fail(ErrorCode::kUnsupported,
                fmt::format("{}: line {}: {}", name, refusal.line, refusal.what));
  } catch (const YAML::Exception& error) {
    return fail(ErrorCode::kMalformed, fmt::format("{}: line {}: not well-formed YAML: {}", name,
                                                   error.mark.line + 1, printable(error.msg)));
  } catch (const std::exception& error) {
    return fail(ErrorCode::kMalformed,
                fmt::format("{}: not readable as YAML: {}", name, printable(error.what())));
  }
}

std::string where_is(const YAML::Node& node, const std::string& name) {
  return fmt::format("{}: line {}", name, node.Mark().line + 1);
}

}  // namespace terracut::text
