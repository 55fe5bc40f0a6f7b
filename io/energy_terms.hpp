// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The terms of the energy balance: one row for each form in which energy is stored, each work, and
// each way in which energy is lost.
//
// Records and results hold a number for each row (engine/energy/energies.hpp). The columns of the
// series, the names of result.json, the summary and the plots follow from the rows. A new loss is a
// row here, and the lines of the physics that add to it.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace asperity {

/// A term of the energy balance.
enum class Term : std::size_t {
    interface,
    spring,
    branches,
    elastic,
    kinetic,
    time_step,
    work,
    work_of_interface,
    in_block,
    in_surface,
    lost
};

namespace io {

/// Description of a term.
struct EnergyTerm {
    /// Side of the balance on which a term stands:
    /// sum of work = change of stored and numerical + sum of dissipated and lost.
    enum Kind {
        stored,        ///< form of energy
        numerical,     ///< energy of the time step
        part,          ///< part of another term
        work,          ///< work on the solids
        interior_work, ///< work between the parts of the system
        dissipated,    ///< energy that a memory of the solids dissipates in time
        lost           ///< energy damped, or dissipated at instabilities
    };

    Term term;
    Kind kind;
    std::string_view column; ///< name in the series
    std::string_view key;    ///< name of the term of a segment, an approach or a cycle; may be ""
    std::string_view last;   ///< name in the group "energy" of result.json; may be ""
    std::string_view effect; ///< name of the effect without which the term is zero; "": always on
    std::string_view meaning;
    std::string_view column_at_rest{}; ///< name in the series of a quasi-static path, if another

    constexpr bool is_loss() const { return kind == dissipated || kind == lost; }
    /// Returns true if the term adds up along a path, false for the energy of a state.
    constexpr bool is_flow() const { return is_loss() || kind == work || kind == interior_work; }
    /// Returns the word that stands for {loss} or {last} in a name of io/quantities.hpp; "": the
    /// term has no such name.
    constexpr std::string_view word(std::string_view pattern) const {
        if (pattern.find("{last}") != std::string_view::npos) return last;
        return is_loss() ? key : std::string_view();
    }
    /// Returns what became of the energy of a loss: "dissipated in the block", or "lost".
    std::string words() const {
        constexpr std::string_view in = "dissipated_in_";
        if (!key.starts_with(in)) return std::string(key);
        return "dissipated in the " + std::string(key.substr(in.size()));
    }
};

/// Returns the row of a loss of a memory, which has one name everywhere.
constexpr EnergyTerm dissipated(Term term, std::string_view key, std::string_view effect,
                                std::string_view meaning) {
    return {term, EnergyTerm::dissipated, key, key, key, effect, meaning};
}

/// All terms, in the order of Term.
inline constexpr auto energy_terms = std::to_array<EnergyTerm>({
    {Term::interface, EnergyTerm::stored, "interface_energy", "", "interface", "",
     "energy of the interface, of pairs or of the law of a wall"},
    {Term::spring, EnergyTerm::part, "spring_energy", "spring", "spring", "spring of the machine",
     "part of the elastic energy in the spring that holds the top plane (drive.stiffness)"},
    {Term::branches, EnergyTerm::part, "branch_energy", "", "branches", "viscoelastic block",
     "part of the elastic energy in the branches of a viscoelastic block"},
    {Term::elastic, EnergyTerm::stored, "elastic_energy", "", "elastic", "", "elastic energy"},
    {Term::kinetic, EnergyTerm::stored, "kinetic_energy", "kinetic", "kinetic", "dynamic",
     "kinetic energy; in equilibrium at a temperature T it is (3/2) N k T on average"},
    {Term::time_step, EnergyTerm::numerical, "time_step_energy", "", "time_step", "temperature",
     "energy of the time step at a temperature, -(dt²/8) Σ F²/m; the sum of the energies with this "
     "one is conserved"},
    {Term::work, EnergyTerm::work, "work", "work_of_drive", "work", "",
     "work of the drive on the solids, counted from rest apart; includes the energy of the solids "
     "at the start of the path"},
    {Term::work_of_interface, EnergyTerm::interior_work, "work_of_interface", "work_of_interface",
     "", "dynamic", "work of the interface's force on the mean height since the start, ∫ F dz"},
    dissipated(Term::in_block, "dissipated_in_block", "viscoelastic block",
               "energy dissipated by a viscoelastic block"),
    dissipated(Term::in_surface, "dissipated_in_surface", "yielding surface",
               "plastic work: hardness times the growth of the set (interface.hardness)"),
    {Term::lost, EnergyTerm::lost, "damped", "lost", "damped", "",
     "energy damped, less the heat of noise, or of a quasi-static path dissipated at "
     "instabilities: "
     "what steps gain less than their work",
     "dissipated"},
});

static_assert(
    [] {
        for (std::size_t i = 0; i < energy_terms.size(); ++i) {
            const EnergyTerm& row = energy_terms[i];
            const bool named = row.key.starts_with("dissipated_in_");
            if (row.term != Term(i) || (row.kind == EnergyTerm::dissipated) != named) return false;
        }
        return true;
    }(),
    "the rows stand in the order of Term, and dissipated_in_... names a loss of a memory");

} // namespace io
} // namespace asperity
