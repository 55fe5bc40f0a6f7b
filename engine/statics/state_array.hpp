// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The arrays of a state, in a form in which any owner's arrays are copied and written to
// checkpoints.
#pragma once

#include "engine/energy/memory.hpp"
#include "engine/waves/spectral_block.hpp"

#include <vector>

namespace asperity {

/// Adds the components of a field of a level to a list, in the order x, y, z, named
/// "/level2/<what>_x".
void add_arrays(int level, const char* what, const VectorField<double>& field, int planes,
                std::vector<StateArray>& list);
void add_arrays(int level, const char* what, VectorField<double>& field, int planes,
                std::vector<RestoredArray>& list);

/// Returns the displacements of the lowest layer, which are the whole state of a block at rest,
/// without its memories.
std::vector<StateArray> state_of(const SpectralBlock& block);
/// Returns the displacements of the lowest layer to be overwritten; the caller then calls
/// apply_constraint().
std::vector<RestoredArray> state_to_restore(SpectralBlock& block);

/// A copy of the arrays of a state.
class StateCopy {
public:
    /// Copies the arrays.
    void take(const std::vector<StateArray>& arrays);
    /// Copies the values back, bit for bit, halos included.
    void restore(const std::vector<RestoredArray>& arrays) const;
    /// Returns the copies as a list like the copied one, to be written to a checkpoint.
    std::vector<StateArray> arrays(const std::vector<StateArray>& like) const;
    /// Returns the copies as a list to be read from a checkpoint; their halos are then not current.
    std::vector<RestoredArray> arrays_to_restore(const std::vector<StateArray>& like);
    bool empty() const { return copies_.empty(); }
    const Field<double>& operator[](std::size_t i) const { return copies_[i]; }

private:
    std::vector<Field<double>> copies_;
};

} // namespace asperity
