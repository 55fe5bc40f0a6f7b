// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/interface/substrate_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace asperity {

namespace {

/// Longest edge of a cell, Å.
constexpr double longest_edge = 64.0;
/// Atoms that fill a cell stand this far below it, Å: a site that sums over the cell is within the
/// cutoff of its bounds, and so beyond the cutoff of these.
constexpr double filler_depth = 2.0 * largest_cell_cutoff + longest_edge;
/// Rounding in a bound must leave no atom out, Å.
constexpr double slack = 1e-3;

std::size_t blocks_of(const Tile& tile) {
    return static_cast<std::size_t>((tile.nx + interface_block - 1) / interface_block);
}

} // namespace

/// Halves of halves of the atoms. Heights are over the datum.
struct SubstrateCells::Tree {
    static constexpr std::int32_t none = -1;
    struct Node {
        double low[3], high[3];
        std::int32_t cell = none;               ///< cell of a leaf
        std::int32_t left = none, right = none; ///< branches of the other nodes
    };
    const AtomPositions& atoms;
    double datum;
    std::vector<std::int64_t> order;      ///< atoms, cell by cell
    std::vector<std::int64_t> cell_begin; ///< first place of each cell in `order`
    std::vector<Node> nodes;
    std::vector<std::int32_t> roots; ///< root of each type; none: the type has no atoms

    Tree(const AtomPositions& of, double over, std::size_t types)
        : atoms(of), datum(over), order(of.size()) {
        std::iota(order.begin(), order.end(), std::int64_t{0});
        std::vector<std::int64_t> count(types, 0);
        if (of.type.empty()) {
            count[0] = static_cast<std::int64_t>(order.size());
        } else {
            const auto type = [&](std::int64_t atom) {
                return static_cast<std::size_t>(of.type[static_cast<std::size_t>(atom)]);
            };
            for (const std::int64_t atom : order)
                ++count[type(atom)];
            std::stable_sort(order.begin(), order.end(),
                             [&](std::int64_t a, std::int64_t b) { return type(a) < type(b); });
        }
        std::int64_t first = 0;
        for (const std::int64_t atoms_of_type : count) {
            roots.push_back(atoms_of_type > 0 ? halve(first, first + atoms_of_type) : none);
            first += atoms_of_type;
        }
        cell_begin.push_back(first);
    }
    std::size_t cells() const { return cell_begin.size() - 1; }
    double at(int axis, std::int64_t atom) const {
        const auto i = static_cast<std::size_t>(atom);
        return axis == 0 ? atoms.x[i] : axis == 1 ? atoms.y[i] : atoms.z[i] - datum;
    }

    /// Returns the number of a box's cells left of its middle along the longest edge, if they are
    /// about as long as wide: whole slabs of cells, so that no long ones are left over.
    static std::int64_t left_cells(std::int64_t cells, double x, double y, double z) {
        double edge[3] = {x, y, z};
        std::sort(edge, edge + 3, std::greater<>());
        const auto count = static_cast<double>(cells);
        double cell = std::cbrt(edge[0] * edge[1] * edge[2] / count);
        if (cell > edge[2]) cell = std::sqrt(edge[0] * edge[1] / count);
        if (cell > edge[1]) cell = edge[0] / count;
        const double slabs = std::clamp(std::round(edge[0] / cell), 2.0, count);
        const auto left = std::llround(count * std::floor(0.5 * slabs) / slabs);
        return std::clamp<std::int64_t>(left, 1, cells - 1);
    }

    std::int32_t halve(std::int64_t first, std::int64_t last) {
        Node node{};
        int longest = 0;
        const auto extent = [&](int axis) { return node.high[axis] - node.low[axis]; };
        for (int k = 0; k < 3; ++k) {
            node.low[k] = std::numeric_limits<double>::max();
            node.high[k] = std::numeric_limits<double>::lowest();
            for (auto i = order.begin() + first; i != order.begin() + last; ++i) {
                node.low[k] = std::min(node.low[k], at(k, *i));
                node.high[k] = std::max(node.high[k], at(k, *i));
            }
            if (extent(k) > extent(longest)) longest = k;
        }
        const std::size_t here = nodes.size();
        nodes.push_back(node);
        if (last - first <= cell_atoms && extent(longest) <= longest_edge) {
            nodes[here].cell = static_cast<std::int32_t>(cell_begin.size());
            cell_begin.push_back(first);
            return static_cast<std::int32_t>(here);
        }
        const std::int64_t full = (last - first + cell_atoms - 1) / cell_atoms;
        const std::int64_t half =
            full > 1 ? left_cells(full, extent(0), extent(1), extent(2)) * cell_atoms
                     : std::max<std::int64_t>((last - first) / 2, 1);
        const auto middle = order.begin() + first + half;
        std::nth_element(order.begin() + first, middle, order.begin() + last,
                         [&](std::int64_t a, std::int64_t b) {
                             return std::pair(at(longest, a), a) < std::pair(at(longest, b), b);
                         });
        // The standard fixes no order of the two parts that nth_element leaves.
        std::sort(order.begin() + first, middle);
        std::sort(middle, order.begin() + last);
        const std::int32_t left = halve(first, first + half), right = halve(first + half, last);
        nodes[here].left = left;
        nodes[here].right = right;
        return static_cast<std::int32_t>(here);
    }
};

