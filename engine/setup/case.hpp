// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The case: what a scene means, complete, in the engine's units (Å, eV, fs). Runs, plans and
// theories take a case; none of them looks at a key to find out what is wrong with it or what
// follows from it.
//
// resolve() is the only way from a scene to a case. It parses lists (resolve.cpp,
// pair_potentials.cpp), looks for contradictions between keys (checks.cpp), switches effects on
// (effects.cpp) and derives options and limits, before anything is allocated.
//
//     const Case c = read_case("scene.toml", {"surface.rms=2"}, ranks);
//     c.require_runnable();
#pragma once

#include "engine/dynamics/simulation.hpp"
#include "engine/interface/flat_reference.hpp"
#include "engine/interface/scales.hpp"
#include "engine/scene/scene.hpp"
#include "engine/scene/segment.hpp"
#include "engine/scene/surface.hpp"
#include "engine/setup/effects.hpp"

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace asperity {

/// When maps are written (output.fields).
struct MapTimes {
    bool relaxed = false, pull_off = false;
    bool segments = false;          ///< at the end of each segment of the path
    std::optional<long long> every; ///< steps, or points of a quasi-static path
    /// Delay after the end of the approach, ps, and name; in the order of the delays.
    std::vector<std::pair<double, std::string>> after_approach;
};

struct Case {
    Scene scene;         ///< that it was made of
    int ranks = 1;       ///< that it is for
    bool in_time = true; ///< a dynamic path; else equilibria only
    std::string file;    ///< of the map or the atoms, where it was found; empty: the scene has none
    std::vector<Segment> path; ///< its segments; never empty where the scene is right
    MapTimes maps;
    std::vector<std::string> types;            ///< of atoms: rows of simulation.interface.by_type
    std::vector<std::string> table_files;      ///< of simulation.interface.tables
    std::optional<std::uint32_t> table_digest; ///< of the numbers in them
    Effects effects; ///< that the scene calls for; what follows is built from it
    SimulationOptions simulation;
    std::vector<LevelShape> levels;
    FlatReference flat; ///< flat on flat, same cutoff and lattices
    /// The stiffness is a bound, as below.
    Scales scales;
    std::string force_scale; ///< what scales.force is, in words
    double tolerance = 0.0;  ///< drive.tolerance of it, eV/Å
    /// Bounds: of flat on flat, and of flat layers of each type of atoms.
    double largest_tension = 0.0; ///< GPa
    /// Factor by which rows of sites that hold the edge of a contact make a sphere's pull-off force
    /// too large; 1 where the spacing resolves what attracts beside the edge.
    double edge_pinning = 1.0;
    double longest_step = HUGE_VAL; ///< of a quasi-static path, Å: half the potential's width
    double longest_timestep = 0.0;  ///< stability limit 2/omega_max at the bottom of the well, fs;
                                    ///< usable_timestep() of it is used
    std::vector<std::string> notes; ///< worth knowing, not wrong
    /// What a run would refuse; theory and surface can do with the case.
    std::vector<io::Problem> refused;

    /// Paths of the files that were read: the scene, the map or the atoms, tables.
    std::vector<std::string> inputs() const;
    bool has(Segment::Kind kind) const;
    /// The path does more than to approach and to pull off.
    bool guided() const;
    bool starts_with(Segment::Kind kind) const { return !path.empty() && path[0].kind == kind; }
    /// Area of the interface, Å^2.
    double area() const { return scene.edge() * scene.edge(); }
    /// Of all sites.
    double fraction(long long sites) const {
        const double across = scene.surface.sites;
        return static_cast<double>(sites) / (across * across);
    }
    /// Atoms of a substrate of one layer along the edge of the box.
    int substrate() const {
        return substrate_sites(scene.surface.sites, scene.surface.lattice_ratio);
    }
    /// How the box is cut: slabs of rows on quasi-static paths, tiles on dynamic ones. Throws
    /// std::invalid_argument if it cannot be.
    ProcessGrid grid(int rank) const;
    /// Throws io::SceneError with all that a run would refuse.
    void require_runnable() const;
};

/// What is wrong is added to the list; the case is complete only if the list is empty. Problems of
/// keys that the list complains about already are left out.
Case resolve(const Scene& scene, int ranks, io::Problems& problems);
/// Throws io::SceneError with all that is wrong.
Case resolve(const Scene& scene, int ranks = 1);

/// Reads and resolves; throws io::SceneError with all that is wrong.
Case read_case(const std::string& file, const std::vector<std::string>& overrides = {},
               int ranks = 1);
/// The same from a text in memory; file is the name shown in messages.
Case read_case_text(const std::string& text, const std::string& file,
                    const std::vector<std::string>& overrides = {}, int ranks = 1);

/// The substrate. Collective: the root of `world` reads the map. Throws io::SceneError (options,
/// what is in the file) or io::FileError.
Surface surface_of(const Case& c, const Communicator& world = Communicator());

/// Everything that a run would refuse, found without running: require_runnable(), and what is in
/// the file of a surface. Returns the notes of the case and of such a surface. Collective.
std::vector<std::string> examine(const Case& c, const Communicator& world = Communicator());

/// Of a stability limit of flat contacts: pressed sites vibrate faster.
double usable_timestep(double limit);
/// Notes on a surface that is too steep or too high for its box, one sentence each.
std::vector<std::string> notes_on_roughness(double rms, double slope, double edge);

} // namespace asperity
