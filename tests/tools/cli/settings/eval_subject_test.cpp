// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/settings/eval_subject.hpp"

#include <gmock/gmock.h>

namespace terracut::cli {
namespace {

using testing::ElementsAre;

EvalSubject subject(const std::string& dataset, const std::string& root,
                    std::vector<std::string> more = {}) {
  EvalOptions options;
  options.dataset = dataset;
  options.root = root;
  options.more_roots = std::move(more);
  return subject_of(options);
}

TEST(EvalSubject, IsTheDatasetAndItsRoot) {
  const EvalSubject of_scans = subject("koblenz", "maps");
  EXPECT_EQ(of_scans.dataset, "koblenz");
  EXPECT_THAT(of_scans.roots, ElementsAre("maps"));
  EXPECT_EQ(of_scans.extra, EvalExtra::kNone);
}

TEST(EvalSubject, OfHazardsIsADatasetThatIsNamedOrSemanticKitti) {
  const EvalSubject named = subject("hazards", "nuscenes", {"a", "b"});
  EXPECT_EQ(named.dataset, "nuscenes");
  EXPECT_THAT(named.roots, ElementsAre("a", "b"));
  EXPECT_EQ(named.extra, EvalExtra::kHazards);
  const EvalSubject folders = subject("hazards", "a", {"b"});
  EXPECT_EQ(folders.dataset, "semantickitti");
  EXPECT_THAT(folders.roots, ElementsAre("a", "b"));
  EXPECT_THAT(subject("hazards", "semantickitti").roots, ElementsAre("semantickitti"))
      << "a folder of that name";
}

TEST(EvalSubject, OfObjectsIsNamedLikeThatOfHazards) {
  const EvalSubject folders = subject("objects", "a", {"b"});
  EXPECT_EQ(folders.extra, EvalExtra::kObjects);
  EXPECT_EQ(folders.dataset, "semantickitti");
  EXPECT_THAT(folders.roots, ElementsAre("a", "b"));
}

TEST(EvalSubject, OfHazardsInDrivesIsTheirScenesOrAll) {
  const EvalSubject two = subject("hazards", "simulated", {"street,hill"});
  EXPECT_EQ(two.dataset, "simulated");
  EXPECT_THAT(two.roots, ElementsAre("street,hill"));
  EXPECT_THAT(subject("hazards", "simulated", {"street", "hill"}).roots,
              ElementsAre("street,hill"));
  EXPECT_THAT(subject("hazards", "simulated").roots, ElementsAre("street,highway,rural,flat,hill"));
}

}  // namespace
}  // namespace terracut::cli
