// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/device/device_block.hpp"

#include "io/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace asperity {

namespace {

const DeviceFunctions& functions_of(const DeviceChoice& choice) {
    if (choice.kind == DeviceChoice::Kind::emulated) return emulated_device();
    if (const DeviceFunctions* cuda = cuda_device()) return *cuda;
    throw std::invalid_argument("a CUDA device, and this program was built without CUDA");
}

/// Returns the device of this rank: ranks of a machine take its devices in turn, from the chosen
/// one.
DeviceChoice own_device(DeviceChoice choice, const Communicator& ranks) {
    const int devices = choice.kind == DeviceChoice::Kind::cuda ? cuda_device_count() : 0;
    if (devices > 0 && choice.index < devices)
        choice.index = (choice.index + ranks.local_rank()) % devices;
    return choice;
}

/// Returns the doubles in one side's message along an axis, level by level.
NodeRanges halo_strip(const ProcessGrid& grid, const std::vector<LevelShape>& shapes,
                      bool along_x) {
    NodeRanges strip;
    const bool exchanged = along_x ? grid.px() > 1 : grid.py() > 1;
    for (const LevelShape& shape : shapes) {
        const Tile tile = grid.tile(shape.level);
        const long long across = along_x ? tile.ny : tile.nx + 2 * halo_width;
        const bool here = exchanged && grid.tiled(shape.level);
        strip.add_level(here ? 3ll * halo_width * across * shape.cells : 0);
    }
    return strip;
}

template <class VectorField>
auto components(VectorField& field) {
    return std::array{&field.x, &field.y, &field.z};
}

} // namespace

std::string describe_device(const DeviceChoice& choice) {
    if (!choice) return "none";
    if (choice.kind == DeviceChoice::Kind::emulated) return "emulated";
    return fmt::format("{} (device {})", cuda_device_name(choice.index), choice.index);
}

DeviceLayout::DeviceLayout(const BlockOptions& block, const ProcessGrid& grid,
                           const InterfaceOptions& interface) {
    constexpr std::size_t granule = 256; // regions begin at multiples of this
    const auto place = [&](std::size_t size) {
        const Region region{bytes, size};
        bytes += (size + granule - 1) / granule * granule;
        return region;
    };
    const auto place_vector = [&](const Tile& tile, int planes) {
        const std::size_t size = Field<double>::bytes_for(tile, planes);
        return Vector{place(size), place(size), place(size)};
    };
    const std::vector<LevelShape> shapes = level_shapes(block);
    for (const LevelShape& shape : shapes) {
        const Tile tile = grid.tile(shape.level);
        Level level;
        for (Vector& u : level.u)
            u = place_vector(tile, shape.cells + 1);
        level.v = place_vector(tile, shape.cells);
        level.transferred = place_vector(tile, 1);
        level.upper_force = place_vector(tile, 1);
        levels.push_back(level);
    }
    level_table = place(shapes.size() * sizeof(DeviceLevel));
    kicks = place(shapes.size() * sizeof(LevelKicks));
    sums = place(2 * sizeof(PassSums));

    const Tile tile = grid.tile(0);
    const double cutoff = cutoff_of(interface.potential);
    heights = place(Field<double>::bytes_for(tile, 1, OverLattice::halo(cutoff, block.spacing)));
    highest = place(ReachTable::size(tile) * sizeof(double));
    lowest = place(ReachTable::size(tile) * sizeof(double));
    columns = place(OverLattice::Offsets(cutoff, block.spacing).table() * sizeof(std::int32_t));
    const RowRange under =
        HeightMap::rows_under(tile, block.spacing, block.sites, block.spacing, interface);
    map = place(static_cast<std::size_t>(under.count) * static_cast<std::size_t>(block.sites) *
                sizeof(double));
    if (interface.tail) mean_height = place(Field<double>::bytes_for(tile, 1));
    if (const auto* table = std::get_if<Tabulated>(&interface.potential))
        cubics = place(4 * static_cast<std::size_t>(table->intervals) * sizeof(double));

    const auto end = [&](bool along_x) {
        const NodeRanges strip = halo_strip(grid, shapes, along_x);
        return static_cast<std::size_t>(strip.first[strip.levels]);
    };
    for (Region* messages : {&sent, &received})
        *messages = place(2 * std::max(end(true), end(false)) * sizeof(double));
}

