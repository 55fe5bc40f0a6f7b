// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Approach step by step; once in contact the top plane is led by hand, and the solids are pulled
// apart.
//
//     g++ -std=c++17 stepping.cpp $(pkg-config --cflags --libs asperity) && ./a.out scene.toml
#include <asperity.hpp>

#include <cstdio>

int main(int argc, char** argv) {
    if (argc != 2) return std::fprintf(stderr, "usage: %s SCENE\n", argv[0]), 2;
    try {
        libasperity::Simulation sim(libasperity::Scene::read(argv[1]));
        double strongest = 0.0;
        sim.every(10, [&] {
            if (-sim.force() > strongest) strongest = -sim.force();
        });
        while (!sim.done() && sim.contact_fraction() < 0.5)
            sim.step(20);
        const libasperity::RestState rest = sim.relax();
        std::printf("in contact after %.1f ps; at rest %.2f meV/Å^2\n", sim.time(),
                    rest.binding_energy);
        sim.set_top_velocity(100.0); // m/s, away
        while (sim.contact_fraction() > 0.0)
            sim.step(100);
        std::printf("parted after %.1f ps, largest attraction %.1f eV/Å\n", sim.time(), strongest);
    } catch (const libasperity::Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return error.code();
    }
}
