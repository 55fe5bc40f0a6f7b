// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What a misspelt name was meant to be.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace asperity::io {

/// The name among candidates that a misspelt word most likely meant; empty if none is near.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

} // namespace asperity::io
