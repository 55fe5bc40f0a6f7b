// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The Fourier transform of a surface, one rank with threads or slabs of rows over the ranks.
//
// Transforms are FFTW's real ones: its threaded ones on one rank, its MPI ones on several. Plans
// are made by estimate, not by measurement, so that two runs do the same arithmetic. Between one
// and several ranks the order of the arithmetic differs: results agree to rounding.
#pragma once

#include "decomposition/field.hpp"
#include "decomposition/waves.hpp"

#include <memory>
#include <vector>

namespace asperity {

/// One field for each component of the waves, all of the slab's tile.
template <class T>
using SiteField = std::vector<Field<T>>;
template <class T>
SiteField<T> site_field(const Slab& slab, int components) {
    SiteField<T> field;
    for (int c = 0; c < components; ++c)
        field.emplace_back(slab.tile(), 1, 0);
    return field;
}

/// Between the sites of a surface and its waves; T is double or float. Both directions collective.
template <class T>
class SurfaceTransform {
public:
    SurfaceTransform(const Slab& slab, std::ptrdiff_t row); ///< row: of the fields
    ~SurfaceTransform();
    SurfaceTransform(SurfaceTransform&&) noexcept;
    SurfaceTransform& operator=(SurfaceTransform&&) noexcept;

    /// N^2 u_q of one component.
    void forward(const PlaneView<const T>& field, Waves<T>& waves, int component) const;
    /// The field of one component, whose waves are lost.
    void backward(Waves<T>& waves, int component, const PlaneView<T>& field) const;

private:
    struct Plans;
    std::unique_ptr<Plans> plans_;
};

} // namespace asperity
