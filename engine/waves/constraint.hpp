// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The quantity along z that is prescribed for a block at rest; all other degrees of freedom relax.
#pragma once

namespace asperity {

/// The prescribed quantity and its value.
struct Constraint {
    /// Kind of the quantity.
    enum class Of {
        load,       ///< load of the free top plane, eV/Å, pressing down
        top,        ///< displacement of the drive, Å: the top plane, or the far end of its
                    ///< spring (Response::drive())
        mean_height ///< mean displacement of the lowest layer, Å; no force is on the top plane
    };
    Of of = Of::load;
    double value = 0.0;
    bool stretches = true; ///< false: a load acts on the lowest layer, not on the top plane

    static constexpr Constraint load(double force) { return {Of::load, force}; }
    /// Returns a load on the lowest layer as a whole, eV/Å, which replaces the force that holds a
    /// mean height: the block is not stretched.
    static constexpr Constraint load_without_stretch(double force) {
        return {Of::load, force, false};
    }
    static constexpr Constraint top(double z) { return {Of::top, z}; }
    static constexpr Constraint mean_height(double z) { return {Of::mean_height, z}; }
    bool is_top() const { return of == Of::top; }
    bool is_mean_height() const { return of == Of::mean_height; }
    /// Returns the load on the top plane, eV/Å; zero if something else is prescribed.
    double load() const { return of == Of::load ? value : 0.0; }
};

} // namespace asperity
