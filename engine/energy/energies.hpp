// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A number for each term of the energy balance (io/energy_terms.hpp), and the balance itself:
//
//     work = change of the stored energies + losses.
#pragma once

#include "io/energy_terms.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <string>

namespace asperity {

/// A value for each term.
template <class Value>
struct PerTerm {
    std::array<Value, io::energy_terms.size()> of_term{};

    Value& operator[](Term term) { return of_term[static_cast<std::size_t>(term)]; }
    const Value& operator[](Term term) const { return of_term[static_cast<std::size_t>(term)]; }

    template <class Visitor>
    void visit(Visitor& v) {
        for (const io::EnergyTerm& row : io::energy_terms)
            v(std::string(row.column), (*this)[row.term]);
    }
};

/// Energies stored, works and losses, eV: of a state and of the path to it, or of a step.
struct Energies : PerTerm<double> {
    using Kind = io::EnergyTerm::Kind;

    Energies& operator+=(const Energies& more) {
        for (std::size_t i = 0; i < of_term.size(); ++i)
            of_term[i] += more.of_term[i];
        return *this;
    }
    Energies& operator-=(const Energies& less) {
        for (std::size_t i = 0; i < of_term.size(); ++i)
            of_term[i] -= less.of_term[i];
        return *this;
    }
    /// Takes the works and losses of a path, and keeps the energies of the state.
    void take_flows(const Energies& of_path) {
        for (const io::EnergyTerm& row : io::energy_terms)
            if (row.is_flow()) (*this)[row.term] = of_path[row.term];
    }

    /// Returns the energy of interface and block, with that of the time step.
    double stored() const { return sum({Kind::stored, Kind::numerical}); }
    /// Returns the energy that memories of the solids have dissipated.
    double dissipated() const { return sum({Kind::dissipated}); }
    /// Returns all energy that was lost.
    double losses() const { return sum({Kind::dissipated, Kind::lost}); }
    /// Returns the elastic energy of the block without that of what holds it.
    double elastic_of_block() const { return (*this)[Term::elastic] - (*this)[Term::spring]; }
    /// Returns the largest magnitude of a stored energy.
    double largest_stored() const {
        double largest = 0.0;
        for (const io::EnergyTerm& row : io::energy_terms)
            if (row.kind == Kind::stored) largest = std::max(largest, std::abs((*this)[row.term]));
        return largest;
    }

private:
    double sum(std::initializer_list<Kind> kinds) const {
        double sum = 0.0;
        for (const io::EnergyTerm& row : io::energy_terms)
            if (std::find(kinds.begin(), kinds.end(), row.kind) != kinds.end())
                sum += (*this)[row.term];
        return sum;
    }
};

/// The energy balance of a path.
class Balance {
public:
    /// Begins the path. stored: energy that no counted work has brought, eV.
    void begin(double stored) { stored_at_start_ = stored; }
    /// Returns the residual of the balance over the largest energy or work so far, or over `least`,
    /// eV, if that is larger.
    double residual(const Energies& now, double least = 0.0) {
        largest_ = std::max({largest_, now.largest_stored(), std::abs(now[Term::work])});
        const double scale = std::max(largest_, least);
        const double residual = now[Term::work] - (now.stored() - stored_at_start_) - now.losses();
        return scale > 0.0 ? residual / scale : 0.0;
    }

    /// Passes the numbers to a visitor, for checkpoints.
    template <class Visitor>
    void visit(Visitor& v) {
        v("stored_at_start", stored_at_start_);
        v("largest", largest_);
    }

private:
    double stored_at_start_ = 0.0;
    double largest_ = 0.0; ///< eV
};

} // namespace asperity
