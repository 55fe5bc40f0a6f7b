// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/run/recorder.hpp"

#include "decomposition/plane_bands.hpp"
#include "engine/run/stress_record.hpp"
#include "engine/units.hpp"
#include "io/machine.hpp"
#include "io/result_directory.hpp"
#include "io/run_h5.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iterator>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>

namespace asperity {

namespace {

/// Entries of the journal: rows of the series, the head of a group of run.h5, and its members, and
/// rows of a map of the substrate. A member is a data set, an attribute of the group, or a row of a
/// data set that grows. Members follow the head of their group, in its entry or in entries of their
/// own.
enum EntryKind : std::uint64_t { rows_entry, group_entry, member_entry, substrate_entry };
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

/// Returns a view of a map of a tile, [y * nx + x].
PlaneView<const double> view_of(const std::vector<double>& map, const Tile& tile) {
    return {map.data(), tile.nx, tile.nx, tile.ny};
}

/// Appends the head of a group to the journal; its members follow. numbered: the group gets a
/// number if its name exists already.
void append_group(io::Journal& journal, const std::string& group, bool numbered) {
    io::PayloadWriter entry;
    put_text(entry, group);
    entry.put<std::uint64_t>(numbered);
    journal.append(group_entry, entry.bytes());
}

/// Begins a member of the last group; its `count` values follow by add(). unit: unit of a growing
/// data set; io/quantities.hpp has the units of the others.
template <class T>
void begin_member(io::Journal& journal, MemberKind kind, const std::string& name,
                  const io::Hdf5File::Shape& shape, std::uint64_t count,
                  const std::string& unit = "") {
    io::PayloadWriter head;
    head.put<std::uint64_t>(kind);
    put_text(head, name);
    put_text(head, unit);
    head.put(type_number<T>());
    head.put<std::uint64_t>(shape.size());
    head.put(shape);
    head.put(count);
    journal.begin(member_entry, head.bytes().size() + count * sizeof(T));
    journal.add(head.bytes());
}
template <class T>
void append_member(io::Journal& journal, MemberKind kind, const std::string& name,
                   const io::Hdf5File::Shape& shape, std::span<const T> values,
                   const std::string& unit = "") {
    begin_member<T>(journal, kind, name, shape, values.size(), unit);
    journal.add(std::as_bytes(values));
}

/// Calls take(offset, count) for blocks of a data set of this shape, in the order of their values,
/// each of whole rows and, if a row is no longer, of at most band_length values.
void each_block(const io::Hdf5File::Shape& shape, const auto& take) {
    std::size_t axis = 0; // along which blocks are cut
    std::uint64_t row = io::Hdf5File::volume(shape), before = 1;
    for (; axis < shape.size(); ++axis) {
        row /= std::max<std::uint64_t>(1, shape[axis]);
        if (row <= band_length || axis + 1 == shape.size()) break;
        before *= shape[axis];
    }
    if (axis == shape.size()) return;
    const std::uint64_t most =
        std::max<std::uint64_t>(1, band_length / std::max<std::uint64_t>(1, row));
    for (std::uint64_t i = 0; i < before; ++i) {
        io::Hdf5File::Shape offset(shape.size(), 0), count = shape;
        std::uint64_t left = i;
        for (std::size_t k = axis; k-- > 0; left /= shape[k]) {
            offset[k] = left % shape[k];
            count[k] = 1;
        }
        for (std::uint64_t first = 0; first < shape[axis]; first += most) {
            offset[axis] = first;
            count[axis] = std::min(most, shape[axis] - first);
            take(offset, count);
        }
    }
}

/// Returns true if the values that a reader has left are worth compressing.
template <class T>
bool is_repetitive(const io::Hdf5File::Shape& shape, io::PayloadReader values) {
    if (shape.size() < 2) return false;
    io::Repetition<T> repetition;
    each_block(shape, [&](const auto&, const io::Hdf5File::Shape& count) {
        repetition.add(values.get<T>(io::Hdf5File::volume(count)));
    });
    return repetition.is_large();
}

template <class T>
void write_member(io::Hdf5File& file, MemberKind kind, const std::string& group,
                  const std::string& name, const std::string& unit, io::Hdf5File::Shape shape,
                  io::PayloadReader& values) {
    const std::string path = group + "/" + name;
    if constexpr (std::is_same_v<T, double>)
        if (kind == attribute)
            return io::write_described_attribute(file, group, name, values.get<T>());
    std::uint64_t row = 0;
    if (kind == growing) {
        if (!file.exists(path)) {
            file.make_dataset<T>(path, shape);
            if (!unit.empty()) file.write_attribute(path, "unit", unit);
        }
        row = file.extend(path);
        shape[0] = 1;
    } else {
        file.make_dataset<T>(path, shape, is_repetitive<T>(shape, values));
    }
    each_block(shape, [&](io::Hdf5File::Shape offset, const io::Hdf5File::Shape& count) {
        offset[0] += row;
        file.write_slab<T>(path, offset, count, values.get<T>(io::Hdf5File::volume(count)));
    });
    if (kind == data_set) io::describe(file, path);
}

/// Returns the name in run.h5 of the group whose head is read.
std::string group_of(const io::Hdf5File& file, io::PayloadReader& entry) {
    const std::string first = get_text(entry);
    const bool numbered = entry.get<std::uint64_t>() != 0;
    std::string group = first; // a path of several cycles comes to a state of this name again
    for (int n = 2; numbered && file.exists(group); ++n)
        group = first + "-" + std::to_string(n);
    return group;
}

/// Writes the member of a group that is read into run.h5.
void write_member(io::Hdf5File& file, const std::string& group, io::PayloadReader& entry) {
    const auto kind = static_cast<MemberKind>(entry.get<std::uint64_t>());
    const std::string name = get_text(entry), unit = get_text(entry);
    const auto type = entry.get<std::uint64_t>();
    const auto shape = entry.get<std::uint64_t>(entry.get<std::uint64_t>());
    entry.get<std::uint64_t>(); // number of values
    const auto write = [&]<class T>(T) {
        if (type == type_number<T>()) write_member<T>(file, kind, group, name, unit, shape, entry);
    };
    std::apply([&](auto... of_type) { (write(of_type), ...); }, Types{});
}

/// Returns the statistics of the surfaces of a pair with the names of their spectra.
std::vector<std::pair<std::string, const SurfaceStatistics*>> parts_of(const Surface& surface) {
    if (!surface.pair) return {};
    return {{"/substrate/own_spectrum", &surface.pair->own},
            {"/substrate/counter_spectrum", &surface.pair->counter}};
}

/// Returns the maps of a surface with their names in run.h5: this rank's bands of them.
std::vector<std::pair<std::string, const std::vector<double>*>> maps_of(const Surface& surface) {
    std::vector<std::pair<std::string, const std::vector<double>*>> maps = {
        {"/substrate/height", &surface.height}};
    if (surface.pair) maps.emplace_back("/substrate/counter_height", &surface.pair->counter_height);
    return maps;
}

/// Calls append() on the root with entries that hold the maps of a surface, some rows in each.
/// Collective.
void each_entry_of_substrate(const Surface& surface,
                             const std::function<void(const io::PayloadWriter&)>& append) {
    constexpr int values = 1 << 20;
    const int n = surface.sites, piece = std::max(1, values / n);
    for (const auto& [name, band] : maps_of(surface))
        for (int first = 0; first < n; first += piece) {
            const int count = std::min(piece, n - first);
            const std::vector<double> rows =
                surface.bands().fetch(*band, first, surface.ranks.root() ? count : 0);
            surface.ranks.on_root([&] {
                io::PayloadWriter entry;
                put_text(entry, name);
                entry.put<std::uint64_t>(static_cast<std::uint64_t>(first));
                entry.put<std::uint64_t>(static_cast<std::uint64_t>(count));
                entry.put<std::uint64_t>(rows.size());
                entry.put(rows);
                append(entry);
            });
        }
}

/// Writes the rows of an entry into run.h5.
void write_rows_of_substrate(io::Hdf5File& file, io::PayloadReader entry) {
    const std::string map = get_text(entry);
    const auto first = entry.get<std::uint64_t>(), count = entry.get<std::uint64_t>(),
               values = entry.get<std::uint64_t>();
    file.write_slab<double>(map, {first, 0}, {count, values / count}, entry.get<double>(values));
}

void write_substrate(io::Hdf5File& file, const Surface& surface) {
    const auto n = static_cast<std::uint64_t>(surface.sites);
    const SurfaceStatistics& heights = surface.statistics;
    for (const auto& [name, band] : maps_of(surface)) { // entries of the journal fill them
        file.make_dataset<double>(name, {n, n}, heights.lowest == heights.highest);
        io::describe(file, name);
    }
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

/// P(u), normalised to one: 200 bins from the least to the greatest gap. Holes do not count.
class GapDensity {
public:
    /// Looks at the gaps of the first n x n sites of the box in this rank's tile. Collective.
    GapDensity(const Communicator& ranks, const Tile& tile, int n, const std::vector<double>& gap) {
        double least = HUGE_VAL, greatest = -least;
        for (int y = 0; y < std::min(tile.ny, n - tile.y0); ++y)
            for (int x = 0; x < std::min(tile.nx, n - tile.x0); ++x) {
                const double u = view_of(gap, tile)(x, y);
                if (std::isnan(u)) continue;
                least = std::min(least, u);
                greatest = std::max(greatest, u);
                ++sites_;
            }
        least_ = -ranks.max(-least);
        greatest = ranks.max(greatest);
        ranks.sum(std::span(&sites_, 1));
        const double size = std::max(std::abs(least_), std::abs(greatest));
        width_ = std::max((greatest - least_) / bins, size > 0.0 ? 1e-12 * size : 1.0);
    }
    /// Adds gaps to the density.
    void add(std::span<const double> gap) {
        for (const double u : gap) {
            if (std::isnan(u)) continue;
            const auto bin = static_cast<std::size_t>((u - least_) / width_);
            density_[std::min(bin, bins - 1)] += 1.0 / (width_ * static_cast<double>(sites_));
        }
    }
    void append_to(io::Journal& journal) const {
        std::vector<double> edge(bins + 1);
        for (std::size_t i = 0; i <= bins; ++i)
            edge[i] = least_ + width_ * static_cast<double>(i);
        append_member<double>(journal, data_set, "gap_edges", {bins + 1}, edge);
        append_member<double>(journal, data_set, "gap_density", {bins}, density_);
    }

private:
    static constexpr std::size_t bins = 200;
    double least_ = 0.0, width_ = 0.0; ///< Å
    std::int64_t sites_ = 0;           ///< number of gaps of the box
    std::vector<double> density_ = std::vector<double>(bins, 0.0);
};

} // namespace

Recorder::Recorder(const io::Directory& directory, const Surface& surface,
                   const Communicator& communicator, std::vector<const SeriesColumn*> columns,
                   const std::optional<Position>& resume, AddToFile add)
    : communicator_(communicator), directory_(directory), surface_(surface), add_(std::move(add)),
      columns_(std::move(columns)) {
    if (resume) rows_ = resume->rows;
    bool complete = false; // the journal has the heights
    communicator_.on_root([&] {
        journal_.emplace(directory_, io::run_file::journal, resume ? resume->mark.bytes : 0);
        journal_->replay([&](std::uint64_t kind, io::PayloadReader) {
            complete = complete || kind == substrate_entry;
        });
    });
    communicator_.broadcast(std::as_writable_bytes(std::span(&complete, 1)));
    if (!complete)
        each_entry_of_substrate(surface_, [&](const io::PayloadWriter& entry) {
            journal_->append(substrate_entry, entry.bytes());
        });
    communicator_.on_root([&] { build(); });
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
    InterfaceMaps maps = interface.maps(layer);
    const Tile tile = grid.tile(0);
    const auto n = static_cast<std::size_t>(interface.sites_across());
    communicator_.on_root([&] { append_group(*journal_, "/fields/" + state, true); });
    /// Appends a map of the first n x n sites in bands.
    const auto put = [&]<class T>(const std::string& name, PlaneView<const double> map,
                                  const ProcessGrid& cut, const std::function<T(double)>& value,
                                  GapDensity* density = nullptr) {
        communicator_.on_root([&] { begin_member<T>(*journal_, data_set, name, {n, n}, n * n); });
        gather_bands(communicator_, cut, 0, std::span(&map, 1),
                     [&](int first, std::span<const double> band) {
                         const auto width = static_cast<std::size_t>(tile.sites);
                         const auto row = static_cast<std::size_t>(first);
                         std::vector<T> values;
                         values.reserve(band.size());
                         for (std::size_t y = 0; y < band.size() / width && row + y < n; ++y) {
                             const auto line = band.subspan(y * width, n);
                             if (density) density->add(line);
                             std::ranges::transform(line, std::back_inserter(values), value);
                         }
                         journal_->add(std::as_bytes(std::span(std::as_const(values))));
                     });
    };
    const std::function<double(double)> same = [](double value) { return value; };
    const auto put_map = [&](const std::string& name, const std::vector<double>& map) {
        put(name, view_of(map, tile), grid, same);
    };
    GapDensity density(communicator_, tile, static_cast<int>(n), maps.gap);
    put("gap", view_of(maps.gap, tile), grid, same, &density);
    put_map("pressure", maps.pressure);
    if (block.counter) {
        const Slab slab(tile.sites, communicator_);
        const ProcessGrid slabs =
            ProcessGrid::slabs(communicator_.size(), communicator_.rank(), tile.sites);
        SiteField<double> u = site_field<double>(slab, 1);
        move_plane(communicator_, grid, view_of(maps.pressure, tile), slabs, u[0].plane(0));
        displace_surface(block.counter_block(), slab, u);
        put("u_z_counter", std::as_const(u[0]).plane(0), slabs,
            std::function<double(double)>(
                // The pressure is in GPa, and pushes down.
                [](double z) { return z * -units::gigapascal; }));
    }
    put_map("distance", maps.distance);
    for (const auto& [name, values] : maps.of_sites)
        put_map(name, values);
    put("u_x", layer.x, grid, same);
    put("u_y", layer.y, grid, same);
    put("u_z", layer.z, grid, same);
    maps.gap.assign(maps.contact.begin(), maps.contact.end()); // the gaps have been written
    put("contact", view_of(maps.gap, tile), grid,
        std::function<std::uint8_t(double)>(
            [](double touches) { return static_cast<std::uint8_t>(touches); }));
    communicator_.on_root([&] {
        const auto [slide_x, slide_y] = interface.place();
        const auto put_number = [&](const char* name, double value) {
            append_member(*journal_, attribute, name, {}, std::span<const double>(&value, 1));
        };
        put_number("reference_height", interface.reference_height());
        if (slide_x != 0.0 || slide_y != 0.0) {
            put_number("slide_x", slide_x);
            put_number("slide_y", slide_y);
        }
        density.append_to(*journal_);
    });
}

void Recorder::stresses(const std::string& state, const VectorPlane<const double>& layer,
                        const ProcessGrid& grid, const Interface& interface,
                        const BlockOptions& block, const StressOptions& options) {
    const InterfaceMaps maps = interface.maps(layer);
    const Tile tile = grid.tile(0);
    const auto whole = [&](const std::vector<double>& map) {
        return gather_plane(communicator_, grid, 0, view_of(map, tile));
    };
    std::vector<double> pressure = whole(maps.pressure), gap = whole(maps.gap);
    const std::vector<double> z = gather_plane(communicator_, grid, 0, layer.z);
    const bool slid = interface.place() != std::array<double, 2>{};
    communicator_.on_root([&] {
        crop_map(pressure, tile.sites, interface.sites_across());
        if (slid) // the wall below each site, to a constant
            for (std::size_t i = 0; i < gap.size(); ++i)
                gap[i] = z[i] - gap[i];
        const StressRecord record = record_stresses(
            block,
            slid && options.friction == 0.0 ? with_slopes(block, std::move(pressure), gap)
                                            : with_friction(std::move(pressure), options.friction),
            options);
        append_group(*journal_, "/stress/" + state, true);
        for (const StressArray& array : record.arrays)
            append_member<float>(*journal_, data_set, array.name, array.shape, array.values);
        for (const auto& [name, value] : record.attributes)
            append_member(*journal_, attribute, name, {}, std::span<const double>(&value, 1));
    });
}

void Recorder::frame(const Path& path, bool velocities) {
    const StepRecord& now = path.now();
    const BlockOptions& block = path.scene_case().simulation.block;
    const auto sites = static_cast<std::size_t>(block.sites);
    const double edge = block.sites * block.spacing;
    const double height = 2.0 * path.interface().start_height() + // room for both ends
                          block.thickness * block.spacing;
    std::array<float, 9> edges{}; // a matrix
    edges[0] = edges[4] = static_cast<float>(edge);
    edges[8] = static_cast<float>(height);
    const std::int64_t step = now.step;
    const double time = now.time * 1e-3; // ps
    /// Appends the time of the values of an element.
    const auto put_time = [&](const std::string& name) {
        append_member(*journal_, growing, name + "/step", {0}, std::span(&step, 1));
        append_member(*journal_, growing, name + "/time", {0}, std::span(&time, 1), "ps");
    };
    communicator_.on_root([&] {
        append_group(*journal_, io::trajectory, false);
        append_member<float>(*journal_, growing, "box/edges/value", {0, 3, 3}, edges, "Angstrom");
        put_time("box/edges");
    });
    /// Appends a vector for each site in bands: value(component, site, the layer's number).
    const auto put = [&](const std::string& name, const char* unit,
                         const VectorPlane<const double>& layer, const auto& value) {
        communicator_.on_root([&] {
            begin_member<float>(*journal_, growing, name + "/value", {0, sites * sites, 3},
                                3 * sites * sites, unit);
        });
        const std::array planes = {layer.x, layer.y, layer.z};
        gather_bands(
            communicator_, path.grid(), 0, planes, [&](int first, std::span<const double> band) {
                const std::size_t count = band.size() / 3;
                std::vector<float> vectors(band.size());
                for (std::size_t i = 0; i < count; ++i)
                    for (std::size_t c = 0; c < 3; ++c)
                        vectors[3 * i + c] = static_cast<float>(value(
                            c, static_cast<std::size_t>(first) * sites + i, band[c * count + i]));
                journal_->add(std::as_bytes(std::span(std::as_const(vectors))));
            });
        communicator_.on_root([&] { put_time(name); });
    };
    put("position", "Angstrom", path.layer(), [&](std::size_t c, std::size_t site, double u) {
        // Sites stand over the hollows of the substrate (docs/explanation/model.md), and positions
        // are over the substrate.
        const std::array<double, 3> lattice_place = {
            (static_cast<double>(site % sites) + 0.5) * block.spacing,
            (static_cast<double>(site / sites) + 0.5) * block.spacing,
            path.interface().reference_height()};
        return lattice_place[c] + (c < 2 && now.slide[c] != 0.0 ? u + now.slide[c] : u);
    });
    if (velocities)
        put("velocity", "Angstrom ps-1", path.velocities(),
            [](std::size_t, std::size_t, double v) { return 1e3 * v; }); // Å/fs to Å/ps
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
    std::string group;
    journal_->replay([&](std::uint64_t kind, io::PayloadReader entry) {
        if (kind == rows_entry) return;
        if (kind == substrate_entry) return write_rows_of_substrate(file, entry);
        if (kind == group_entry) group = group_of(file, entry);
        while (!entry.at_end())
            write_member(file, group, entry);
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
    journal_->replay([&](std::uint64_t kind, io::PayloadReader entry) {
        if (kind != rows_entry) return;
        const std::vector<double> rows = entry.remaining<double>();
        for (std::size_t i = 0; i < rows.size(); ++i)
            columns[i % columns.size()]->push_back(rows[i]);
    });
    return all;
}

void Recorder::remove_journal() { directory_.remove(io::run_file::journal); }

} // namespace asperity
