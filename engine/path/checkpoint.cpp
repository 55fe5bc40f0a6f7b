// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/path/checkpoint.hpp"

#include "decomposition/plane_bands.hpp"
#include "io/error.hpp"
#include "io/hdf5_file.hpp"
#include "io/json.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <type_traits>
#include <utility>
#include <variant>

namespace asperity {

namespace {

constexpr int format_version = 4;

/// Numbers of one type: their names, a line each, and their values.
template <class T>
struct NumberList {
    std::vector<std::uint8_t> names;
    std::vector<T> values;
};
/// Numbers in the form in which they are written and sent to other ranks.
struct NumberLists {
    NumberList<double> numbers;
    NumberList<std::int64_t> integers;

    NumberLists() = default;
    explicit NumberLists(const StateNumbers& from) {
        const auto add = [](auto& list, const std::string& name, auto value) {
            list.names.insert(list.names.end(), name.begin(), name.end());
            list.names.push_back('\n');
            list.values.push_back(value);
        };
        for (const auto& [name, value] : from)
            if (const double* number = std::get_if<double>(&value))
                add(numbers, name, *number);
            else
                add(integers, name, std::get<std::int64_t>(value));
    }
    explicit NumberLists(const io::Hdf5File& file) {
        each([&](const std::string& set, auto& list) {
            using T = typename std::remove_reference_t<decltype(list.values)>::value_type;
            if (!file.exists(set)) return;
            list.names = file.read<std::uint8_t>(set + "_names");
            if (file.shape(set) != io::Hdf5File::Shape{static_cast<std::uint64_t>(
                                       std::count(list.names.begin(), list.names.end(), '\n'))})
                throw io::FileError(file.path(), "is damaged",
                                    "its numbers are not as many as their names",
                                    "take a copy that is whole");
            list.values = file.read<T>(set);
        });
    }
    void write(io::Hdf5File& file) {
        each([&]<class T>(const std::string& set, const NumberList<T>& list) {
            if (list.values.empty()) return;
            file.write<T>(set, {list.values.size()}, list.values);
            file.write<std::uint8_t>(set + "_names", {list.names.size()}, list.names);
        });
    }
    void broadcast(const Communicator& ranks) {
        each([&](const std::string&, auto& list) {
            std::uint64_t sizes[2] = {list.names.size(), list.values.size()};
            ranks.broadcast(std::as_writable_bytes(std::span(sizes)));
            list.names.resize(sizes[0]);
            list.values.resize(sizes[1]);
            ranks.broadcast(std::as_writable_bytes(std::span(list.names)));
            ranks.broadcast(std::as_writable_bytes(std::span(list.values)));
        });
    }
    StateNumbers by_name() {
        StateNumbers all;
        each([&](const std::string&, auto& list) {
            auto from = list.names.begin();
            for (const auto value : list.values) {
                const auto to = std::find(from, list.names.end(), '\n');
                all[std::string(from, to)] = value;
                from = to + 1;
            }
        });
        return all;
    }

private:
    template <class Do>
    void each(const Do& action) {
        action("/numbers", numbers);
        action("/integers", integers);
    }
};

} // namespace

std::vector<StateArray> state_of(const Block& block) {
    std::vector<StateArray> list;
    for (const Block::Level& level : block.levels()) {
        add_arrays(level.shape.level, "u", level.u, level.shape.cells, list);
        add_arrays(level.shape.level, "v", level.v, level.shape.cells, list);
    }
    return list;
}

std::vector<RestoredArray> state_to_restore(Block& block) {
    std::vector<RestoredArray> list;
    for (const Block::Level& level : block.levels()) {
        const Block::Fields fields = block.fields(level);
        add_arrays(level.shape.level, "u", fields.u, level.shape.cells, list);
        add_arrays(level.shape.level, "v", fields.v, level.shape.cells, list);
    }
    return list;
}

namespace {

/// Returns the first index of a band of a plane in the data set of an array.
io::Hdf5File::Shape place_of(int plane, int first_row) {
    return {static_cast<std::uint64_t>(plane), static_cast<std::uint64_t>(first_row), 0};
}

} // namespace

void write_checkpoint(const io::FilePlace& place, const Communicator& ranks,
                      const ProcessGrid& grid, const std::vector<StateArray>& arrays,
                      const StateNumbers& numbers, const std::string& fingerprint) {
    std::unique_ptr<io::Hdf5File> file;
    ranks.on_root([&] {
        file = std::make_unique<io::Hdf5File>(place, io::Hdf5File::Mode::create);
        file->write_attribute("/", "asperity_checkpoint", std::int64_t{format_version});
        file->write_attribute("/", "scene", fingerprint);
        NumberLists(numbers).write(*file);
    });
    for (const StateArray& array : arrays) {
        const auto sites = static_cast<std::uint64_t>(grid.tile(array.level).sites);
        ranks.on_root([&] {
            file->make_dataset<double>(array.name,
                                       {static_cast<std::uint64_t>(array.planes), sites, sites});
        });
        for (int z = 0; z < array.planes; ++z) {
            const PlaneView<const double> plane = array.field->plane(z);
            gather_bands(ranks, grid, array.level, std::span(&plane, 1),
                         [&](int first, std::span<const double> band) {
                             file->write_slab<double>(array.name, place_of(z, first),
                                                      {1, band.size() / sites, sites}, band);
                         });
        }
    }
    ranks.on_root([&] { file->close(); });
}

namespace {

io::Hdf5File open_checkpoint(const io::FilePlace& place) {
    io::Hdf5File file(place, io::Hdf5File::Mode::read);
    const std::optional<double> version = file.number_attribute("/", "asperity_checkpoint");
    if (!version)
        throw io::FileError(file.path(), "is not a checkpoint",
                            "it lacks the attribute asperity_checkpoint",
                            "give the checkpoint.h5 of a run's result directory");
    if (*version != format_version)
        throw io::FileError(file.path(), "has another checkpoint format",
                            "it was written by another version", "run the scene from its start");
    return file;
}

/// Returns the keys, as section.key, in which two fingerprints differ.
std::string differing_keys(const io::Json& one, const io::Json& other) {
    std::set<std::string> keys;
    for (const auto& [a, b] : {std::pair{&one, &other}, std::pair{&other, &one}})
        for (const auto& [section, values] : a->items())
            for (const auto& [key, value] : values.items())
                if (!b->contains(section) || !(*b)[section].contains(key) ||
                    (*b)[section][key] != value)
                    keys.insert(fmt::format("{}.{}", section, key));
    return fmt::format("{}", fmt::join(keys, ", "));
}

} // namespace

StateNumbers read_checkpoint_numbers(const io::FilePlace& place) {
    return NumberLists(open_checkpoint(place)).by_name();
}

StateNumbers read_checkpoint(const io::FilePlace& place, const Communicator& ranks,
                             const ProcessGrid& grid, const ArraysOf& arrays,
                             const std::string& fingerprint) {
    std::unique_ptr<io::Hdf5File> file;
    NumberLists lists;
    ranks.on_root([&] {
        file = std::make_unique<io::Hdf5File>(open_checkpoint(place));
        const std::optional<std::string> scene = file->text_attribute("/", "scene");
        if (!scene)
            throw io::FileError(file->path(), "is not a checkpoint", "it lacks the attribute scene",
                                "name another file, or run the scene again");
        const std::string& its = *scene;
        if (its != fingerprint)
            throw io::SceneError({file->path(), "belongs to another scene",
                                  "this scene differs from it in " +
                                      differing_keys(io::parse_json(its, file->path()),
                                                     io::parse_json(fingerprint, "this scene")),
                                  "give the scene it was made with, or start without --resume"});
        lists = NumberLists(*file);
    });
    lists.broadcast(ranks);
    StateNumbers numbers = lists.by_name();
    for (const RestoredArray& array : arrays(numbers)) {
        const auto sites = static_cast<std::uint64_t>(grid.tile(array.level).sites);
        for (int z = 0; z < array.planes; ++z) {
            scatter_bands(
                ranks, grid, array.level,
                [&](int first, std::span<double> band) {
                    file->read_slab<double>(array.name, place_of(z, first),
                                            {1, band.size() / sites, sites}, band);
                },
                array.field->plane(z));
        }
    }
    return numbers;
}

} // namespace asperity
