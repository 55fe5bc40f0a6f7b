// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/run/recorder.hpp"

#include "engine/run/stress_record.hpp"
#include "engine/units.hpp"
#include "io/machine.hpp"
#include "io/result_directory.hpp"
#include "io/run_h5.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <type_traits>
#include <utility>

namespace asperity {

namespace {

/// Gathers a tile's map to that of the whole box, on the root.
std::vector<double> whole(const Communicator& ranks, const ProcessGrid& grid,
                          const std::vector<double>& tile_map) {
    const Tile tile = grid.tile(0);
    Field<double> field(tile, 1);
    for (int y = 0; y < tile.ny; ++y)
        for (int x = 0; x < tile.nx; ++x)
            field.plane(0)(x, y) =
                tile_map[static_cast<std::size_t>(y) * static_cast<std::size_t>(tile.nx) +
                         static_cast<std::size_t>(x)];
    return gather_plane(ranks, grid, 0, std::as_const(field).plane(0));
}

/// Entries of the journal: rows of the series, or members of a group of run.h5. A member is a data
/// set, an attribute of the group, or a row of a data set that grows.
enum EntryKind : std::uint64_t { rows_entry, group_entry };
enum MemberKind : std::uint64_t { data_set, attribute, growing };
using Types = std::tuple<double, float, std::int64_t, std::uint8_t>;

template <class T, std::size_t I = 0>
constexpr std::uint64_t type_number() {
    if constexpr (std::is_same_v<T, std::tuple_element_t<I, Types>>)
        return I;
    else
        return type_number<T, I + 1>();
}

constexpr std::size_t rows_in_memory = 64;

void put_text(io::PayloadWriter& entry, const std::string& text) {
    entry.put<std::uint64_t>(text.size());
    entry.put(std::span<const char>(text));
}

std::string get_text(io::PayloadReader& entry) {
    const auto text = entry.get<char>(entry.get<std::uint64_t>());
    return {text.begin(), text.end()};
}

/// Adds a group to an entry. numbered: the group gets a number if its name exists already.
void put_group(io::PayloadWriter& entry, const std::string& group, bool numbered) {
    put_text(entry, group);
    entry.put<std::uint64_t>(numbered);
}

/// Adds a data set to an entry. unit: unit of a growing data set; io/quantities.hpp has the units
/// of the others.
template <class T>
void put_member(io::PayloadWriter& entry, MemberKind kind, const std::string& name,
                const io::Hdf5File::Shape& shape, std::span<const T> values,
                const std::string& unit = "") {
    entry.put<std::uint64_t>(kind);
    put_text(entry, name);
    put_text(entry, unit);
    entry.put(type_number<T>());
    entry.put<std::uint64_t>(shape.size());
    entry.put(shape);
    entry.put<std::uint64_t>(values.size());
    entry.put(values);
}

template <class T>
void write_member(io::Hdf5File& file, MemberKind kind, const std::string& group,
                  const std::string& name, const std::string& unit,
                  const io::Hdf5File::Shape& shape, const std::vector<T>& values) {
    const std::string path = group + "/" + name;
    if (kind == data_set) return io::write_described(file, path, shape, values);
    if constexpr (std::is_same_v<T, double>)
        if (kind == attribute)
            return io::write_described_attribute(file, group, name, values.front());
    if (!file.exists(path)) {
        file.make_dataset<T>(path, shape);
        if (!unit.empty()) file.write_attribute(path, "unit", unit);
    }
    file.append<T>(path, values);
}

/// Writes the entry of a group into run.h5.
void write_group(io::Hdf5File& file, io::PayloadReader entry) {
    const std::string first = get_text(entry);
    const bool numbered = entry.get<std::uint64_t>() != 0;
    std::string group = first; // a path of several cycles comes to a state of this name again
    for (int n = 2; numbered && file.exists(group); ++n)
        group = first + "-" + std::to_string(n);
    while (!entry.at_end()) {
        const auto kind = static_cast<MemberKind>(entry.get<std::uint64_t>());
        const std::string name = get_text(entry), unit = get_text(entry);
        const auto type = entry.get<std::uint64_t>();
        const auto shape = entry.get<std::uint64_t>(entry.get<std::uint64_t>());
        const auto size = entry.get<std::uint64_t>();
        const auto write = [&]<class T>(T) {
            if (type == type_number<T>())
                write_member(file, kind, group, name, unit, shape, entry.get<T>(size));
        };
        std::apply([&](auto... of_type) { (write(of_type), ...); }, Types{});
    }
}

/// Returns the statistics of the surfaces of a pair with the names of their spectra.
std::vector<std::pair<std::string, const SurfaceStatistics*>> parts_of(const Surface& surface) {
    if (!surface.pair) return {};
    return {{"/substrate/own_spectrum", &surface.pair->own},
            {"/substrate/counter_spectrum", &surface.pair->counter}};
}

void write_substrate(io::Hdf5File& file, const Surface& surface) {
    const auto n = static_cast<std::uint64_t>(surface.sites);
    io::write_described(file, "/substrate/height", {n, n}, surface.height);
    if (const std::size_t count = surface.atoms.size(); count > 0) {
        std::vector<double> places;
        places.reserve(3 * count);
        for (std::size_t i = 0; i < count; ++i)
            places.insert(places.end(),
                          {surface.atoms.x[i], surface.atoms.y[i], surface.atoms.z[i]});
        io::write_described(file, "/substrate/atoms", {count, 3}, places);
        if (!surface.atoms.type.empty()) {
            std::vector<std::int32_t> entry = surface.atoms.type;
            for (std::int32_t& number : entry)
                ++number;
            io::write_described(file, "/substrate/type", {count}, entry);
        }
    }
    io::write_described_attribute(file, "/substrate", "edge", surface.length);
    std::vector<double> q, realised, target;
    for (const SpectrumBin& bin : surface.statistics.spectrum) {
        q.push_back(bin.q);
        realised.push_back(bin.realised);
        target.push_back(bin.target);
    }
    if (surface.pair)
        io::write_described(file, "/substrate/counter_height", {n, n},
                            surface.pair->counter_height);
    if (q.empty()) return;
    for (const auto& [name, one] : parts_of(surface)) {
        std::vector<double> own;
        for (const SpectrumBin& bin : one->spectrum)
            own.push_back(bin.realised);
        io::write_described(file, name, {own.size()}, own);
    }
    io::write_described(file, "/substrate/spectrum_q", {q.size()}, q);
    io::write_described(file, "/substrate/spectrum", {q.size()}, realised);
    io::write_described(file, "/substrate/spectrum_target", {q.size()}, target);
}

/// Adds P(u), normalised to one: 200 bins from the least to the greatest gap. Holes do not count.
void put_gap_density(io::PayloadWriter& entry, std::vector<double> gap) {
    std::erase_if(gap, [](double u) { return std::isnan(u); });
    const auto [least, greatest] = std::minmax_element(gap.begin(), gap.end());
    constexpr std::size_t bins = 200;
    const double size = std::max(std::abs(*least), std::abs(*greatest));
    const double width = std::max((*greatest - *least) / bins, size > 0.0 ? 1e-12 * size : 1.0);
    std::vector<double> density(bins, 0.0), edge(bins + 1);
    for (std::size_t i = 0; i <= bins; ++i)
        edge[i] = *least + width * static_cast<double>(i);
    for (double u : gap) {
        const auto bin = static_cast<std::size_t>((u - *least) / width);
        density[std::min(bin, bins - 1)] += 1.0 / (width * static_cast<double>(gap.size()));
    }
    put_member<double>(entry, data_set, "gap_edges", {bins + 1}, edge);
    put_member<double>(entry, data_set, "gap_density", {bins}, density);
}

} // namespace

Recorder::Recorder(const io::Directory& directory, const Surface& surface,
                   const Communicator& communicator, std::vector<const SeriesColumn*> columns,
                   const std::optional<Position>& resume, AddToFile add)
    : communicator_(communicator), directory_(directory), surface_(surface), add_(std::move(add)),
      columns_(std::move(columns)) {
    if (resume) rows_ = resume->rows;
    communicator_.on_root([&] {
        journal_.emplace(directory_, io::run_file::journal, resume ? resume->mark.bytes : 0);
        build();
    });
}

Path::Wish Recorder::wish_of_row() const {
    const bool of_sites = std::any_of(columns_.begin(), columns_.end(),
                                      [](const SeriesColumn* c) { return c->of_sites; });
    return {.energies = true, .layer = of_sites};
}

void Recorder::row(const Path& path) {
    std::vector<double> row;
    for (const SeriesColumn* c : columns_)
        row.push_back(c->value(path, path.now()));
    ++rows_;
    communicator_.on_root([&] {
        waiting_.insert(waiting_.end(), row.begin(), row.end());
        if (rows_ % rows_in_memory == 0) append_rows();
    });
}

void Recorder::append_rows() {
    if (waiting_.empty()) return;
    journal_->append(rows_entry, std::as_bytes(std::span(std::as_const(waiting_))));
    waiting_.clear();
}

void Recorder::fields(const std::string& state, const VectorPlane<const double>& layer,
                      const ProcessGrid& grid, const Interface& interface,
                      const BlockOptions& block) {
    const io::PayloadWriter entry =
        entry_of_fields(state, layer, communicator_, grid, interface, block);
    communicator_.on_root([&] { journal_->append(group_entry, entry.bytes()); });
}

void Recorder::stresses(const std::string& state, const VectorPlane<const double>& layer,
                        const ProcessGrid& grid, const Interface& interface,
                        const BlockOptions& block, const StressOptions& options) {
    const InterfaceMaps maps = interface.maps(layer);
    std::vector<double> pressure = whole(communicator_, grid, maps.pressure);
    std::vector<double> gap = whole(communicator_, grid, maps.gap);
    const std::vector<double> z = gather_plane(communicator_, grid, 0, layer.z);
    const bool slid = interface.place() != std::array<double, 2>{};
    communicator_.on_root([&] {
        crop_map(pressure, grid.tile(0).sites, interface.sites_across());
        if (slid) // the wall below each site, to a constant
            for (std::size_t i = 0; i < gap.size(); ++i)
                gap[i] = z[i] - gap[i];
        const StressRecord record = record_stresses(
            block,
            slid && options.friction == 0.0 ? with_slopes(block, std::move(pressure), gap)
                                            : with_friction(std::move(pressure), options.friction),
            options);
        io::PayloadWriter entry;
        put_group(entry, "/stress/" + state, true);
        for (const StressArray& array : record.arrays)
            put_member<float>(entry, data_set, array.name, array.shape, array.values);
        for (const auto& [name, value] : record.attributes)
            put_member(entry, attribute, name, {}, std::span<const double>(&value, 1));
        journal_->append(group_entry, entry.bytes());
    });
}

io::PayloadWriter Recorder::entry_of_fields(const std::string& state,
                                            const VectorPlane<const double>& layer,
                                            const Communicator& ranks, const ProcessGrid& grid,
                                            const Interface& interface, const BlockOptions& block) {
    const InterfaceMaps maps = interface.maps(layer);
    const int across = grid.tile(0).sites, inner = interface.sites_across();
    const auto n = static_cast<std::uint64_t>(inner);
    io::PayloadWriter entry;
    ranks.on_root([&] {
        entry.reserve(4096 + state.size() + 57 * n * n);
        put_group(entry, "/fields/" + state, true);
    });
    std::vector<double> gap;                                                 // on the root
    const auto put = [&](const char* name, const std::vector<double>& map) { // one at a time
        ranks.on_root([&] { put_member<double>(entry, data_set, name, {n, n}, map); });
    };
    const auto of_box = [&](std::vector<double> map) {
        ranks.on_root([&] { crop_map(map, across, inner); });
        return map;
    };
    gap = of_box(whole(ranks, grid, maps.gap));
    put("gap", gap);
    const std::vector<double> pressure = of_box(whole(ranks, grid, maps.pressure));
    put("pressure", pressure);
    if (block.counter)
        ranks.on_root([&] {
            std::vector<double> u = surface_displacement(block.counter_block(), pressure);
            for (double& z : u)
                z *= -units::gigapascal; // the pressure is in GPa, and pushes down
            put_member<double>(entry, data_set, "u_z_counter", {n, n}, u);
        });
    put("distance", of_box(whole(ranks, grid, maps.distance)));
    if (interface.yielding_wall()) {
        put("set", of_box(whole(ranks, grid, maps.set)));
        put("yielded_height", of_box(whole(ranks, grid, maps.yielded_heights)));
    }
    for (const auto& [name, values] : maps.of_sites)
        put(name.c_str(), of_box(whole(ranks, grid, values)));
    put("u_x", of_box(gather_plane(ranks, grid, 0, layer.x)));
    put("u_y", of_box(gather_plane(ranks, grid, 0, layer.y)));
    put("u_z", of_box(gather_plane(ranks, grid, 0, layer.z)));
    const auto touching = of_box(whole(ranks, grid, {maps.contact.begin(), maps.contact.end()}));
    ranks.on_root([&] {
        const std::vector<std::uint8_t> contact(touching.begin(), touching.end());
        put_member<std::uint8_t>(entry, data_set, "contact", {n, n}, contact);
        const auto [slide_x, slide_y] = interface.place();
        const auto put_number = [&](const char* name, double value) {
            put_member(entry, attribute, name, {}, std::span<const double>(&value, 1));
        };
        put_number("reference_height", interface.reference_height());
        if (slide_x != 0.0 || slide_y != 0.0) {
            put_number("slide_x", slide_x);
            put_number("slide_y", slide_y);
        }
        put_gap_density(entry, std::move(gap));
    });
    return entry;
}

namespace {

std::array<std::vector<double>, 3> whole_layer(const Communicator& ranks, const ProcessGrid& grid,
                                               const VectorPlane<const double>& layer) {
    return {gather_plane(ranks, grid, 0, layer.x), gather_plane(ranks, grid, 0, layer.y),
            gather_plane(ranks, grid, 0, layer.z)};
}

} // namespace

void Recorder::frame(const Path& path, bool velocities) {
    const StepRecord& now = path.now();
    std::array<std::vector<double>, 3> u = whole_layer(communicator_, path.grid(), path.layer()), v;
    for (std::size_t axis : {0u, 1u}) // positions are over the substrate
        if (const double place = now.slide[axis]; place != 0.0)
            for (double& x : u[axis])
                x += place;
    if (velocities) v = whole_layer(communicator_, path.grid(), path.velocities());
    communicator_.on_root([&] {
        const BlockOptions& block = path.scene_case().simulation.block;
        const auto sites = static_cast<std::size_t>(block.sites);
        std::vector<float> position(3 * sites * sites), velocity;
        for (std::size_t i = 0; i < sites * sites; ++i) {
            // Sites stand over the hollows of the substrate (docs/explanation/model.md).
            const std::array<double, 3> rest = {
                (static_cast<double>(i % sites) + 0.5) * block.spacing,
                (static_cast<double>(i / sites) + 0.5) * block.spacing,
                path.interface().reference_height()};
            for (std::size_t c = 0; c < 3; ++c)
                position[3 * i + c] = static_cast<float>(rest[c] + u[c][i]);
        }
        if (velocities) {
            velocity.resize(position.size());
            for (std::size_t i = 0; i < sites * sites; ++i)
                for (std::size_t c = 0; c < 3; ++c)
                    velocity[3 * i + c] = static_cast<float>(1e3 * v[c][i]); // Å/fs to Å/ps
        }
        const double edge = block.sites * block.spacing;
        const double height = 2.0 * path.interface().start_height() + // room for both ends
                              block.thickness * block.spacing;
        std::array<float, 9> edges{}; // a matrix
        edges[0] = edges[4] = static_cast<float>(edge);
        edges[8] = static_cast<float>(height);
        const std::int64_t step = now.step;
        const double time = now.time * 1e-3; // ps
        io::PayloadWriter entry;
        put_group(entry, io::trajectory, false);
        const auto put = [&](const std::string& name, const char* unit, io::Hdf5File::Shape shape,
                             std::span<const float> values) {
            put_member(entry, growing, name + "/value", shape, values, unit);
            put_member(entry, growing, name + "/step", {0}, std::span(&step, 1));
            put_member(entry, growing, name + "/time", {0}, std::span(&time, 1), "ps");
        };
        put("box/edges", "Angstrom", {0, 3, 3}, edges);
        put("position", "Angstrom", {0, sites * sites, 3}, position);
        if (velocities) put("velocity", "Angstrom ps-1", {0, sites * sites, 3}, velocity);
        journal_->append(group_entry, entry.bytes());
    });
}

Recorder::Position Recorder::position() {
    Position now{rows_, {}};
    communicator_.on_root([&] {
        append_rows();
        now.mark = journal_->mark();
    });
    return now;
}

void Recorder::synchronize() {
    communicator_.on_root([&] {
        append_rows();
        journal_->synchronize();
    });
}

void Recorder::write() {
    communicator_.on_root([&] { write_on_root(); });
}

void Recorder::write_on_root() {
    append_rows();
    build();
}

void Recorder::write_if_cheap() {
    communicator_.on_root([&] {
        const double since = std::chrono::duration<double>(Clock::now() - built_).count();
        if (build_seconds_ <= largest_share * since) write_on_root();
    });
}

/// Writes run.h5 anew, from all entries. Root only.
void Recorder::build() {
    const Clock::time_point start = Clock::now();
    io::Hdf5File file({directory_, io::run_file::series}, io::Hdf5File::Mode::create);
    io::write_h5md_head(file);
    write_substrate(file, surface_);
    journal_->replay([&](std::uint64_t kind, io::Bytes payload) {
        io::PayloadReader entry(payload);
        if (kind == group_entry) write_group(file, entry);
    });
    if (file.exists(io::trajectory)) io::describe_trajectory(file);
    const auto all = series();
    for (const SeriesColumn* c : columns_) {
        const std::vector<double>& values = all.at(c->name());
        const std::string place = "/" + std::string(c->quantity.name);
        file.write<double>(place, {values.size()}, values);
        io::describe(file, place, c->quantity);
    }
    add_(file);
    file.close();
    built_ = Clock::now();
    build_seconds_ = std::chrono::duration<double>(built_ - start).count();
}

std::map<std::string, std::vector<double>> Recorder::series() const {
    std::map<std::string, std::vector<double>> all;
    std::vector<std::vector<double>*> columns;
    for (const SeriesColumn* c : columns_)
        columns.push_back(&all[c->name()]);
    journal_->replay([&](std::uint64_t kind, io::Bytes payload) {
        io::PayloadReader entry(payload);
        while (kind == rows_entry && !entry.at_end())
            for (std::vector<double>* column : columns)
                column->push_back(entry.get<double>());
    });
    return all;
}

void Recorder::remove_journal() { directory_.remove(io::run_file::journal); }

} // namespace asperity