SubstrateCells::SubstrateCells(AtomPositions atoms, const Tile& tile, const CellOptions& options)
    : atoms_(std::move(atoms)), edge_(tile.sites * options.spacing),
      datum_(*std::max_element(atoms_.z.begin(), atoms_.z.end())), margin_(options.margin) {
    const auto types = static_cast<std::int32_t>(options.cutoffs.size());
    if (!(atoms_.type.empty() || atoms_.type.size() == atoms_.size()) ||
        std::any_of(atoms_.type.begin(), atoms_.type.end(),
                    [&](std::int32_t type) { return type < 0 || type >= types; }))
        throw std::invalid_argument(
            fmt::format("cells of substrate atoms: {} atoms have {} types, and {} have a cutoff",
                        atoms_.size(), atoms_.type.size(), types));
    const Tree tree(atoms_, datum_, options.cutoffs.size());
    fill(tree);
    list(tree, tile, options);
}

void SubstrateCells::fill(const Tree& tree) {
    const std::size_t cells = tree.cells(), slots = cells * cell_atoms;
    bounds_.resize(8 * cells);
    places_.resize(3 * slots);
    for (const Tree::Node& node : tree.nodes) {
        if (node.cell < 0) continue;
        const auto cell = static_cast<std::size_t>(node.cell);
        const std::int64_t begin = tree.cell_begin[cell];
        const std::int64_t atoms = tree.cell_begin[cell + 1] - begin;
        for (int k = 0; k < 3; ++k) {
            const auto axis = static_cast<std::size_t>(k);
            const double centre = 0.5 * (node.low[k] + node.high[k]);
            bounds_[8 * cell + axis] = centre;
            bounds_[8 * cell + 4 + axis] = 0.5 * (node.high[k] - node.low[k]);
            for (std::int64_t i = 0; i < cell_atoms; ++i) {
                const double value =
                    i < atoms ? tree.at(k, tree.order[static_cast<std::size_t>(begin + i)])
                              : node.low[k] - (k == 2 ? filler_depth : 0.0);
                const std::size_t slot =
                    (3 * cell + axis) * cell_atoms + static_cast<std::size_t>(i);
                places_[slot] = value;
            }
        }
    }
}

void SubstrateCells::list(const Tree& tree, const Tile& tile, const CellOptions& options) {
    const double a = options.spacing;
    blocks_ = static_cast<int>(blocks_of(tile));
    block_first_.push_back(0);
    std::vector<std::int32_t> open;
    for (int y = 0; y < tile.ny; ++y)
        for (int block = 0; block < blocks_; ++block) {
            const int last = std::min(tile.nx, (block + 1) * interface_block) - 1;
            const double left = (tile.x0 + block * interface_block + 0.5) * a;
            const double right = (tile.x0 + last + 0.5) * a;
            const double site_y = (tile.y0 + y + 0.5) * a;
            double highest = std::numeric_limits<double>::lowest();
            const auto list_type = [&](std::int32_t root, double widest) {
                const int images = static_cast<int>(std::ceil(widest / edge_)) + 1;
                for (int j = -images; j <= images; ++j)
                    for (int i = -images; i <= images; ++i) {
                        // Depth first, left before right: cells in ascending order.
                        open.assign(1, root);
                        while (!open.empty()) {
                            const Tree::Node& node =
                                tree.nodes[static_cast<std::size_t>(open.back())];
                            open.pop_back();
                            const double dx = std::max({node.low[0] + i * edge_ - right,
                                                        left - node.high[0] - i * edge_, 0.0});
                            const double dy = std::max({node.low[1] + j * edge_ - site_y,
                                                        site_y - node.high[1] - j * edge_, 0.0});
                            if (dx * dx + dy * dy >= widest * widest) continue;
                            if (node.cell < 0) {
                                open.push_back(node.right);
                                open.push_back(node.left);
                                continue;
                            }
                            images_.push_back({node.cell, static_cast<std::int16_t>(i),
                                               static_cast<std::int16_t>(j)});
                            highest = std::max(highest, node.high[2]);
                        }
                    }
            };
            for (std::size_t type = 0; type < tree.roots.size(); ++type) {
                if (tree.roots[type] >= 0)
                    list_type(tree.roots[type], options.cutoffs[type] + options.margin + slack);
                block_first_.push_back(static_cast<std::int64_t>(images_.size()));
            }
            block_highest_.push_back(options.skip ? highest : std::numeric_limits<double>::max());
        }
    images_.shrink_to_fit();
}

CellSubstrate SubstrateCells::view() const {
    CellSubstrate view;
    view.places = places_.data();
    view.bounds = bounds_.data();
    view.images = images_.data();
    view.first = block_first_.data();
    view.highest = block_highest_.data();
    view.blocks = blocks_;
    view.datum = datum_;
    view.offset_margin = margin_;
    view.atoms = atoms();
    return view;
}

SubstrateAtoms SubstrateCells::atoms() const {
    return {atoms_.x.data(),
            atoms_.y.data(),
            atoms_.z.data(),
            atoms_.type.empty() ? nullptr : atoms_.type.data(),
            static_cast<std::int64_t>(atoms_.size()),
            edge_};
}

std::size_t SubstrateCells::bytes() const {
    const auto size = [](const auto&... vectors) {
        return ((vectors.size() * sizeof(vectors[0])) + ...);
    };
    return size(atoms_.x, atoms_.y, atoms_.z, atoms_.type, places_, bounds_, block_highest_,
                images_, block_first_);
}

} // namespace asperity
