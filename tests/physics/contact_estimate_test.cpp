// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Estimates of a contact from the waves of the block that is simulated, beside the contacts that
// the program finds.
#include "engine/case/contact_estimate.hpp"
#include "engine/units.hpp"
#include "support/message.hpp"
#include "support/run_scene.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

namespace asperity {
namespace {

BlockOptions half_space() {
    BlockOptions block;
    block.spacing = 10.0;
    block.young = 2.0 * units::gigapascal;
    block.poisson = 0.3;
    block.free_edges = true;
    return block;
}

TEST(ContactEstimate, AModulusIsThatOfTheWavesOfTheBlock) {
    BlockOptions block = half_space();
    const double plain = block.contact_modulus();
    for (const double q : {1e-9, 1e-3, 0.1, 10.0})
        EXPECT_EQ(contact_modulus_at(block, q), plain);
    // A surface stress Y adds Y q^2 to S.
    block.surface_stress = 0.5;
    EXPECT_NEAR(contact_modulus_at(block, 0.01), plain + 2.0 * 0.5 * 0.01, 1e-3 * plain);
    block.surface_stress = 0.0;
    // A coating: short waves have its modulus, long ones that of the block.
    Material stiff = block;
    stiff.young *= 10.0;
    block.layers = {{stiff, 100.0}};
    EXPECT_NEAR(contact_modulus_at(block, 1.0) / plain, 10.0, 0.1);
    EXPECT_NEAR(contact_modulus_at(block, 1e-5) / plain, 1.0, 0.01);
    // At q t = 1: 2.715; a film of ten cells is stiffer.
    EXPECT_NEAR(contact_modulus_at(block, 0.01) / plain, 2.715, 0.06);
    block.continuum = true;
    EXPECT_NEAR(contact_modulus_at(block, 0.01) / plain, 2.715, 0.002);
    block.continuum = false;
    // A held top plane stiffens waves that are longer than the block is thick.
    BlockOptions thin = half_space();
    thin.free_edges = false;
    thin.thickness = 20;
    EXPECT_EQ(contact_modulus_at(thin, 0.1), plain);
    EXPECT_GT(contact_modulus_at(thin, 0.002), 3.0 * plain);
}

TEST(ContactEstimate, TheStripBesideAnEdgeSolvesItsEquation) {
    BlockOptions block = half_space();
    const double adhesion = 0.003, range = 5.0;
    EXPECT_EQ(edge_strip(block, adhesion, range),
              block.contact_modulus() * (range * range / adhesion));
    block.surface_stress = 0.5;
    Material soft = block;
    soft.young *= 0.1;
    block.layers = {{soft, 50.0}};
    const double strip = edge_strip(block, adhesion, range);
    EXPECT_NEAR(contact_modulus_at(block, 1.0 / strip) * range * range / adhesion, strip,
                1e-4 * strip);
}

/// A sphere of 100 nm that is pressed onto a block; sections: keys of block and of the surface.
Case pressed(const std::string& block, const std::string& surface, double load,
             double adhesion = 0.0) {
    return read_case_text(
        fmt::format(
            "[surface]\nkind = \"flat\"\nradius = \"100 nm\"\n{}\n[block]\nyoung = \"1 "
            "GPa\"\npoisson = 0.3\n{}\n[interface]\nkind = \"wall\"\nadhesion = \"{} "
            "mJ/m^2\"\nrange = \"0.4 nm\"\nfrictionless = true\n[drive]\nmode = "
            "\"quasistatic\"\npath = [\"relax\"]\nload = \"{} nN\"\n[output]\nfields = []\n",
            surface, block, adhesion, load),
        "pressed.toml");
}

TEST(ContactEstimate, OfASphereIsNearItsContact) {
    const std::string free = "boundary = \"free\"\nsites = 40\nspacing = \"2 nm\"";
    struct {
        std::string block, surface;
        double load, adhesion;
    } const inputs[] = {
        {"", free, 50.0, 0.0},
        {"", free, 60.0, 20.0},
        {"layers = [[\"4 nm\", \"10 GPa\", 0.3]]", free, 50.0, 0.0},
        {"layers = [[\"20 nm\", \"10 GPa\", 0.3]]", free, 100.0, 0.0},
        {"layers = [[\"6 nm\", \"0.2 GPa\", 0.3]]", free, 20.0, 0.0},
        {"layers = [[\"40 nm\", \"0.1 GPa\", 0.4]]", free, 5.0, 0.0},
        {"layers = [[\"4 nm\", \"5 GPa\", 0.3], [\"10 nm\", \"0.2 GPa\", 0.4]]", free, 20.0, 0.0},
        {"surface_stress = \"5 N/m\"", free, 50.0, 0.0},
        {"surface_stress = \"100 N/m\"", free, 200.0, 0.0},
        {"layers = [[\"6 nm\", \"5 GPa\", 0.3]]", free, 60.0, 30.0},
        {"surface_stress = \"5 N/m\"", free, 60.0, 30.0},
        {"thickness = 6", "sites = 64\nspacing = \"2 nm\"", 100.0, 0.0},
    };
    for (const auto& in : inputs) {
        const Case c = pressed(in.block, in.surface, in.load, in.adhesion);
        const io::Scratch scratch;
        const io::Json result = test::run_scene(c, scratch / "run");
        const double found = 10.0 * test::number(result, "instrument.contact_radius");
        const SphereOnBlock sphere(c.simulation.block, *c.radius(),
                                   c.flat.work_of_adhesion / units::milli_per_unit);
        const double radius = sphere.contact_radius(in.load * units::nanonewton);
        EXPECT_NEAR(radius / found, 1.0, 0.3) << in.block << ", " << in.load << " nN: " << found;
        EXPECT_NEAR(sphere.load(radius) / units::nanonewton, in.load, 1e-3 * in.load);
    }
}

} // namespace
} // namespace asperity
