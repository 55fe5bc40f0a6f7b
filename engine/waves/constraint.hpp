// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The prescribed quantity along z of a block at rest; everything else moves until no force is left.
#pragma once

namespace asperity {

/// The prescribed quantity and its value.
struct Constraint {
    enum class Of {
        load,       ///< load of the free top plane, eV/Å, pressing down
        top,        ///< displacement of the drive, Å: of the top plane, or of the far end of the
                    ///< spring that holds it (Response::top())
        mean_height ///< mean displacement of the lowest layer, Å; no force is on the top plane
    };
    Of of = Of::load;
    double value = 0.0;
    bool stretches = true; ///< a load stretches the block as a whole; otherwise it only lifts it

    static constexpr Constraint load(double force) { return {Of::load, force}; }
    /// Returns a load on the lowest layer as a whole, eV/Å, as a held mean height takes it: the
    /// block is not stretched.
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
