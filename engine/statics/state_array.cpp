// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/statics/state_array.hpp"

#include <fmt/format.h>

namespace asperity {

namespace {

void add_components(int level, const char* what, auto& field, int planes, auto& list) {
    const auto add = [&](char component, auto& values) {
        list.push_back(
            {fmt::format("/level{}/{}_{}", level, what, component), level, &values, planes});
    };
    add('x', field.x);
    add('y', field.y);
    add('z', field.z);
}

} // namespace

void add_arrays(int level, const char* what, const VectorField<double>& field, int planes,
                std::vector<StateArray>& list) {
    add_components(level, what, field, planes, list);
}

void add_arrays(int level, const char* what, VectorField<double>& field, int planes,
                std::vector<RestoredArray>& list) {
    add_components(level, what, field, planes, list);
}

std::vector<StateArray> state_of(const SpectralBlock& block) {
    std::vector<StateArray> list;
    add_arrays(0, "u", block.layer(), 1, list);
    return list;
}

std::vector<RestoredArray> state_to_restore(SpectralBlock& block) {
    std::vector<RestoredArray> list;
    add_arrays(0, "u", block.layer(), 1, list);
    return list;
}

void StateCopy::take(const std::vector<StateArray>& arrays) {
    if (copies_.empty())
        for (const StateArray& array : arrays) {
            const auto shape = array.field->view();
            Tile tile{};
            tile.nx = shape.nx;
            tile.ny = shape.ny;
            copies_.emplace_back(tile, shape.nz, array.field->halo());
        }
    for (std::size_t i = 0; i < arrays.size(); ++i)
        copies_[i].copy_from(*arrays[i].field);
}

void StateCopy::restore(const std::vector<RestoredArray>& arrays) const {
    for (std::size_t i = 0; i < arrays.size(); ++i)
        arrays[i].field->copy_from(copies_[i]);
}

std::vector<StateArray> StateCopy::arrays(const std::vector<StateArray>& like) const {
    std::vector<StateArray> list = like;
    for (std::size_t i = 0; i < list.size(); ++i)
        list[i].field = &copies_[i];
    return list;
}

std::vector<RestoredArray> StateCopy::arrays_to_restore(const std::vector<StateArray>& like) {
    std::vector<RestoredArray> list;
    for (std::size_t i = 0; i < like.size(); ++i)
        list.push_back({like[i].name, like[i].level, &copies_[i], like[i].planes});
    return list;
}

} // namespace asperity
