// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/case/case.hpp"
#include "target.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(data), size);
    asperity::fuzz::try_out([&] {
        const asperity::Scene scene = asperity::read_case_text(text, "fuzz.toml").scene;
        // What was read is written and read again as the same.
        const std::string written = asperity::scene_toml(scene, false);
        if (asperity::scene_toml(asperity::read_scene_text(written, "fuzz.toml"), false) != written)
            std::abort();
    });
    return 0;
}