void DeviceBlock::check(const char* error, const char* doing) const {
    if (!error) return;
    throw io::FileError(
        "numerics.device", fmt::format("= {}: {} failed", describe_device(choice_), doing), error,
        fmt::format("the step needs {:.3g} MB of device memory (asperity plan); resume from the "
                    "last checkpoint, on the processor with numerics.device = \"none\" if the "
                    "device stays out of order",
                    static_cast<double>(layout_.bytes) / 1e6));
}
void DeviceBlock::copy(void* to, const void* from, std::size_t bytes) const {
    check(device_.copy(to, from, bytes), "a copy");
}

template <class T>
T* DeviceBlock::at(const DeviceLayout::Region& region) const {
    return reinterpret_cast<T*>(memory_.get() + region.begin);
}
template <class T>
T* DeviceBlock::copied(const DeviceLayout::Region& region, std::span<const T> values) const {
    static_assert(std::is_trivially_copyable_v<T> && std::is_standard_layout_v<T>);
    if (values.size_bytes() != region.bytes)
        throw std::logic_error("DeviceBlock: an array has another size than its place");
    copy(at<T>(region), values.data(), region.bytes);
    return at<T>(region);
}
void DeviceBlock::fetch(const DeviceLayout::Region& region, Field<double>& to) const {
    copy(to.storage().data(), at<double>(region), region.bytes);
}
/// Returns the view of a region for a field of the host's shape.
VolumeView<double> DeviceBlock::view(const DeviceLayout::Region& region,
                                     const Field<double>& host) const {
    if (host.bytes() != region.bytes)
        throw std::logic_error("DeviceBlock: a field has another size than its place");
    const VolumeView<const double> v = host.view();
    return {
        at<double>(region) + (v.origin - host.storage().data()), v.row, v.plane, v.nx, v.ny, v.nz};
}
VectorVolume<double> DeviceBlock::view(const DeviceLayout::Vector& regions,
                                       const VectorField<double>& host) const {
    return {view(regions[0], host.x), view(regions[1], host.y), view(regions[2], host.z)};
}

DeviceBlock::DeviceBlock(const DeviceChoice& choice, const Block& block, const Interface& interface)
    : choice_(own_device(choice, block.communicator())), device_(functions_of(choice)),
      layout_(block.options(), block.grid(), interface.options()) {
    if (block.options().finite_strain)
        throw std::invalid_argument("a device has no elastic forces of finite strain");
    std::byte* allocated = nullptr;
    check(device_.allocate(choice_.index, layout_.bytes, &allocated),
          "the allocation of its memory");
    memory_.reset(allocated);
    make_levels(block);
    copy_tables(interface);
    step_.kicks = at<LevelKicks>(layout_.kicks);
    step_.sums = at<PassSums>(layout_.sums);
    step_.sites.force = levels_[0].transferred;
    step_.sites.spacing = block.options().spacing;
    step_.sites.x0 = interface.tile().x0;
    step_.sites.y0 = interface.tile().y0;
    for (const bool along_x : {true, false}) {
        Strip& strip = strips_[along_x ? 0 : 1];
        const NodeRanges ranges = halo_strip(block.grid(), level_shapes(block.options()), along_x);
        strip.halo = {along_x, ranges, nullptr, 0};
        for (auto* messages : {&strip.sent, &strip.received})
            messages->resize(2 * static_cast<std::size_t>(ranges.first[ranges.levels]));
    }
}

