// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/device/device_block.hpp"

#include "io/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <type_traits>
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

/// Where the storage of a field of this shape begins on the device.
template <class T>
T* begin_of(const VolumeView<T>& device, const Field<T>& host) {
    return device.origin - (host.view().origin - host.storage().data());
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
    auto* at = reinterpret_cast<T*>(memory_.get() + used_);
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
                                   const InterfaceOptions& interface, int substrate_sites) {
    const auto shapes = level_shapes(block);
    std::size_t bytes = 0;
    for (const LevelShape& shape : shapes) {
        const Tile tile = grid.tile(shape.level);
        bytes += 2 * vector_bytes<double>(tile, shape.cells + 1) +
                 vector_bytes<double>(tile, shape.cells) + 2 * vector_bytes<double>(tile, 1);
    }
    bytes += rounded(shapes.size() * sizeof(DeviceLevel)) +
             rounded(shapes.size() * sizeof(LevelKicks)) + rounded(4 * sizeof(PassSums));
    bytes += 4 * rounded(longest_strip(grid, shapes) * sizeof(double));
    const Interface::TableSizes sizes =
        Interface::tables_for(interface, grid.tile(0), block.spacing, substrate_sites);
    for (std::size_t size :
         {interface.mixed ? sizes.fixed : sizes.heights, sizes.mean_height, sizes.reach,
          sizes.reach, sizes.columns, sizes.map, sizes.cubics, sizes.cubics_in_single})
        bytes += rounded(size);
    return bytes;
}

template <class T>
T* DeviceBlock::copy_of(std::span<const T> values) {
    T* to = place<T>(values.size());
    check(device_.upload(to, values.data(), values.size_bytes()), "a copy to it");
    return to;
}
template <class T>
VolumeView<T> DeviceBlock::copy_of(const Field<T>& field) {
    const VolumeView<T> view = place(field);
    check(device_.upload(begin_of(view, field), field.storage().data(), field.bytes()),
          "a copy to it");
    return view;
}

DeviceBlock::DeviceBlock(const DeviceChoice& choice, const Block& block, const Interface& interface)
    : choice_(own_device(choice, block.communicator())), device_(functions_of(choice)),
      bytes_(bytes_for(block.options(), block.grid(), interface.options(),
                       interface.substrate_sites())) {
    std::byte* allocated = nullptr;
    check(device_.allocate(choice_.index, bytes_, &allocated), "the allocation of its memory");
    memory_.reset(allocated);

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
                              place(from.transferred)[0],
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
        level.transferred = memory.transferred;
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
            shared_bytes_ = shared_.x.bytes();
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
        count(step_.constrained, frame(halo_width));
    }
    step_.levels = copy_of(std::span<const DeviceLevel>(levels));
    step_.kicks = kicks_ = place<LevelKicks>(levels.size());
    step_.sums = all_sums_ = place<PassSums>(4);
    take_tables(interface);
    step_.sites.force = levels_[0].transferred;
    step_.sites.spacing = block.options().spacing;
    step_.sites.x0 = interface.tile().x0;
    step_.sites.y0 = interface.tile().y0;

    halo_x_ = {true, strip_of(block, true), nullptr, nullptr, 0};
    halo_y_ = {false, strip_of(block, false), nullptr, nullptr, 0};
    const std::size_t strip = longest_strip(block.grid(), level_shapes(block.options()));
    for (double** message : {&to_before_, &to_after_, &from_before_, &from_after_})
        *message = place<double>(strip);
    direct_ = device_.takes_mpi(block.communicator().takes_device_memory());

    // Pinned memory, in the same way.
    const std::size_t size = rounded(2 * sizeof(PassSums)) +
                             rounded(levels.size() * sizeof(LevelKicks)) +
                             4 * rounded(strip * sizeof(double)) + 3 * rounded(shared_bytes_);
    check(device_.allocate_pinned(size, &allocated), "the allocation of the host's part");
    pinned_memory_.reset(allocated);
    std::byte* next = allocated;
    const auto take = [&](auto*& region, std::size_t bytes) {
        region = reinterpret_cast<std::remove_reference_t<decltype(region)>>(next);
        next += rounded(bytes);
    };
    take(pinned_.sums, 2 * sizeof(PassSums));
    take(pinned_.kicks, levels.size() * sizeof(LevelKicks));
    for (double** message :
         {&pinned_.to_before, &pinned_.to_after, &pinned_.from_before, &pinned_.from_after})
        take(*message, strip * sizeof(double));
    for (double*& component : pinned_.shared)
        take(component, shared_bytes_);
}

