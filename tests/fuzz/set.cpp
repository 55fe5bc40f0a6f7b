// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/case/case.hpp"
#include "target.hpp"

#include <vector>

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::string_view rest(reinterpret_cast<const char*>(data), size);
    std::vector<std::string> overrides;
    while (!rest.empty() && overrides.size() < 16) {
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        overrides.emplace_back(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    asperity::fuzz::try_out([&] { asperity::read_case_text("", "fuzz.toml", overrides); });
    return 0;
}