void DeviceBlock::make_levels(const Block& block) {
    const auto& host = block.levels();
    for (std::size_t l = 0; l < host.size(); ++l) {
        const Block::Level& from = host[l];
        const DeviceLayout::Level& place = layout_.levels[l];
        DeviceLevel level;
        level.nx = from.tile.nx;
        level.ny = from.tile.ny;
        level.cells = from.shape.cells;
        level.number = from.shape.level;
        level.x0 = from.tile.x0;
        level.y0 = from.tile.y0;
        level.u[0] = view(place.u[0], from.u);
        level.u[1] = view(place.u[1], from.u);
        level.v = view(place.v, from.v);
        level.transferred = view(place.transferred, from.transferred)[0];
        level.upper_force = view(place.upper_force, from.upper_force)[0];
        level.lower = from.lower;
        level.inner = from.inner;
        level.upper = from.upper;
        level.cell = from.cell(block.options().spacing);
        if (l + 1 < host.size()) {
            const Tile& f = from.tile;
            const Tile& c = host[l + 1].tile;
            level.seam = {f.x0, f.y0, c.x0, c.y0};
        }
        const bool shared = l > 0 && host[l - 1].tiled && !from.tiled;
        if (shared) {
            shared_level_ = static_cast<int>(l);
            shared_ = VectorField<double>(from.tile, 1);
        }
        level.in_line = l > 0 && !shared;
        level.counted = block.counts(from);
        level.wraps_x = !from.tiled || block.grid().px() == 1;
        level.wraps_y = !from.tiled || block.grid().py() == 1;
        levels_.push_back(level);
        const auto frame = [&](int h) {
            return static_cast<long long>(level.nx + 2 * h) * (level.ny + 2 * h);
        };
        step_.moving.add_level(from.nodes());
        step_.faces.add_level(frame(1));
        step_.constrained.add_level(frame(halo_width));
    }
    step_.levels = copied(layout_.level_table, std::span<const DeviceLevel>(levels_));
}

void DeviceBlock::copy_tables(const Interface& interface) {
    const Interface::Tables tables = interface.tables();
    if (!tables.lattice)
        throw std::invalid_argument("a device sums over a substrate of the block's lattice only");
    const auto field = [&](const DeviceLayout::Region& region, const Field<double>& host) {
        copied(region, host.storage());
        return view(region, host)[0];
    };
    LatticeSubstrate& atoms = step_.lattice;
    atoms = tables.lattice->view();
    atoms.fixed = {};
    atoms.heights.height = field(layout_.heights, tables.lattice->heights().field());
    atoms.columns =
        copied(layout_.columns, std::span<const std::int32_t>(tables.lattice->columns()));
    const ReachTable& reach = tables.lattice->reach();
    atoms.reach.highest = copied(layout_.highest, std::span<const double>(reach.highest()));
    atoms.reach.lowest = copied(layout_.lowest, std::span<const double>(reach.lowest()));
    atoms.map.height = copied(layout_.map, tables.map);
    potential_ = interface.options().potential;
    if (auto* table = std::get_if<Tabulated>(&potential_))
        table->cubics =
            copied(layout_.cubics,
                   std::span(table->cubics, 4 * static_cast<std::size_t>(table->intervals)));
    step_.with_tail = tables.mean_height != nullptr;
    if (!step_.with_tail) return;
    step_.mean_height = field(layout_.mean_height, *tables.mean_height);
    step_.tail_density = tables.density;
}

void DeviceBlock::upload(const Block& block) {
    for (std::size_t l = 0; l < levels_.size(); ++l) {
        const Block::Level& host = block.levels()[l];
        const DeviceLayout::Level& place = layout_.levels[l];
        for (std::size_t c = 0; c < 3; ++c) {
            for (const DeviceLayout::Vector& u : place.u) // the prescribed planes of both
                copied(u[c], components(host.u)[c]->storage());
            copied(place.v[c], components(host.v)[c]->storage());
        }
    }
}

void DeviceBlock::download(Block& block) const {
    for (std::size_t l = 0; l < levels_.size(); ++l) {
        const Block::Fields host = block.fields(block.levels()[l]);
        const DeviceLayout::Level& place = layout_.levels[l];
        for (std::size_t c = 0; c < 3; ++c) {
            fetch(place.u[static_cast<std::size_t>(step_.now)][c], *components(host.u)[c]);
            fetch(place.v[c], *components(host.v)[c]);
        }
    }
}

void DeviceBlock::set_kicks(const Block& block, const StepParameters& step) {
    if (kicked_with_ == step) return;
    std::vector<LevelKicks> kicks;
    step_.damped = false;
    for (const Block::Level& level : block.levels()) {
        kicks.push_back(block.kicks(level, step));
        step_.damped |= kicks.back().damped_from < level.shape.cells;
    }
    copied(layout_.kicks, std::span<const LevelKicks>(kicks));
    kicked_with_ = step;
}