void DeviceBlock::take_tables(const Interface& interface) {
    const Interface::Tables tables = interface.tables();
    step_.over_rows = tables.rows != nullptr;
    step_.mixed = interface.options().mixed;
    SubstrateHeights heights;
    if (step_.mixed)
        heights.fixed = copy_of(tables.heights->in_mixed())[0];
    else
        heights.height = copy_of(tables.heights->in_double())[0];
    const double* highest = copy_of(tables.highest);
    const double* lowest = copy_of(tables.lowest);
    const double* map = copy_of(tables.map);
    const auto fill = [&](auto& ground, const auto& host) {
        ground = host;
        heights.datum = host.heights.datum;
        ground.heights = heights;
        ground.reach.highest = highest;
        ground.reach.lowest = lowest;
        ground.map.height = map;
    };
    if (step_.over_rows) {
        fill(step_.rows, *tables.rows);
    } else {
        fill(step_.lattice, *tables.lattice);
        step_.lattice.columns = copy_of(tables.columns);
    }
    potential_ = interface.options().potential;
    if (auto* table = std::get_if<Tabulated>(&potential_)) {
        const auto numbers = 4 * static_cast<std::size_t>(table->intervals);
        table->cubics = copy_of(std::span(table->cubics, numbers));
        table->in_single = copy_of(std::span(table->in_single, numbers));
    }
    if (tables.mean_height) {
        step_.mean_height = copy_of(*tables.mean_height)[0];
        step_.tail_density = tables.density;
        step_.with_tail = true;
    }
}

namespace {

/// Calls visit(device's view, host's field) for displacements and velocities of a level.
template <class Memory, class Fields, class Visit>
void each_component(const Memory& memory, const VectorVolume<double>& u, const Fields& host,
                    const Visit& visit) {
    visit(u.x, host.u.x), visit(u.y, host.u.y), visit(u.z, host.u.z);
    visit(memory.v.x, host.v.x), visit(memory.v.y, host.v.y), visit(memory.v.z, host.v.z);
}

} // namespace

