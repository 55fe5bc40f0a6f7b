// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/run/checkpoint.hpp"

#include "io/error.hpp"
#include "io/hdf5_file.hpp"
#include "io/json.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <set>
#include <span>
#include <utility>

namespace asperity {

namespace {

constexpr int format_version = 2;

/// Displacements and half-step velocities of each level.
std::vector<StateArray> fields_of(Block& block) {
    std::vector<StateArray> list;
    for (const Block::Level& level : block.levels()) {
        const int n = level.shape.level, planes = level.shape.cells;
        const Block::Fields fields = block.fields(level);
        add_arrays(n, "u", fields.u, planes, list);
        add_arrays(n, "v", fields.v, planes, list);
    }
    return list;
}

/// A list of arrays is for both ways; who gets this one only reads.
std::vector<StateArray> fields_to_read(const Simulation& simulation) {
    return fields_of(const_cast<Block&>(simulation.block()));
}

std::vector<StateArray> joined(std::vector<StateArray> list, const std::vector<StateArray>& more) {
    list.insert(list.end(), more.begin(), more.end());
    return list;
}

} // namespace

double RestoreScalars::next(const char* name) {
    if (at >= values.size() || values[at].first != name)
        throw io::FileError(
            "checkpoint", fmt::format("has no number \"{}\" where it is expected", name),
            "it was written by another version of the program", "run the scene from its start");
    return values[at++].second;
}

double RestoreScalars::next_integer(const char* name, double least, double most) {
    const double value = next(name);
    if (!(value >= least && value <= most) || value != std::trunc(value))
        throw io::FileError(
            "checkpoint", fmt::format("has the number \"{}\" = {:.17g}", name, value),
            fmt::format("an integer from {:.17g} to {:.17g} is expected", least, most),
            "run the scene from its start");
    return value;
}

void write_checkpoint(const io::FilePlace& place, const Communicator& ranks,
                      const ProcessGrid& grid, const std::vector<StateArray>& arrays,
                      const RunScalars& scalars, const std::string& fingerprint) {
    std::unique_ptr<io::Hdf5File> file;
    ranks.on_root([&] {
        file = std::make_unique<io::Hdf5File>(place, io::Hdf5File::Mode::create);
        file->write_attribute("/", "asperity_checkpoint", std::int64_t{format_version});
        file->write_attribute("/", "scene", fingerprint);
        std::string names;
        std::vector<double> values;
        for (const auto& [name, value] : scalars)
            names += name + "\n", values.push_back(value);
        file->write_attribute("/", "scalar_names", names);
        file->write<double>("/scalars", {values.size()}, values);
    });
    for (const StateArray& array : arrays) {
        const auto sites = static_cast<std::uint64_t>(grid.tile(array.level).sites);
        ranks.on_root([&] {
            file->make_dataset<double>(array.name,
                                       {static_cast<std::uint64_t>(array.planes), sites, sites});
        });
        for (int z = 0; z < array.planes; ++z) {
            const auto dense =
                gather_plane(ranks, grid, array.level, std::as_const(*array.field).plane(z));
            ranks.on_root([&] {
                file->write_slab<double>(array.name, {static_cast<std::uint64_t>(z), 0, 0},
                                         {1, sites, sites}, std::span<const double>(dense));
            });
        }
    }
    ranks.on_root([&] { file->close(); });
}

namespace {

io::Hdf5File open_checkpoint(const io::FilePlace& place) {
    io::Hdf5File file(place, io::Hdf5File::Mode::read);
    if (!file.has_attribute("/", "asperity_checkpoint"))
        throw io::FileError(file.path(), "is not a checkpoint",
                            "it lacks the attribute asperity_checkpoint",
                            "give the checkpoint.h5 of a run's result directory");
    if (file.read_attribute<std::int64_t>("/", "asperity_checkpoint") != format_version ||
        !file.sealed())
        throw io::FileError(file.path(), "has another checkpoint format",
                            "it was written by another version", "run the scene from its start");
    return file;
}

/// The scalars' names, one a line, and values, as many of each.
struct NamedValues {
    NamedValues() = default;
    explicit NamedValues(const io::Hdf5File& file)
        : names(file.read_text_attribute("/", "scalar_names")) {
        const auto lines = static_cast<std::uint64_t>(std::count(names.begin(), names.end(), '\n'));
        if (file.shape("/scalars") != io::Hdf5File::Shape{lines})
            throw io::FileError(file.path(), "is damaged",
                                "its numbers are not as many as their names",
                                "take a copy that is whole");
        values = file.read<double>("/scalars");
    }
    RunScalars scalars() const {
        RunScalars scalars;
        std::size_t from = 0;
        for (double value : values) {
            const auto to = names.find('\n', from);
            scalars.emplace_back(names.substr(from, to - from), value);
            from = to + 1;
        }
        return scalars;
    }

