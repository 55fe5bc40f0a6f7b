// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include <asperity.hpp>
#include <cstdio>

int main(int argc, char** argv) {
    if (argc != 3) return 2; // first_contact SCENE DIRECTORY
    try {
        const auto scene = libasperity::Scene::read(argv[1], {"drive.path=zero-load"});
        const auto result = libasperity::run(scene, argv[2]);
        std::printf("binding energy %.4f %s\n", result.number("binding_energy"),
                    result.unit("binding_energy").c_str());
    } catch (const libasperity::Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return error.code();
    }
}