DeviceSums DeviceBlock::step(const Block& block, double reference_height,
                             const StepParameters& step, const std::optional<ThermalNoise>& noise) {
    set_kicks(block, step);
    step_.observe = step.observe;
    step_.dt = step.dt;
    step_.top = block.top();
    step_.noisy = noise.has_value();
    if (noise) step_.noise = *noise;
    step_.sites.displacement = VectorVolume<const double>(levels_[0].u[step_.now])[0];
    step_.sites.reference_height = reference_height;

    check(device_.interpolate(step_), "the launch of constrained planes");
    check(device_.forces(step_, potential_), "the launch of forces");
    if (shared_level_ >= 0) share_restricted_forces(block);
    check(device_.advance(step_), "the launch of the step");
    step_.now = 1 - step_.now;
    for (Strip& strip : strips_) // along x, then along y, whose rows hold the halo just received
        exchange(block, strip);

    std::array<PassSums, 2> sums;
    copy(sums.data(), step_.sums, sizeof sums);
    const PassSums &forces = sums[0], &moved = sums[1];
    DeviceSums result;
    result.interface.force_z = forces.sum[ForceSum::interface_z];
    result.interface.energy = forces.sum[ForceSum::interface_energy];
    result.interface.in_contact = static_cast<std::int64_t>(forces.count[ForceSum::in_contact]);
    result.interface.repulsive = static_cast<std::int64_t>(forces.count[ForceSum::repulsive]);
    result.interface.closest_r2 = forces.least;
    result.lowest_z = forces.sum[ForceSum::lowest_z];
    result.top_force = forces.sum[ForceSum::top_z];
    result.kick.kinetic = moved.sum[AdvanceSum::kinetic];
    result.kick.of_step = moved.sum[AdvanceSum::of_step];
    result.kick.dissipated = moved.sum[AdvanceSum::dissipated];
    result.kick.dragged = moved.sum[AdvanceSum::dragged];
    result.elastic = moved.sum[AdvanceSum::elastic];
    result.noise.heat = moved.sum[AdvanceSum::heat];
    return result;
}

/// Sums the forces of all tiles into the level that every rank holds, from the level below.
void DeviceBlock::share_restricted_forces(const Block& block) {
    const Block::Level& coarse = block.levels()[static_cast<std::size_t>(shared_level_)];
    const ProcessGrid& grid = block.grid();
    const Tile nodes = grid.footprint(coarse.shape.level, grid.rank());
    check(device_.restrict_to_shared(
              step_, shared_level_, {nodes.x0, nodes.x0 + nodes.nx, nodes.y0, nodes.y0 + nodes.ny}),
          "the launch of a restriction");
    const DeviceLayout::Vector& place =
        layout_.levels[static_cast<std::size_t>(shared_level_)].transferred;
    const auto host = components(shared_);
    for (std::size_t c = 0; c < 3; ++c)
        fetch(place[c], *host[c]);
    const VectorPlane<double> shared = shared_.plane(0);
    gather_footprints(block.communicator(), grid, coarse.shape.level,
                      std::array{shared.x, shared.y, shared.z});
    for (std::size_t c = 0; c < 3; ++c)
        copied(place[c], std::as_const(*host[c]).storage());
}

void DeviceBlock::exchange(const Block& block, Strip& strip) {
    const std::size_t size = strip.sent.size() / 2, bytes = strip.sent.size() * sizeof(double);
    if (size == 0) return;
    DeviceHalo& halo = strip.halo;
    halo.buffer = step_.now;
    halo.messages = at<double>(layout_.sent);
    check(device_.pack(step_, halo), "the launch that packs halos");
    copy(strip.sent.data(), halo.messages, bytes);
    const ProcessGrid& grid = block.grid();
    const int before = halo.along_x ? grid.neighbour(-1, 0) : grid.neighbour(0, -1);
    const int after = halo.along_x ? grid.neighbour(1, 0) : grid.neighbour(0, 1);
    const std::span sent(strip.sent), received(strip.received);
    const Message messages[] = {{before, after, 0, sent.first(size), received.last(size)},
                                {after, before, 1, sent.last(size), received.first(size)}};
    block.communicator().exchange(messages);
    halo.messages = at<double>(layout_.received);
    copy(halo.messages, strip.received.data(), bytes);
    check(device_.unpack(step_, halo), "the launch that unpacks halos");
}

} // namespace asperity
