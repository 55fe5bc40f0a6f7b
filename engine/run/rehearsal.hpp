// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What a run of a case takes, in memory and time, rehearsed before it is begun: the objects of a
// run are made at two small sizes, steps and relaxations are carried out there, and what was
// allocated and how long it took is continued to the size of the case, by the nodes and sites that
// each part grows with. A case that is as small as a piece is rehearsed as it is.
//
// tests/engine/plan_test.cpp holds the memory against that of real runs.
#pragma once

#include "engine/setup/case.hpp"

#include <array>
#include <vector>

namespace asperity {

/// Of all levels together.
double nodes_of(const std::vector<LevelShape>& levels);

class Rehearsal {
public:
    enum class Kind {
        memory, ///< a few iterations, and no clock
        timed,  ///< states to their end, within some two seconds
    };
    /// On this rank alone. surface: of a case whose surface is read from a file, else not needed.
    Rehearsal(const Case& c, Kind kind, const Surface* surface = nullptr);

    /// Parts of a run. Snapshots: of the energy guard, or the points that a path goes
    /// back to. State: a relaxation. Maps: while one state's are written.
    enum class Part { surface, interface, block, snapshots, state, maps, count };
    static constexpr std::size_t parts = static_cast<std::size_t>(Part::count);

    /// Bytes that a part takes on one rank of the case, at most at once; zero where it has none.
    double bytes(Part part, int rank) const;
    /// The most held at once on this rank. Neither states nor maps are there at the same time.
    double most_bytes(int rank) const;

    // Seconds of this process with all its threads, for the whole case; zero where there is none.

    double making() const;    ///< surface, tables, block
    double far_step() const;  ///< a step of a block out of reach
    double near_step() const; ///< the same in contact
    double observing() const; ///< what a step takes more for a row of the series
    double iteration() const; ///< of a relaxation
    long long iterations() const { return large_.iterations; } ///< of the state at zero load
    bool state_ended() const { return large_.ended; }  ///< of the piece, before the time was up
    int sites() const { return large_.measure.sites; } ///< across the piece that was timed

private:
    struct Stage {
        double held = 0.0, peak = 0.0, seconds = 0.0;
    };
    /// What the parts of a piece, or of a rank, grow with.
    struct Measure {
        int sites = 0;          ///< across the box
        double atoms = 0.0;     ///< of the whole substrate
        double whole = 0.0;     ///< sites of the whole box
        double here = 0.0;      ///< sites of the rank
        double around = 0.0;    ///< the same with what the interface reaches beyond
        double nodes = 0.0;     ///< of the rank, with halos
        double own_nodes = 0.0; ///< of the whole block, without
    };
    struct Piece {
        Measure measure;
        std::array<Stage, parts> stages;
        double everywhere = 0.0; ///< bytes of the waves' stiffness, which each rank holds whole
        double far_step = 0.0, near_step = 0.0, observing = 0.0, iteration = 0.0;
        long long iterations = 0;
        bool ended = true;
    };

    static Measure measure(const Case& c, int rank, double atoms);
    static Piece rehearse(const Case& c, int sites, Kind kind, const Surface* of_file);
    static double fraction(Part part, const Measure& m, bool in_time);
    double over_nodes(double seconds) const;

    const Case& case_;
    double atoms_ = 0.0;
    Piece small_, large_;
};

/// Throws io::SceneError if a run of this case does not fit into the memory of its machines: the
/// ranks of each machine together are held against what is available there. Collective.
void require_memory(const Case& c, const Communicator& ranks);

} // namespace asperity
