// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/run/recorder.hpp"

#include "io/build_info.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace asperity {

namespace {

/// What a row is made of.
struct Row {
    const StepRecord& r;
    bool pulling;
    double sites; ///< N^2
};

enum class In { both, dynamic, quasistatic };

struct RecordColumn {
    io::Column column;
    In in;
    double (*value)(const Row&);
};

const RecordColumn record_columns[] = {
    {{"step", "", "time step; of a quasi-static path: point"},
     In::both,
     [](const Row& w) { return static_cast<double>(w.r.step); }},
    {{"time", "ps", "simulated time"}, In::dynamic, [](const Row& w) { return w.r.time * 1e-3; }},
    {{"leg", "", "0 approach, 1 pull-off"},
     In::both,
     [](const Row& w) { return w.pulling ? 1.0 : 0.0; }},
    {{"top", "Å", "displacement of the top plane"}, In::both, [](const Row& w) { return w.r.top; }},
    {{"mean_height", "Å", "mean height of the lowest layer above the substrate's mean plane"},
     In::both,
     [](const Row& w) { return w.r.mean_height; }},
    {{"force", "eV/Å", "total normal force of the substrate on the lowest layer; positive pushes"},
     In::both,
     [](const Row& w) { return w.r.force; }},
    {{"top_force", "eV/Å", "elastic force on the top plane along z"},
     In::both,
     [](const Row& w) { return w.r.top_force; }},
    {{"interface_energy", "eV", "Lennard-Jones energy"},
     In::both,
     [](const Row& w) { return w.r.interface_energy; }},
    {{"elastic_energy", "eV", "elastic energy of the block"},
     In::both,
     [](const Row& w) { return w.r.elastic_energy; }},
    {{"kinetic_energy", "eV", "kinetic energy of the block"},
     In::dynamic,
     [](const Row& w) { return w.r.kinetic_energy; }},
    {{"work", "eV", "work done on the block since the start"},
     In::both,
     [](const Row& w) { return w.r.work; }},
    {{"damped", "eV", "energy damped since the start"},
     In::dynamic,
     [](const Row& w) { return w.r.damped; }},
    {{"dissipated", "eV", "energy lost where the block became unstable, since the start"},
     In::quasistatic,
     [](const Row& w) { return w.r.damped; }},
    {{"residual", "", "energy balance: (work - change of energy - loss) over the largest term"},
     In::both,
     [](const Row& w) { return w.r.residual; }},
    {{"contact_fraction", "", "sites closer than the inflection of the potential to an atom"},
     In::both,
     [](const Row& w) { return static_cast<double>(w.r.in_contact) / w.sites; }},
    {{"pushed_fraction", "", "sites whose net normal force is repulsive"},
     In::both,
     [](const Row& w) { return static_cast<double>(w.r.pushed) / w.sites; }},
    {{"closest", "Å", "smallest distance between a site and an atom; infinite out of reach"},
     In::both,
     [](const Row& w) { return w.r.closest; }},
};

bool is_in(const RecordColumn& c, DriveMode mode) {
    return c.in == In::both || (c.in == In::dynamic) == (mode == DriveMode::dynamic);
}

std::vector<io::Column> columns(DriveMode mode) {
    std::vector<io::Column> list;
    for (const RecordColumn& c : record_columns)
        if (is_in(c, mode)) list.push_back(c.column);
    return list;
}

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

} // namespace

Recorder::Recorder(const std::string& path, const Surface& surface,
                   const Communicator& communicator, DriveMode mode, bool resume,
                   std::uint64_t rows)
    : communicator_(communicator), mode_(mode), rows_(resume ? rows : 0) {
    communicator_.on_root([&] {
        if (resume) {
            file_ = std::make_unique<io::Hdf5File>(path, io::Hdf5File::Mode::edit);
            series_ = io::Series::reopen(*file_, "/series", columns(mode), rows);
            return;
        }
        file_ = std::make_unique<io::Hdf5File>(path, io::Hdf5File::Mode::create);
        io::write_h5md_head(*file_, io::build_info().version);
        series_ = io::Series(*file_, "/series", columns(mode));
        const auto n = static_cast<std::uint64_t>(surface.sites);
        file_->make_group("/substrate");
        file_->write<double>("/substrate/height", {n, n}, surface.height);
        file_->write_attribute("/substrate/height", "unit", "Å");
        file_->write_attribute("/substrate", "edge", surface.length);
        std::vector<double> q, realised, target;
        for (const SpectrumBin& bin : surface.statistics.spectrum) {
            q.push_back(bin.q);
            realised.push_back(bin.realised);
            target.push_back(bin.target);
        }
        if (!q.empty()) {
            file_->write<double>("/substrate/spectrum_q", {q.size()}, q);
            file_->write<double>("/substrate/spectrum", {q.size()}, realised);
            file_->write<double>("/substrate/spectrum_target", {q.size()}, target);
        }
        file_->flush();
    });
}

