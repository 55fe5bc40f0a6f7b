// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/device/device_block.hpp"

#include "io/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace asperity {

namespace {

/// Regions of the device's memory begin at multiples of this.
constexpr std::size_t granule = 256;
std::size_t rounded(std::size_t bytes) { return (bytes + granule - 1) / granule * granule; }

const DeviceFunctions& functions_of(const DeviceChoice& choice) {
    if (choice.kind == DeviceChoice::Kind::emulated) return emulated_device();
    if (const DeviceFunctions* cuda = cuda_device()) return *cuda;
    throw io::FileError("numerics.device", "asks for a CUDA device",
                        "this program was built without CUDA",
                        "build it where nvcc is found, or take numerics.device = \"emulated\" or "
                        "\"none\"");
}

/// The device of this rank: those of a machine take devices in turn, from the one asked for.
DeviceChoice own_device(DeviceChoice choice, const Communicator& ranks) {
    const int devices = choice.kind == DeviceChoice::Kind::cuda ? cuda_device_count() : 0;
    if (choice.index < devices) choice.index = (choice.index + ranks.local_rank()) % devices;
    return choice;
}

template <class T>
std::size_t vector_bytes(const Tile& tile, int planes) {
    return 3 * rounded(Field<T>::bytes_for(tile, planes));
}

/// Doubles that one side's message of an axis carries.
NodeRanges strip_of(const Block& block, bool along_x) {
    NodeRanges strip;
    const ProcessGrid& grid = block.grid();
    const bool traded = along_x ? grid.px() > 1 : grid.py() > 1;
    for (const Block::Level& level : block.levels()) {
        const long long across = along_x ? level.tile.ny : level.tile.nx + 2 * halo_width;
        const long long here =
            level.tiled && traded ? 3ll * halo_width * across * level.shape.cells : 0;
        strip.first[strip.levels + 1] = strip.first[strip.levels] + here;
        ++strip.levels;
    }
    return strip;
}
std::size_t longest_strip(const ProcessGrid& grid, const std::vector<LevelShape>& shapes) {
    long long x = 0, y = 0;
    for (const LevelShape& shape : shapes) {
        const Tile tile = grid.tile(shape.level);
        if (!grid.tiled(shape.level)) continue;
        if (grid.px() > 1) x += 3ll * halo_width * tile.ny * shape.cells;
        if (grid.py() > 1) y += 3ll * halo_width * (tile.nx + 2 * halo_width) * shape.cells;
    }
    return static_cast<std::size_t>(std::max(x, y));
}

} // namespace

std::string describe_device(const DeviceChoice& choice) {
    if (choice.kind == DeviceChoice::Kind::none) return "none";
    if (choice.kind == DeviceChoice::Kind::emulated) return "emulated";
    std::string name = "CUDA";
    std::size_t free_bytes = 0;
    if (const DeviceFunctions* cuda = cuda_device()) cuda->describe(choice.index, name, free_bytes);
    return fmt::format("{} (device {})", name, choice.index);
}

void DeviceBlock::check(const char* error, const char* doing) const {
    if (!error) return;
    throw io::FileError(
        "numerics.device", fmt::format("= {}: {} failed", describe_device(choice_), doing), error,
        fmt::format("the step needs {:.0f} MB of device memory (asperity plan); resume from the "
                    "last checkpoint, on the processor with numerics.device = \"none\" if the "
                    "device stays out of order",
                    static_cast<double>(bytes_) / 1e6));
}

template <class T>
T* DeviceBlock::place(std::size_t count) {
    auto* at = reinterpret_cast<T*>(memory_ + used_);
    used_ += rounded(count * sizeof(T));
    if (used_ > bytes_)
        throw std::logic_error("DeviceBlock: more memory is used than bytes_for() counts");
    return at;
}
/// A region for a field of this shape, and the view of it.
template <class T>
VolumeView<T> DeviceBlock::place(const Field<T>& shape) {
    const auto host = shape.view();
    const std::ptrdiff_t offset = host.origin - shape.storage().data();
    return {
        place<T>(shape.storage().size()) + offset, host.row, host.plane, host.nx, host.ny, host.nz};
}
template <class T>
VectorVolume<T> DeviceBlock::place(const VectorField<T>& shape) {
    return {place(shape.x), place(shape.y), place(shape.z)};
}

