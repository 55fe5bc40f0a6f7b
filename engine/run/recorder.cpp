// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/run/recorder.hpp"

#include "io/machine.hpp"
#include "io/result_directory.hpp"
#include "io/run_h5.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace asperity {

namespace {

/// A tile's map as the whole box's, on the root.
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

/// Records of the journal.
enum RecordKind : std::uint64_t { rows_record, fields_record, frame_record };

constexpr std::size_t rows_in_memory = 64;

/// The maps of a state that are doubles, in the order of their record.
constexpr const char* map_columns[] = {"gap", "pressure", "distance", "u_x", "u_y", "u_z"};

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
    if (q.empty()) return;
    io::write_described(file, "/substrate/spectrum_q", {q.size()}, q);
    io::write_described(file, "/substrate/spectrum", {q.size()}, realised);
    io::write_described(file, "/substrate/spectrum_target", {q.size()}, target);
}

/// P(u), normalised to one: 200 bins from the least to the greatest gap.
void write_gap_density(io::Hdf5File& file, const std::string& group,
                       const std::vector<double>& gap) {
    const auto [least, greatest] = std::minmax_element(gap.begin(), gap.end());
    constexpr std::size_t bins = 200;
    const double width = std::max((*greatest - *least) / bins, 1e-12);
    std::vector<double> density(bins, 0.0), edge(bins + 1);
    for (std::size_t i = 0; i <= bins; ++i)
        edge[i] = *least + width * static_cast<double>(i);
    for (double u : gap) {
        const auto bin = static_cast<std::size_t>((u - *least) / width);
        density[std::min(bin, bins - 1)] += 1.0 / (width * static_cast<double>(gap.size()));
    }
    io::write_described(file, group + "/gap_edges", {bins + 1}, edge);
    io::write_described(file, group + "/gap_density", {bins}, density);
}

void write_fields(io::Hdf5File& file, io::PayloadReader record) {
    const auto name_length = record.get<std::uint64_t>();
    const auto name = record.get<char>(name_length);
    const std::string first = "/fields/" + std::string(name.begin(), name.end());
    std::string group = first; // a path of several cycles comes to a state of this name again
    for (int n = 2; file.exists(group); ++n)
        group = first + "-" + std::to_string(n);
    const auto n = record.get<std::uint64_t>();
    const auto reference_height = record.get<double>();
    const auto slide_x = record.get<double>(), slide_y = record.get<double>();
    std::vector<double> gap;
    for (const char* map : map_columns) {
        const std::vector<double> values = record.get<double>(n * n);
        io::write_described(file, group + "/" + map, {n, n}, values);
        if (gap.empty()) gap = values;
    }
    io::write_described(file, group + "/contact", {n, n}, record.get<std::uint8_t>(n * n));
    io::write_described_attribute(file, group, "reference_height", reference_height);
    if (slide_x != 0.0 || slide_y != 0.0) {
        io::write_described_attribute(file, group, "slide_x", slide_x);
        io::write_described_attribute(file, group, "slide_y", slide_y);
    }
    write_gap_density(file, group, gap);
}

io::H5mdFrame frame_of(io::PayloadReader record) {
    const auto particles = record.get<std::uint64_t>();
    const bool velocities = record.get<std::uint64_t>() != 0;
    io::H5mdFrame frame;
    for (double& edge : frame.edges)
        edge = record.get<double>();
    frame.step = record.get<std::int64_t>();
    frame.time = record.get<double>();
    frame.position = record.get<float>(3 * particles);
    frame.velocity = record.get<float>(velocities ? 3 * particles : 0);
    return frame;
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

void Recorder::row(const StepRecord& record, std::size_t segment, int sites) {
    const SeriesRow row{record, static_cast<double>(segment), static_cast<double>(sites) * sites};
    ++rows_;
    communicator_.on_root([&] {
        for (const SeriesColumn* c : columns_)
            waiting_.push_back(c->value(row));
        if (rows_ % rows_in_memory == 0) append_rows();
    });
}

void Recorder::append_rows() {
    if (waiting_.empty()) return;
    journal_->append(rows_record, std::as_bytes(std::span(std::as_const(waiting_))));
    waiting_.clear();
}

void Recorder::fields(const std::string& state, const VectorPlane<const double>& layer,
                      const ProcessGrid& grid, const Interface& interface,
                      double reference_height) {
    const io::PayloadWriter record =
        record_of_fields(state, layer, communicator_, grid, interface, reference_height);
    communicator_.on_root([&] { journal_->append(fields_record, record.bytes()); });
}

io::PayloadWriter Recorder::record_of_fields(const std::string& state,
                                             const VectorPlane<const double>& layer,
                                             const Communicator& ranks, const ProcessGrid& grid,
                                             const Interface& interface, double reference_height) {
    const InterfaceMaps maps = interface.maps(layer, reference_height);
    const auto sites = static_cast<std::size_t>(grid.tile(0).sites);
    io::PayloadWriter record;
    ranks.on_root([&] {
        record.reserve(64 + state.size() + 49 * sites * sites);
        record.put<std::uint64_t>(state.size());
        record.put(std::span<const char>(state));
        record.put(static_cast<std::uint64_t>(sites));
        record.put(reference_height);
        for (const double at : interface.place())
            record.put(at);
    });
    const auto put = [&](const std::vector<double>& column) { // one at a time: they are large
        ranks.on_root([&] { record.put(column); });
    };
    for (const auto* map : {&maps.gap, &maps.pressure, &maps.distance})
        put(whole(ranks, grid, *map));
    for (const auto& component : {layer.x, layer.y, layer.z})
        put(gather_plane(ranks, grid, 0, component));
    const auto touching = whole(ranks, grid, {maps.contact.begin(), maps.contact.end()});
    ranks.on_root([&] { record.put(std::vector<std::uint8_t>(touching.begin(), touching.end())); });
    return record;
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
                (static_cast<double>(i / sites) + 0.5) * block.spacing, path.reference_height()};
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
        io::PayloadWriter record;
        record.put(static_cast<std::uint64_t>(sites * sites));
        record.put<std::uint64_t>(velocities ? 1 : 0);
        for (const double length : {edge, edge, height})
            record.put(length);
        record.put<std::int64_t>(now.step);
        record.put(now.time * 1e-3);
        record.put(position);
        record.put(velocity);
        journal_->append(frame_record, record.bytes());
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

/// run.h5 anew, from all records. Root only.
void Recorder::build() {
    const Clock::time_point start = Clock::now();
    io::Hdf5File file({directory_, "run.h5"}, io::Hdf5File::Mode::create);
    io::write_h5md_head(file);
    write_substrate(file, surface_);
    journal_->replay([&](std::uint64_t kind, io::Bytes payload) {
        io::PayloadReader record(payload);
        if (kind == fields_record)
            write_fields(file, record);
        else if (kind == frame_record)
            io::append_h5md(file, frame_of(record));
    });
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
        io::PayloadReader record(payload);
        while (kind == rows_record && !record.at_end())
            for (std::vector<double>* column : columns)
                column->push_back(record.get<double>());
    });
    return all;
}

void Recorder::remove_journal() { directory_.remove(io::run_file::journal); }

} // namespace asperity
