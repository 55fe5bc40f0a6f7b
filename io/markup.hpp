// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Text inside SVG and HTML.
#pragma once

#include <string>
#include <string_view>

namespace asperity::io {

/// & < > and the double quote as entities: good between tags and inside attributes.
std::string escape_markup(std::string_view text);

} // namespace asperity::io
