// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/commands.hpp"
#include "tools/cli/compare/changed_pictures.hpp"
#include "tools/cli/compare/label_changes.hpp"
#include "tools/cli/compare/labelling.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/json_text.hpp"
#include "tools/cli/stop_signal.hpp"

namespace terracut::cli {

ExitCode run_compare(const Options& options) {
  const auto before = find_labelling(options.compare.before);
  if (!before) return refuse(before.error());
  const auto after = find_labelling(options.compare.after);
  if (!after) return refuse(after.error());
  catch_stop_signals();
  const auto most = static_cast<std::size_t>(options.compare.most);
  const auto changes = compare_labels(*before, *after, most, options.compare.trust_sums);
  if (!changes) return refuse_work(changes.error());
  print_text(changes->text(most));
  if (Status written = write_json(options.output.json, changes->json()); !written) {
    return refuse(written.error());
  }
  if (options.output.png.empty()) return kOk;
  return done_or_refused(draw_changes(*before, *after, changes->most, options.output));
}

}  // namespace terracut::cli
