// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/json_value.hpp"
#include "target.hpp"

#include <cstdlib>
#include <string>

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace asperity;
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    fuzz::try_out([&] {
        const io::JsonValue value = io::JsonValue::parse(text, "fuzz.json");
        const std::string written = value.dump(-1);
        if (io::JsonValue::parse(written, "fuzz.json").dump(-1) != written) std::abort();
    });
    return 0;
}