    std::string names;
    std::vector<double> values;
};

/// The keys, as section.key, in which two fingerprints differ.
std::string differing_keys(const io::Json& one, const io::Json& other) {
    std::set<std::string> keys;
    for (const auto& [a, b] : {std::pair{&one, &other}, std::pair{&other, &one}})
        for (const auto& [section, values] : a->items())
            for (const auto& [key, value] : values.items())
                if (!b->contains(section) || !(*b)[section].contains(key) ||
                    (*b)[section][key] != value)
                    keys.insert(section + "." + key);
    return fmt::format("{}", fmt::join(keys, ", "));
}

} // namespace

RunScalars read_checkpoint_scalars(const io::FilePlace& place) {
    return NamedValues(open_checkpoint(place)).scalars();
}

RunScalars read_checkpoint(const io::FilePlace& place, const Communicator& ranks,
                           const ProcessGrid& grid, const std::vector<StateArray>& arrays,
                           const std::string& fingerprint) {
    std::unique_ptr<io::Hdf5File> file;
    NamedValues named;
    std::int64_t sizes[2] = {0, 0};
    ranks.on_root([&] {
        file = std::make_unique<io::Hdf5File>(open_checkpoint(place));
        if (const std::string its = file->read_text_attribute("/", "scene"); its != fingerprint)
            throw io::SceneError({file->path(), "belongs to another scene",
                                  "this scene differs from it in " +
                                      differing_keys(io::parse_json(its, file->path()),
                                                     io::parse_json(fingerprint, "this scene")),
                                  "give the scene it was made with, or start without --resume"});
        named = NamedValues(*file);
        sizes[0] = static_cast<std::int64_t>(named.names.size());
        sizes[1] = static_cast<std::int64_t>(named.values.size());
    });
    ranks.broadcast(std::as_writable_bytes(std::span(sizes)));
    named.names.resize(static_cast<std::size_t>(sizes[0]));
    named.values.resize(static_cast<std::size_t>(sizes[1]));
    ranks.broadcast(std::as_writable_bytes(std::span(named.names)));
    ranks.broadcast(std::span<double>(named.values));
    for (const StateArray& array : arrays) {
        const auto sites = static_cast<std::uint64_t>(grid.tile(array.level).sites);
        for (int z = 0; z < array.planes; ++z) {
            std::vector<double> dense;
            ranks.on_root([&] {
                dense.resize(sites * sites);
                file->read_slab<double>(array.name, {static_cast<std::uint64_t>(z), 0, 0},
                                        {1, sites, sites}, std::span<double>(dense));
            });
            scatter_plane(ranks, grid, array.level, dense, array.field->plane(z));
        }
    }
    return named.scalars();
}

void write_checkpoint(const io::FilePlace& place, Simulation& simulation, const RunScalars& scalars,
                      const std::string& fingerprint, const std::vector<StateArray>& run_arrays) {
    CollectScalars collect;
    simulation.visit(collect);
    for (const auto& [name, value] : scalars)
        collect.values.emplace_back("run." + name, value);
    write_checkpoint(place, simulation.communicator(), simulation.block().grid(),
                     joined(fields_to_read(simulation), run_arrays), collect.values, fingerprint);
}

RunScalars read_checkpoint(const io::FilePlace& place, Simulation& simulation,
                           const std::string& fingerprint,
                           const std::vector<StateArray>& run_arrays) {
    Block& block = simulation.block_to_write();
    const RunScalars scalars = read_checkpoint(place, simulation.communicator(), block.grid(),
                                               joined(fields_of(block), run_arrays), fingerprint);
    RestoreScalars restore{scalars};
    simulation.visit(restore);
    block.exchange();
    RunScalars run;
    for (std::size_t i = restore.at; i < scalars.size(); ++i)
        run.emplace_back(scalars[i].first.substr(std::strlen("run.")), scalars[i].second);
    return run;
}

void Snapshot::take(Simulation& simulation) {
    fields_.take(fields_to_read(simulation));
    CollectScalars collect;
    simulation.visit(collect);
    scalars_ = std::move(collect.values);
    step_ = simulation.steps();
}

void Snapshot::restore(Simulation& simulation) const {
    fields_.restore(fields_of(simulation.block_to_write()));
    RestoreScalars restore{scalars_};
    simulation.visit(restore);
}

} // namespace asperity