std::size_t DeviceBlock::bytes_for(const BlockOptions& block, const ProcessGrid& grid,
                                   const InterfaceOptions& interface) {
    const auto shapes = level_shapes(block);
    std::size_t bytes = 0;
    for (const LevelShape& shape : shapes) {
        const Tile tile = grid.tile(shape.level);
        bytes += 2 * vector_bytes<double>(tile, shape.cells + 1) +
                 vector_bytes<double>(tile, shape.cells) + 2 * vector_bytes<double>(tile, 1);
    }
    bytes += rounded(shapes.size() * sizeof(DeviceLevel)) +
             rounded(shapes.size() * sizeof(LevelKicks)) + rounded(2 * sizeof(PassSums));
    bytes += 2 * rounded(longest_strip(grid, shapes) * sizeof(double));
    const Interface::TableSizes sizes =
        Interface::lattice_tables_for(interface, grid.tile(0), block.spacing);
    for (std::size_t size :
         {sizes.heights, sizes.mean_height, sizes.reach, sizes.reach, sizes.columns, sizes.map})
        bytes += rounded(size);
    return bytes;
}

DeviceBlock::DeviceBlock(const DeviceChoice& choice, const Block& block, const Interface& interface)
    : choice_(own_device(choice, block.communicator())), device_(functions_of(choice)),
      bytes_(bytes_for(block.options(), block.grid(), interface.options())) {
    check(device_.allocate(choice_.index, bytes_, &memory_), "the allocation of its memory");
    const auto upload = [&](auto* to, const auto* from, std::size_t count) {
        check(device_.upload(to, from, count * sizeof *from), "a copy to it");
    };
    const auto copy_of = [&](const auto& values) { // of a span, on the device
        using T = std::remove_cvref_t<decltype(values[0])>;
        T* to = place<T>(values.size());
        upload(to, values.data(), values.size());
        return to;
    };

    std::vector<DeviceLevel> levels;
    const auto& host = block.levels();
    step_.finite = block.options().finite_strain;
    const auto count = [](NodeRanges& ranges, long long nodes) {
        ranges.first[ranges.levels + 1] = ranges.first[ranges.levels] + nodes;
        ++ranges.levels;
    };
    for (std::size_t l = 0; l < host.size(); ++l) {
        const Block::Level& from = host[l];
        LevelMemory memory = {{place(from.u), place(from.u)},
                              place(from.v),
                              place(from.incoming)[0],
                              place(from.upper_force)[0]};
        const bool coarser = l + 1 < host.size();
        DeviceLevel level;
        level.nx = from.tile.nx;
        level.ny = from.tile.ny;
        level.cells = from.shape.cells;
        level.number = from.shape.level;
        level.x0 = from.tile.x0;
        level.y0 = from.tile.y0;
        level.u[0] = memory.u[0];
        level.u[1] = memory.u[1];
        level.v = memory.v;
        level.incoming = memory.incoming;
        level.upper_force = memory.upper_force;
        level.lower = from.lower;
        level.inner = from.inner;
        level.upper = from.upper;
        level.cell = from.cell(block.options().spacing);
        if (coarser) {
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
        levels.push_back(level);
        levels_.push_back(memory);
        const auto frame = [&](int h) {
            return static_cast<long long>(level.nx + 2 * h) * (level.ny + 2 * h);
        };
        count(step_.moving, from.nodes());
        count(step_.faces, frame(1));
        count(step_.hanging, frame(halo_width));
    }
    step_.levels = copy_of(levels);
    kicks_ = place<LevelKicks>(levels.size());
    step_.kicks = kicks_;
    step_.sums = place<PassSums>(2);

    // The interface's tables.
    const Interface::LatticeTables tables = interface.lattice_tables();
    step_.substrate = tables.substrate;
    if (tables.fixed) {
        const auto view = place(*tables.fixed);
        upload(view.origin - (tables.fixed->view().origin - tables.fixed->storage().data()),
               tables.fixed->storage().data(), tables.fixed->storage().size());
        step_.substrate.heights.fixed = view[0];
        step_.mixed = true;
    } else {
        const auto view = place(*tables.heights);
        upload(view.origin - (tables.heights->view().origin - tables.heights->storage().data()),
               tables.heights->storage().data(), tables.heights->storage().size());
        step_.substrate.heights.height = view[0];
    }
    step_.substrate.columns = copy_of(tables.columns);
    step_.substrate.reach.highest = copy_of(tables.highest);
    step_.substrate.reach.lowest = copy_of(tables.lowest);
    step_.substrate.map.height = copy_of(tables.map);
    step_.potential = interface.options().potential;
    if (tables.mean_height) {
        const Field<double>& mean = *tables.mean_height;
        const auto view = place(mean);
        upload(view.origin - (mean.view().origin - mean.storage().data()), mean.storage().data(),
               mean.storage().size());
        step_.mean_height = view[0];
        step_.tail = tables.tail;
        step_.with_tail = true;
    }
    const Tile& tile = interface.tile();
    step_.sites.force = levels_[0].incoming;
    step_.sites.spacing = block.options().spacing;
    step_.sites.x0 = tile.x0;
    step_.sites.y0 = tile.y0;

    halo_x_ = {true, strip_of(block, true), nullptr, nullptr, 0};
    halo_y_ = {false, strip_of(block, false), nullptr, nullptr, 0};
    const std::size_t strip = longest_strip(block.grid(), level_shapes(block.options()));
    halo_x_.before = halo_y_.before = place<double>(strip);
    halo_x_.after = halo_y_.after = place<double>(strip);
}

DeviceBlock::~DeviceBlock() {
    if (memory_) device_.release(memory_);
}

namespace {

/// Calls visit(device's view, host's field) for displacements and velocities of a level.
template <class Memory, class Fields, class Visit>
void each_component(const Memory& memory, const VectorVolume<double>& u, const Fields& host,
                    const Visit& visit) {
    visit(u.x, host.u.x), visit(u.y, host.u.y), visit(u.z, host.u.z);
    visit(memory.v.x, host.v.x), visit(memory.v.y, host.v.y), visit(memory.v.z, host.v.z);
}
/// Where the storage of a field of this shape begins on the device.
template <class T>
T* begin_of(const VolumeView<T>& device, const Field<T>& host) {
    return device.origin - (host.view().origin - host.storage().data());
}

} // namespace

void DeviceBlock::upload(const Block& block) {
    for (int buffer : {0, 1}) // the prescribed planes of both
        for (std::size_t l = 0; l < levels_.size(); ++l)
            each_component(
                levels_[l], levels_[l].u[buffer], block.levels()[l],
                [&](const VolumeView<double>& to, const Field<double>& from) {
                    check(device_.upload(begin_of(to, from), from.storage().data(), from.bytes()),
                          "a copy to it");
                });
}

void DeviceBlock::download(Block& block) const {
    for (std::size_t l = 0; l < levels_.size(); ++l)
        each_component(
            levels_[l], levels_[l].u[step_.now], block.fields(block.levels()[l]),
            [&](const VolumeView<double>& from, Field<double>& to) {
                check(device_.download(to.storage().data(), begin_of(from, to), to.bytes()),
                      "a copy from it");
            });
}

void DeviceBlock::begin(const Block& block, const StepParameters& step, double top,
                        double reference_height) {
    if (!kicks_known_ || !(step == kicked_with_)) {
        std::vector<LevelKicks> kicks;
        step_.damped = false;
        for (const Block::Level& level : block.levels()) {
            kicks.push_back(block.kicks(level, step));
            step_.damped |= kicks.back().damped_from < level.shape.cells;
        }
        check(device_.upload(kicks_, kicks.data(), kicks.size() * sizeof kicks[0]), "a copy to it");
        kicked_with_ = step;
        kicks_known_ = true;
    }
    step_.observe = step.observe;
    step_.dt = step.dt;
    step_.top = top;
    const VectorVolume<double>& u = levels_[0].u[step_.now];
    step_.sites.displacement = u[0];
    step_.sites.reference_height = reference_height;
}

void DeviceBlock::set_noise(const ThermalNoise& noise) {
    step_.noise = noise;
    step_.noisy = true;
}

void DeviceBlock::interpolate() { check(device_.follow(step_), "the launch of hanging planes"); }

void DeviceBlock::forces(const Block& block) {
    check(device_.forces(step_), "the launch of forces");
    if (shared_level_ >= 0) share_restricted_forces(block);
}

void DeviceBlock::advance() {
    check(device_.advance(step_), "the launch of the step");
    step_.now = 1 - step_.now;
}

DeviceSums DeviceBlock::sums() const {
    std::array<PassSums, 2> sums;
    check(device_.download(sums.data(), step_.sums, sizeof sums), "a step");
    const auto& [forces, moved] = sums;
    DeviceSums result;
    result.interface.force_z = forces.sum[ForceSum::interface_z];
    result.interface.energy = forces.sum[ForceSum::interface_energy];
    result.interface.in_contact = static_cast<std::int64_t>(forces.count[ForceSum::in_contact]);
    result.interface.repulsive = static_cast<std::int64_t>(forces.count[ForceSum::repulsive]);
    result.interface.closest_r2 = forces.least;
    result.lowest_z = forces.sum[ForceSum::lowest_z];
    result.top_force = forces.sum[ForceSum::top_z];
    result.kick.kinetic = moved.sum[AdvanceSum::kinetic];
    result.kick.dissipated = moved.sum[AdvanceSum::dissipated];
    result.kick.dragged = moved.sum[AdvanceSum::dragged];
    result.elastic = moved.sum[AdvanceSum::elastic];
    result.heat = moved.sum[AdvanceSum::heat];
    return result;
}

/// Into the level that every rank holds, from all tiles of the level below.
void DeviceBlock::share_restricted_forces(const Block& block) {
    const Block::Level& coarse = block.levels()[static_cast<std::size_t>(shared_level_)];
    const ProcessGrid& grid = block.grid();
    const Tile nodes = grid.footprint(coarse.shape.level, grid.rank());
    check(device_.restrict_to_shared(
              step_, shared_level_, {nodes.x0, nodes.x0 + nodes.nx, nodes.y0, nodes.y0 + nodes.ny}),
          "the launch of a restriction");
    const VectorPlane<double>& incoming = levels_[static_cast<std::size_t>(shared_level_)].incoming;
    const auto each = [&](const auto& copy) {
        for (auto [device, host] : {std::pair{&incoming.x, &shared_.x},
                                    {&incoming.y, &shared_.y},
                                    {&incoming.z, &shared_.z}})
            copy(device->origin - (host->view().origin - host->storage().data()), *host);
    };
    each([&](double* from, Field<double>& to) {
        check(device_.download(to.storage().data(), from, to.bytes()), "a copy from it");
    });
    const auto in = shared_.plane(0);
    const std::array planes = {in.x, in.y, in.z};
    gather_footprints(block.communicator(), grid, coarse.shape.level, planes);
    each([&](double* to, Field<double>& from) {
        check(device_.upload(to, from.storage().data(), from.bytes()), "a copy to it");
    });
}

/// Along x, then along y, whose rows hold the halo just received.
void DeviceBlock::exchange(const Block& block) {
    halo_bytes_ = 0;
    trade(block, true);
    trade(block, false);
}

void DeviceBlock::trade(const Block& block, bool along_x) {
    DeviceHalo& halo = along_x ? halo_x_ : halo_y_;
    const auto size = static_cast<std::size_t>(halo.strip.first[halo.strip.levels]);
    if (size == 0) return;
    halo.buffer = step_.now;
    for (auto* message : {&to_before_, &to_after_, &from_before_, &from_after_})
        message->resize(size);
    const std::size_t bytes = size * sizeof(double);
    check(device_.pack(step_, halo), "the launch that packs halos");
    check(device_.download(to_before_.data(), halo.before, bytes), "a copy from it");
    check(device_.download(to_after_.data(), halo.after, bytes), "a copy from it");
    const ProcessGrid& grid = block.grid();
    const int before = along_x ? grid.neighbour(-1, 0) : grid.neighbour(0, -1);
    const int after = along_x ? grid.neighbour(1, 0) : grid.neighbour(0, 1);
    const Message messages[] = {{before, after, 0, to_before_, from_after_},
                                {after, before, 1, to_after_, from_before_}};
    block.communicator().exchange(messages);
    check(device_.upload(halo.before, from_before_.data(), bytes), "a copy to it");
    check(device_.upload(halo.after, from_after_.data(), bytes), "a copy to it");
    check(device_.unpack(step_, halo), "the launch that unpacks halos");
    halo_bytes_ += 2 * bytes;
}

} // namespace asperity