void DeviceBlock::upload(const Block& block) {
    launched_.reset();
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

void DeviceBlock::forces(const At& at) {
    if (launched_ == at) return;
    step_.observe = at.observe;
    step_.top = at.top;
    step_.sums = all_sums_ + 2 * (steps_ % 2);
    step_.sites.displacement = VectorVolume<const double>(levels_[0].u[step_.now])[0];
    step_.sites.reference_height = at.reference_height;
    mark(begun);
    check(device_.follow(step_), "the launch of constrained planes");
    mark(followed);
    check(device_.forces(step_, potential_), "the launch of forces");
    mark(pushed);
    launched_ = at;
}

void DeviceBlock::advance(const Block& block, const StepParameters& step,
                          const std::optional<ThermalNoise>& noise) {
    if (shared_level_ >= 0) share_restricted_forces(block);
    if (!kicks_known_ || !(step == kicked_with_)) {
        // Those before have arrived: the host has seen the sums of the step before.
        LevelKicks* kicks = pinned_.kicks;
        step_.damped = false;
        for (const Block::Level& level : block.levels()) {
            *kicks = block.kicks(level, step);
            step_.damped |= kicks->damped_from < level.shape.cells;
            ++kicks;
        }
        check(device_.send(kicks_, pinned_.kicks, levels_.size() * sizeof *kicks), "a copy to it");
        kicked_with_ = step;
        kicks_known_ = true;
    }
    step_.dt = step.dt;
    step_.noisy = noise.has_value();
    if (noise) step_.noise = *noise;
    mark(resumed);
    check(device_.advance(step_), "the launch of the step");
    mark(advanced);
    check(device_.fetch_beside(pinned_.sums, step_.sums, 2 * sizeof(PassSums), sums_are_here),
          "a copy from it");
    step_.now = 1 - step_.now;
    exchange(block);
    mark(exchanged);
    ++steps_;
    launched_.reset();
}

DeviceSums DeviceBlock::sums() {
    check(device_.wait(sums_are_here), "a step");
    const PassSums &forces = pinned_.sums[0], &moved = pinned_.sums[1];
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

/// A mark of the step under way. Three steps have marks: the one launched ahead, the one whose sums
/// are waited for, and the one before, which is recorded.
int DeviceBlock::number_of(StepMark mark, long long step) {
    return static_cast<int>(step % 3) * marks_of_step + mark;
}
void DeviceBlock::mark(StepMark mark) {
    check(device_.mark(number_of(mark, steps_)), "a mark in its queue");
}

void DeviceBlock::record_times(Phases& phases, bool all) {
    if (all && recorded_ < steps_) check(device_.wait(number_of(exchanged, steps_ - 1)), "a step");
    // The sums of the last step say that the one before it has ended.
    for (; recorded_ < steps_ - (all ? 0 : 1); ++recorded_) {
        const auto add = [&](Phase phase, StepMark first, StepMark second) {
            double seconds = 0.0;
            check(device_.seconds_between(number_of(first, recorded_), number_of(second, recorded_),
                                          seconds),
                  "its clock");
            phases.add(phase, seconds);
        };
        add(Phase::interpolate, begun, followed);
        add(Phase::interface, followed, pushed);
        add(Phase::sums, pushed, resumed);
        add(Phase::advance, resumed, advanced);
        add(Phase::exchange, advanced, exchanged);
    }
}

/// Into the level that every rank holds, from all tiles of the level below.
void DeviceBlock::share_restricted_forces(const Block& block) {
    const Block::Level& coarse = block.levels()[static_cast<std::size_t>(shared_level_)];
    const ProcessGrid& grid = block.grid();
    const Tile nodes = grid.footprint(coarse.shape.level, grid.rank());
    check(device_.restrict_to_shared(
              step_, shared_level_, {nodes.x0, nodes.x0 + nodes.nx, nodes.y0, nodes.y0 + nodes.ny}),
          "the launch of a restriction");
    const VectorPlane<double>& transferred =
        levels_[static_cast<std::size_t>(shared_level_)].transferred;
    Field<double>* const host[] = {&shared_.x, &shared_.y, &shared_.z};
    double* device[3];
    for (int c = 0; c < 3; ++c) {
        const PlaneView<double>& plane = c == 0   ? transferred.x
                                         : c == 1 ? transferred.y
                                                  : transferred.z;
        device[c] = plane.origin - (host[c]->view().origin - host[c]->storage().data());
        check(device_.fetch(pinned_.shared[c], device[c], shared_bytes_), "a copy from it");
    }
    wait_for_messages();
    for (int c = 0; c < 3; ++c)
        std::memcpy(host[c]->storage().data(), pinned_.shared[c], shared_bytes_);
    const auto in = shared_.plane(0);
    const std::array planes = {in.x, in.y, in.z};
    gather_footprints(block.communicator(), grid, coarse.shape.level, planes);
    for (int c = 0; c < 3; ++c) {
        std::memcpy(pinned_.shared[c], host[c]->storage().data(), shared_bytes_);
        check(device_.send(device[c], pinned_.shared[c], shared_bytes_), "a copy to it");
    }
}

void DeviceBlock::wait_for_messages() {
    check(device_.mark(messages_are_here), "a mark in its queue");
    check(device_.wait(messages_are_here), "a copy from it");
}

/// Along x, then along y, whose rows hold the halo just received.
void DeviceBlock::exchange(const Block& block) {
    trade(block, true);
    trade(block, false);
}

void DeviceBlock::trade(const Block& block, bool along_x) {
    DeviceHalo& halo = along_x ? halo_x_ : halo_y_;
    const auto size = static_cast<std::size_t>(halo.strip.first[halo.strip.levels]);
    if (size == 0) return;
    const std::size_t bytes = size * sizeof(double);
    halo.buffer = step_.now;
    halo.before = to_before_;
    halo.after = to_after_;
    check(device_.pack(step_, halo), "the launch that packs halos");
    const auto strip = [&](double* device, double* pinned) {
        return std::span(direct_ ? device : pinned, size);
    };
    const ProcessGrid& grid = block.grid();
    const int before = along_x ? grid.neighbour(-1, 0) : grid.neighbour(0, -1);
    const int after = along_x ? grid.neighbour(1, 0) : grid.neighbour(0, 1);
    const Message messages[] = {{before, after, 0, strip(to_before_, pinned_.to_before),
                                 strip(from_after_, pinned_.from_after)},
                                {after, before, 1, strip(to_after_, pinned_.to_after),
                                 strip(from_before_, pinned_.from_before)}};
    if (!direct_) {
        check(device_.fetch(pinned_.to_before, to_before_, bytes), "a copy from it");
        check(device_.fetch(pinned_.to_after, to_after_, bytes), "a copy from it");
    }
    wait_for_messages();
    if (direct_) check(device_.open_to_mpi(true), "opening its memory to MPI");
    block.communicator().exchange(messages);
    if (direct_) check(device_.open_to_mpi(false), "closing its memory to MPI");
    if (!direct_) {
        check(device_.send(from_before_, pinned_.from_before, bytes), "a copy to it");
        check(device_.send(from_after_, pinned_.from_after, bytes), "a copy to it");
    }
    halo.before = from_before_;
    halo.after = from_after_;
    check(device_.unpack(step_, halo), "the launch that unpacks halos");
}

} // namespace asperity
