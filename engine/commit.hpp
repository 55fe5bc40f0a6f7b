// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#pragma once

namespace asperity {

/// Commit that this program was built from, with "-dirty" if the tree had changes; "unknown"
/// outside git.
extern const char* const build_commit;

} // namespace asperity