void Recorder::row(const StepRecord& record, bool pulling, int sites) {
    const Row row{record, pulling, static_cast<double>(sites) * sites};
    ++rows_;
    communicator_.on_root([&] {
        std::vector<double> values;
        for (const RecordColumn& c : record_columns)
            if (is_in(c, mode_)) values.push_back(c.value(row));
        series_.append(std::span<const double>(values));
    });
}

void Recorder::fields(const std::string& state, const VectorPlane<const double>& layer,
                      const ProcessGrid& grid, const Interface& interface,
                      double reference_height) {
    const InterfaceMaps maps = interface.maps(layer, reference_height);
    std::vector<double> contact(maps.contact.begin(), maps.contact.end());
    const auto gap = whole(communicator_, grid, maps.gap);
    const auto pressure = whole(communicator_, grid, maps.pressure);
    const auto distance = whole(communicator_, grid, maps.distance);
    const auto touching = whole(communicator_, grid, contact);
    const auto ux = gather_plane(communicator_, grid, 0, layer.x);
    const auto uy = gather_plane(communicator_, grid, 0, layer.y);
    const auto uz = gather_plane(communicator_, grid, 0, layer.z);
    communicator_.on_root([&] {
        const std::string group = "/fields/" + state;
        if (file_->exists(group)) file_->remove(group); // of an earlier such state
        file_->make_group(group);
        const auto n = static_cast<std::uint64_t>(grid.tile(0).sites);
        const auto write = [&](const char* name, const char* unit, const std::vector<double>& map) {
            file_->write<double>(group + "/" + name, {n, n}, map);
            file_->write_attribute(group + "/" + name, "unit", unit);
        };
        write("gap", "Å", gap);
        write("pressure", "GPa", pressure);
        write("distance", "Å", distance);
        write("u_x", "Å", ux);
        write("u_y", "Å", uy);
        write("u_z", "Å", uz);
        file_->write<std::uint8_t>(group + "/contact", {n, n},
                                   std::vector<std::uint8_t>(touching.begin(), touching.end()));
        file_->write_attribute(group, "reference_height", reference_height);

        // P(u), normalised to one: 200 bins from the least to the greatest gap.
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
        file_->write<double>(group + "/gap_edges", {bins + 1}, edge);
        file_->write<double>(group + "/gap_density", {bins}, density);
        file_->flush();
    });
}

void Recorder::begin_trajectory(const Simulation& simulation, bool velocities) {
    velocities_ = velocities;
    communicator_.on_root([&] {
        const auto& block = simulation.options().block;
        const auto n = static_cast<std::uint64_t>(block.sites);
        const double edge = block.sites * block.spacing;
        const double height = 2.0 * simulation.interface().start_height() + // room for both ends
                              block.thickness * block.spacing;
        trajectory_.emplace(*file_, n * n, std::array{edge, edge, height}, velocities,
                            simulation.steps());
    });
}

void Recorder::frame(const Simulation& simulation) {
    const Block::Level& level = simulation.block().levels().front();
    const ProcessGrid& grid = simulation.block().grid();
    const auto whole_layer = [&](const VectorPlane<const double>& plane) {
        return std::array{gather_plane(communicator_, grid, 0, plane.x),
                          gather_plane(communicator_, grid, 0, plane.y),
                          gather_plane(communicator_, grid, 0, plane.z)};
    };
    const auto u = whole_layer(level.u.view()[0]);
    std::array<std::vector<double>, 3> v;
    if (velocities_) v = whole_layer(level.v.view()[0]);
    communicator_.on_root([&] {
        const auto& block = simulation.options().block;
        const auto sites = static_cast<std::size_t>(block.sites);
        std::vector<float> position(3 * sites * sites), velocity;
        for (std::size_t i = 0; i < sites * sites; ++i) {
            // Sites stand over the hollows of the substrate (docs/model.md).
            const std::array<double, 3> rest = {
                (static_cast<double>(i % sites) + 0.5) * block.spacing,
                (static_cast<double>(i / sites) + 0.5) * block.spacing,
                simulation.reference_height()};
            for (std::size_t c = 0; c < 3; ++c)
                position[3 * i + c] = static_cast<float>(rest[c] + u[c][i]);
        }
        if (velocities_) {
            velocity.resize(position.size());
            for (std::size_t i = 0; i < sites * sites; ++i)
                for (std::size_t c = 0; c < 3; ++c)
                    velocity[3 * i + c] = static_cast<float>(1e3 * v[c][i]); // Å/fs to Å/ps
        }
        trajectory_->append(simulation.steps(), simulation.time() * 1e-3, position, velocity);
    });
}

void Recorder::flush() {
    communicator_.on_root([&] {
        series_.flush();
        file_->flush();
    });
}

} // namespace asperity
