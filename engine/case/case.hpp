// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The case: a checked scene with all derived numbers, in the engine's units (Å, eV, fs). Runs,
// plans and theories take a case; none of them checks keys or derives numbers from keys.
//
// resolve() is the only way from a scene to a case. It parses lists (resolve.cpp,
// pair_potentials.cpp), looks for contradictions between keys (checks.cpp), switches effects on
// (effects.cpp) and derives options and limits, before anything is allocated.
//
//     const Case c = read_case("scene.toml", {"surface.rms=2"}, ranks);
//     c.require_runnable();
#pragma once

#include "decomposition/communicator.hpp"
#include "decomposition/process_grid.hpp"
#include "engine/case/effects.hpp"
#include "engine/case/flat_reference.hpp"
#include "engine/options/output_options.hpp"
#include "engine/options/scales.hpp"
#include "engine/options/segment.hpp"
#include "engine/options/simulation_options.hpp"
#include "engine/options/theory_options.hpp"
#include "engine/scene/scene.hpp"
#include "engine/scene/surface.hpp"

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace asperity {

/// A scene, checked and complete.
struct Case {
    Scene scene;              ///< scene of the case
    int ranks = 1;            ///< number of ranks of the case
    std::string file;         ///< path of the file of the map or atoms; empty: none
    SurfaceOptions surface;   ///< options of the substrate; a map with rms = 0 keeps its own
    std::string counter_file; ///< path of the file of the map of a second solid; empty: none
    OutputOptions output;
    MapTimes maps;
    TheoryOptions theory;
    std::vector<std::string> types;       ///< types of atoms: rows of simulation.interface.by_type
    std::vector<std::string> table_files; ///< files of simulation.interface.tables
    std::optional<std::uint32_t> table_digest; ///< digest of the numbers in table_files
    /// Bound of the error of energies of flat surfaces from the splines and the noise of the
    /// tables, divided by the work of adhesion.
    std::optional<double> table_error;
    Effects effects; ///< effects of the scene, which decide the options below
    SimulationOptions simulation;
    std::vector<LevelShape> levels; ///< levels of the block
    FlatReference flat;             ///< flat on flat with the same interface and lattices
    /// Scales of the scene; the stiffness is an upper bound, like largest_tension.
    Scales scales;
    std::string force_scale; ///< description of scales.force
    double tolerance = 0.0;  ///< drive.tolerance times scales.force, eV/Å
    /// Largest tension of flat surfaces, over all types of atoms, GPa.
    double largest_tension = 0.0;
    /// Factor by which rows of sites that hold the edge of a contact make a sphere's pull-off force
    /// too large; 1 if the spacing resolves the attraction beside the edge.
    double edge_pinning = 1.0;
    /// Longest step of a quasi-static path, Å: half the potential's width; infinite if the solids
    /// do not attract each other.
    double longest_step = HUGE_VAL;
    /// Stability limit of the time step at the bottom of the well, 2/omega_max, fs
    /// (usable_timestep()).
    double longest_timestep = 0.0;
    /// Factor by which a wall's attraction falls faster than the longest wave of the box is stiff:
    /// flat surfaces at a prescribed mean height jump if it is above 1. 0 over atoms.
    double softness = 0.0;
    std::vector<std::string> notes; ///< notes to the user that are no mistakes, one sentence each
    /// Problems that prevent a run; `theory` and `surface` can use the case.
    std::vector<io::Problem> refused;

    /// Returns the segments of the path; never empty in a valid scene.
    const std::vector<Segment>& path() const { return simulation.drive.path; }
    /// Returns the paths of all files that were read: scene, map or atoms, tables, branches, maps
    /// of the sites.
    std::vector<std::string> inputs() const;
    /// Returns the digests of the numbers in tables and in maps of the sites, by the keys that name
    /// them: "interface.table", "interface.adhesion".
    std::vector<std::pair<std::string, std::uint32_t>> digests() const;
    /// Returns true if the path has a segment of this kind.
    bool has(Segment::Kind kind) const;
    /// Returns true if the path has approaches, pull-offs and relaxations only.
    bool is_cycle() const;
    /// Returns true if the first segment is of this kind.
    bool starts_with(Segment::Kind kind) const { return !path().empty() && path()[0].kind == kind; }
    /// Returns the area of the interface, Å^2.
    double area() const { return edge() * edge(); }
    /// Returns the edge of the box, Å.
    double edge() const { return simulation.block.edge(); }
    /// Returns the number of sites, N^2.
    double sites() const {
        const double across = simulation.block.sites;
        return across * across;
    }
    /// Returns drive.load, MPa.
    double load_in_megapascal() const;
    /// Returns the radius of the spherical cap, Å; empty if the substrate is not curved.
    std::optional<double> radius() const {
        return surface.radius > 0.0 ? std::optional(surface.radius) : std::nullopt;
    }
    /// Returns true if forces are reported in nN and lengths in nm: where the contact is bounded.
    bool in_newtons() const { return effects.bounded_contact(); }
    /// Returns the size of the box as text: "64 x 64 sites, 166.4 Å wide".
    std::string box_in_words() const;
    /// Returns the size of the block as text: "64 layers (166.4 Å)".
    std::string block_in_words() const;
    /// Returns true if the block between interface and top plane is a spring that can jump.
    bool jumps_as_a_whole() const;
    /// Returns true if the sites are points of a mesh, not atoms: over a wall whose law has no
    /// atoms.
    bool has_mesh() const { return scene.interface.has_adhesion(); }
    /// Returns true if the works of the path are those of the box: flat surfaces jump in its
    /// longest waves.
    bool box_jumps() const;
    /// Returns the estimate of the energy that flat surfaces in this box lose in a cycle at a
    /// prescribed mean height, meV/Å^2; empty if the path prescribes the top plane.
    std::optional<double> flat_loss() const;
    /// Returns the largest attraction of smooth surfaces of this curvature, eV/Å.
    double smooth_pull_off() const;
    /// Returns a number of sites divided by the number of all sites.
    double fraction(long long some) const { return static_cast<double>(some) / sites(); }
    /// Returns the number of atoms of a substrate of one layer along the edge of the box.
    int substrate() const { return surface.sites; }
    /// Returns the cut of the box: slabs of rows on quasi-static paths, tiles on dynamic ones.
    /// Throws std::invalid_argument if the box cannot be cut for the ranks of the case.
    ProcessGrid grid(int rank) const;
    /// Throws io::SceneError with all problems that prevent a run, if there are any.
    void require_runnable() const;
};

/// Derives a case and adds the mistakes of the scene to problems; a key that has a problem already
/// gets no further one. The case is complete only if problems is empty. world: ranks among which
/// the fields of the sites are divided; the root reads their files. Collective.
Case resolve(const Scene& scene, int ranks, io::Problems& problems,
             const Communicator& world = Communicator());
/// Derives a case for a number of ranks. Throws io::SceneError with all mistakes.
Case resolve(const Scene& scene, int ranks = 1);

/// Reads a scene with overrides ("section.key=value") and derives its case. world: as for
/// resolve(). Throws io::SceneError with all mistakes.
Case read_case(const std::string& file, const std::vector<std::string>& overrides = {},
               int ranks = 1, const Communicator& world = Communicator());
/// Reads a scene from a text in memory and derives its case. file: name shown in messages. Throws
/// io::SceneError.
Case read_case_text(const std::string& text, const std::string& file,
                    const std::vector<std::string>& overrides = {}, int ranks = 1,
                    const Communicator& world = Communicator());

/// Makes the substrate, whose heights lie in bands on the ranks of `world`; the root reads the map.
/// Collective. Throws io::SceneError for
/// wrong options or contents of the file, io::FileError if the file cannot be read.
Surface surface_of(const Case& c, const Communicator& world = Communicator());

/// Returns the notes of a case and of its surface, one sentence each.
std::vector<std::string> notes_of(const Case& c, const Surface& surface);
/// Makes the checks of a run without running: require_runnable(), and the contents of the file of a
/// surface. Returns the notes of the case and of the surface. Collective. Throws io::SceneError.
std::vector<std::string> examine(const Case& c, const Communicator& world = Communicator());

/// Returns the largest recommended time step for a stability limit of flat contacts, fs; pressed
/// sites vibrate faster.
double usable_timestep(double limit);
/// Returns notes on a surface that is too steep or too high for its box, one sentence each. rms,
/// edge: Å; slope: rms slope.
std::vector<std::string> notes_on_roughness(double rms, double slope, double edge);

} // namespace asperity
