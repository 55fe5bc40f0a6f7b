// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/json.hpp"
#include "target.hpp"

#include <cstdlib>
#include <string>

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace asperity;
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    fuzz::try_out([&] {
        const io::Json value = io::parse_json(text, "fuzz.json");
        const std::string written = io::json_text(value);
        if (io::json_text(io::parse_json(written, "fuzz.json")) != written) std::abort();
    });
    return 0;
}
