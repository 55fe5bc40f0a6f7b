// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/checkpoint.hpp"

#include "io/error.hpp"
#include "io/hdf5_file.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <span>

namespace asperity {

namespace {

constexpr int format_version = 1;

/// Visitors of Simulation::visit: every scalar as a double by name. Integers below 2^53 are kept
/// exactly.
struct Collect {
    std::vector<std::pair<std::string, double>> values;
    template <class T>
    void operator()(const char* name, T& value) {
        values.emplace_back(name, static_cast<double>(value));
    }
};

struct Restore {
    const std::vector<std::pair<std::string, double>>& values;
    std::size_t at = 0;
    template <class T>
    void operator()(const char* name, T& value) {
        if (at >= values.size() || values[at].first != name)
            throw io::FileError(
                "checkpoint", fmt::format("has no number \"{}\" where it is expected", name),
                "it was written by another version of the program", "run the scene from its start");
        value = static_cast<T>(values[at++].second);
    }
};

std::string dataset(int level, const char* what) { return fmt::format("/level{}/{}", level, what); }

/// Calls work(dataset name, field, planes) for the six arrays of each level.
template <class Work>
void each_field(Simulation& simulation, const Work& work) {
    for (auto& level : simulation.block().levels()) {
        const int n = level.plan.level, planes = level.plan.cells;
        work(n, dataset(n, "u_x"), level.u.x, planes);
        work(n, dataset(n, "u_y"), level.u.y, planes);
        work(n, dataset(n, "u_z"), level.u.z, planes);
        work(n, dataset(n, "v_x"), level.v.x, planes);
        work(n, dataset(n, "v_y"), level.v.y, planes);
        work(n, dataset(n, "v_z"), level.v.z, planes);
    }
}

} // namespace

void write_checkpoint(const std::string& path, Simulation& simulation, const RunScalars& scalars,
                      const std::string& fingerprint) {
    const Communicator& ranks = simulation.communicator();
    const ProcessGrid& grid = simulation.block().grid();
    const std::string temporary = path + ".part";
    std::unique_ptr<io::Hdf5File> file;
    ranks.on_root([&] {
        file = std::make_unique<io::Hdf5File>(temporary, io::Hdf5File::Mode::create);
        file->write_attribute("/", "asperity_checkpoint", std::int64_t{format_version});
        file->write_attribute("/", "scene", fingerprint);
        Collect collect;
        simulation.visit(collect);
        for (const auto& [name, value] : scalars)
            collect.values.emplace_back("run." + name, value);
        std::string names;
        std::vector<double> values;
        for (const auto& [name, value] : collect.values)
            names += name + "\n", values.push_back(value);
        file->write_attribute("/", "scalar_names", names);
        file->write<double>("/scalars", {values.size()}, values);
        for (const auto& level : simulation.block().levels())
            file->make_group(fmt::format("/level{}", level.plan.level));
    });
    each_field(simulation, [&](int level, const std::string& name, Field<double>& field,
                               int planes) {
        const auto sites = static_cast<std::uint64_t>(grid.tile(level).sites);
        ranks.on_root([&] {
            file->make_dataset<double>(name, {static_cast<std::uint64_t>(planes), sites, sites});
        });
        for (int z = 0; z < planes; ++z) {
            const auto dense = gather_plane(ranks, grid, level, std::as_const(field).plane(z));
            ranks.on_root([&] {
                file->write_slab<double>(name, {static_cast<std::uint64_t>(z), 0, 0},
                                         {1, sites, sites}, std::span<const double>(dense));
            });
        }
    });
    ranks.on_root([&] {
        file->close();
        std::error_code failed;
        std::filesystem::rename(temporary, path, failed);
        if (failed)
            throw io::FileError(path, "cannot be put in place", failed.message(),
                                "the checkpoint is in " + temporary);
    });
}

RunScalars read_checkpoint(const std::string& path, Simulation& simulation,
                           const std::string& fingerprint) {
    const Communicator& ranks = simulation.communicator();
    const ProcessGrid& grid = simulation.block().grid();
    std::unique_ptr<io::Hdf5File> file;
    std::string names;
    std::vector<double> values;
    std::int64_t sizes[2] = {0, 0};
    ranks.on_root([&] {
        file = std::make_unique<io::Hdf5File>(path, io::Hdf5File::Mode::read);
        if (!file->has_attribute("/", "asperity_checkpoint"))
            throw io::FileError(path, "is not a checkpoint",
                                "it lacks the attribute asperity_checkpoint",
                                "give the checkpoint.h5 of a run's result directory");
        if (file->read_integer_attribute("/", "asperity_checkpoint") != format_version)
            throw io::FileError(path, "has another checkpoint format",
                                "it was written by another version",
                                "run the scene from its start");
        if (file->read_text_attribute("/", "scene") != fingerprint)
            throw io::SceneError(
                {path, "belongs to another scene",
                 "the physics of this scene differs from the one that wrote the checkpoint",
                 "give the scene it was made with, or start without --resume"});
        names = file->read_text_attribute("/", "scalar_names");
        values = file->read<double>("/scalars");
        sizes[0] = static_cast<std::int64_t>(names.size());
        sizes[1] = static_cast<std::int64_t>(values.size());
    });
    ranks.broadcast(std::as_writable_bytes(std::span(sizes)));
    names.resize(static_cast<std::size_t>(sizes[0]));
    values.resize(static_cast<std::size_t>(sizes[1]));
    ranks.broadcast(std::as_writable_bytes(std::span(names)));
    ranks.broadcast(std::span<double>(values));

    std::vector<std::pair<std::string, double>> scalars;
    std::size_t from = 0;
    for (double value : values) {
        const auto to = names.find('\n', from);
        scalars.emplace_back(names.substr(from, to - from), value);
        from = to + 1;
    }
    Restore restore{scalars};
    simulation.visit(restore);

    each_field(simulation,
               [&](int level, const std::string& name, Field<double>& field, int planes) {
                   const auto sites = static_cast<std::uint64_t>(grid.tile(level).sites);
                   for (int z = 0; z < planes; ++z) {
                       std::vector<double> dense;
                       ranks.on_root([&] {
                           dense.resize(sites * sites);
                           file->read_slab<double>(name, {static_cast<std::uint64_t>(z), 0, 0},
                                                   {1, sites, sites}, std::span<double>(dense));
                       });
                       scatter_plane(ranks, grid, level, dense, field.plane(z));
                   }
               });
    simulation.block().exchange();

    RunScalars run;
    for (std::size_t i = restore.at; i < scalars.size(); ++i)
        run.emplace_back(scalars[i].first.substr(std::strlen("run.")), scalars[i].second);
    return run;
}

void Snapshot::take(Simulation& simulation) {
    const auto& levels = simulation.block().levels();
    if (levels_.empty())
        for (const auto& level : levels)
            levels_.push_back({VectorField<double>(level.tile, level.plan.cells + 1),
                               VectorField<double>(level.tile, level.plan.cells)});
    for (std::size_t l = 0; l < levels.size(); ++l) {
        levels_[l].u.copy_from(levels[l].u);
        levels_[l].v.copy_from(levels[l].v);
    }
    Collect collect;
    simulation.visit(collect);
    scalars_.clear();
    for (const auto& [name, value] : collect.values)
        scalars_.push_back(value);
    step_ = simulation.steps();
}

std::size_t Snapshot::bytes() const {
    std::size_t total = 0;
    for (const LevelState& level : levels_)
        total += level.u.bytes() + level.v.bytes();
    return total;
}

void Snapshot::restore(Simulation& simulation) const {
    Collect names;
    simulation.visit(names);
    for (std::size_t i = 0; i < scalars_.size(); ++i)
        names.values[i].second = scalars_[i];
    Restore restore{names.values};
    simulation.visit(restore);
    auto& levels = simulation.block().levels();
    for (std::size_t l = 0; l < levels.size(); ++l) {
        levels[l].u.copy_from(levels_[l].u);
        levels[l].v.copy_from(levels_[l].v);
    }
}

} // namespace asperity
