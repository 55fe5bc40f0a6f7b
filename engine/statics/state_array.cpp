// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/statics/state_array.hpp"

#include <fmt/format.h>

#include <utility>

namespace asperity {

void add_arrays(int level, const char* what, VectorField<double>& field, int planes,
                std::vector<StateArray>& list) {
    const auto add = [&](char component, Field<double>& values) {
        list.push_back(
            {fmt::format("/level{}/{}_{}", level, what, component), level, &values, planes});
    };
    add('x', field.x);
    add('y', field.y);
    add('z', field.z);
}

std::vector<StateArray> state_of(SpectralBlock& block) {
    std::vector<StateArray> list;
    add_arrays(0, "u", block.layer(), 1, list);
    return list;
}

void StateCopy::take(const std::vector<StateArray>& arrays) {
    if (copies_.empty())
        for (const StateArray& array : arrays) {
            const auto shape = std::as_const(*array.field).view();
            Tile tile{};
            tile.nx = shape.nx;
            tile.ny = shape.ny;
            copies_.emplace_back(tile, shape.nz, array.field->halo());
        }
    for (std::size_t i = 0; i < arrays.size(); ++i)
        copies_[i].copy_from(*arrays[i].field);
}

void StateCopy::restore(const std::vector<StateArray>& arrays) const {
    for (std::size_t i = 0; i < arrays.size(); ++i)
        arrays[i].field->copy_from(copies_[i]);
}

std::vector<StateArray> StateCopy::arrays(const std::vector<StateArray>& like) {
    std::vector<StateArray> list = like;
    for (std::size_t i = 0; i < list.size(); ++i)
        list[i].field = &copies_[i];
    return list;
}

} // namespace asperity
