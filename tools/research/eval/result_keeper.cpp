// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "result_keeper.hpp"

#include <algorithm>
#include <utility>

#include "pipeline/output/label_sink.hpp"

namespace terracut::eval {

ResultKeeper::ResultKeeper(std::span<const MethodChoice> methods, std::filesystem::path predictions,
                           Journal* journal)
    : methods_(methods), predictions_(std::move(predictions)), journal_(journal) {
  if (journal_ == nullptr) return;
  for (auto& [key, result] : journal_->take_results()) {
    const bool asked = std::ranges::any_of(
        methods_, [&](const MethodChoice& method) { return method.name == key.method; });
    if (asked) results_.emplace(key, result);
  }
}

void ResultKeeper::expect(const std::string& sequence, const std::string& frame) {
  const std::scoped_lock lock(mutex_);
  expected_.emplace(sequence, frame);
}

std::vector<std::size_t> ResultKeeper::methods_left(const std::string& sequence,
                                                    const std::string& frame) const {
  std::vector<std::size_t> left;
  const std::scoped_lock lock(mutex_);
  for (std::size_t i = 0; i < methods_.size(); ++i) {
    const FrameKey key{sequence, frame, methods_[i].name};
    // An unreadable path counts as missing; the error is reported when it is written to.
    std::error_code ignored;
    const bool done = results_.contains(key) &&
                      (predictions_.empty() || std::filesystem::exists(prediction(key), ignored));
    if (!done) left.push_back(i);
  }
  return left;
}

std::filesystem::path ResultKeeper::prediction(const FrameKey& key) const {
  return predictions_ / key.method / "sequences" / key.sequence / "predictions" /
         (key.frame + ".label");
}

bool ResultKeeper::keep(const FrameKey& key, std::span<const frame::Label> labels,
                        FrameResult result) {
  Status kept;
  if (!predictions_.empty()) {
    kept = output::write_label_file(prediction(key), labels);
  }
  if (kept && journal_ != nullptr) kept = journal_->add(key, result);
  const std::scoped_lock lock(mutex_);
  if (kept) {
    results_.insert_or_assign(key, std::move(result));
  } else if (!failure_) {
    failure_ = kept.error();
  }
  return kept.has_value();
}

std::optional<Error> ResultKeeper::failure() const {
  const std::scoped_lock lock(mutex_);
  return failure_;
}

FrameResults ResultKeeper::take_results() {
  const std::scoped_lock lock(mutex_);
  std::erase_if(results_, [&](const auto& entry) {
    return !expected_.contains({entry.first.sequence, entry.first.frame});
  });
  return std::move(results_);
}

}  // namespace terracut::eval
