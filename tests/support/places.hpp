// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>

namespace terracut::test {

/// The checkout that the tests were built from.
std::filesystem::path source_folder();

/// The program `terracut` of the same build.
std::filesystem::path program();

/// The capture that the ctest fixture `cli_drive` makes.
std::filesystem::path drive();

/// A file or folder below the shared data: of $TERRACUT_SHARED, or of `shared` beside the checkout.
/// Perhaps not there: what needs it skips with a reason.
std::filesystem::path shared_data(const std::filesystem::path& relative);

}  // namespace terracut::test
