// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "library/inside.hpp"

#include "decomposition/communicator.hpp"
#include "engine/commands/exit_code.hpp"
#include "engine/commit.hpp"
#include "engine/run/run.hpp"
#include "io/hdf5_file.hpp"
#include "io/json.hpp"
#include "io/machine.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>
#include <span>
#include <sstream>
#include <utility>

namespace libasperity {

namespace io = asperity::io;

class Result::Inside {
public:
    std::string directory;
    std::string text;
    io::Json values;

    /// Opened for each call: a result that is kept holds no file.
    io::Hdf5File file() const {
        return {io::FilePlace(directory + "/run.h5"), io::Hdf5File::Mode::read};
    }
    const io::Json& value(const std::string& name) const {
        if (const io::Json* found = io::find(values, name)) return *found;
        throw io::SceneError(
            io::Problem{directory + "/result.json", fmt::format("has no '{}'", name),
                        "the run did not compute it, or the name is misspelt",
                        "names are in docs/reference/result.md and in Result::json()"});
    }
    const std::string& checked(const io::Hdf5File& from, const std::string& object) const {
        if (from.exists(object)) return object;
        throw io::SceneError(io::Problem{from.path(), fmt::format("has no {}", object),
                                         "the run did not write it, or the name is misspelt",
                                         "output.fields of the scene chooses the maps"});
    }
    Map map(const std::string& object) const {
        const io::Hdf5File from = file();
        const auto shape = from.shape(checked(from, object));
        Map map{shape.at(0), shape.at(1), from.text_attribute(object, "unit").value_or(""),
                from.read<double>(object)};
        return map;
    }
};

namespace {

const asperity::Communicator* parallel_world = nullptr;

}

asperity::Communicator world() {
    return parallel_world ? *parallel_world : asperity::Communicator();
}

namespace {

int world_size() { return world().size(); }

/// How long an error waits for the other ranks, s.
constexpr double patience = 10.0;

[[noreturn]] void end_all(const asperity::Communicator& world, int code, const std::string& text) {
    fmt::print(stderr, "rank {}: {}\n", world.rank(), text);
    std::fflush(stderr);
    world.abort(code);
}

/// Of several ranks: an error that all meet, or the root for all of them, is thrown on all of them.
/// Any other ends them all at once, for the others may be waiting for this one
/// (engine/commands/exit_code.hpp); so does one that not all meet.
template <class Work>
auto agreed(const asperity::Communicator& world, const Work& work) {
    if (world.size() == 1) return translated(work);
    std::optional<decltype(work())> result;
    int code = io::exit_code::done;
    std::string text;
    bool root_failed = false;
    const auto fails = [&](const io::Error& error) {
        code = error.code();
        text = error.what();
        if (!world.all_come(patience))
            end_all(world, code, text + "\n    why: other ranks do not meet this, and wait for it");
    };
    try {
        result = work();
        world.all_come(HUGE_VAL);
    } catch (const io::SceneError& error) {
        fails(error);
    } catch (const io::PhysicsError& error) {
        fails(error);
    } catch (const asperity::RootFailure&) {
        root_failed = true;
        world.all_come(HUGE_VAL);
    } catch (const std::exception& error) {
        const auto* known = dynamic_cast<const io::Error*>(&error);
        const auto* ours = dynamic_cast<const Error*>(&error);
        code = known ? known->code() : ours ? ours->code() : io::exit_code::internal;
        end_all(world, code, error.what());
    }
    const double worst = world.max(code), fine = world.max(result ? 1.0 : 0.0);
    if (fine == 0.0) { // the root's code and text, on every rank
        double head[] = {static_cast<double>(code), static_cast<double>(text.size())};
        world.broadcast(std::span<double>(head));
        text.resize(static_cast<std::size_t>(head[1]));
        world.broadcast(std::as_writable_bytes(std::span<char>(text)));
        throw Error(static_cast<int>(head[0]), text);
    }
    if (worst != 0.0) {
        if (result || root_failed) text = "another rank failed, and has the reason";
        end_all(world, static_cast<int>(worst), text);
    }
    return *std::move(result);
}

std::string contents(const std::string& path) {
    std::ifstream file(path);
    std::stringstream text;
    text << file.rdbuf();
    if (!file)
        throw io::FileError(path, "cannot be read", "there is no such file, or it is empty",
                            "name the directory of a run");
    return text.str();
}

} // namespace

std::string version() { return io::build_info().version; }

Scene Scene::read(const std::string& file, const std::vector<std::string>& overrides) {
    return translated([&] {
        asperity::Case resolved = asperity::read_case(file, overrides, world_size());
        return Scene(std::make_shared<Inside>(
            Inside{std::move(resolved),
                   {contents(file), std::filesystem::absolute(file).string(), overrides}}));
    });
}

Scene Scene::parse(const std::string& text, const std::vector<std::string>& overrides,
                   const std::string& name) {
    return translated([&] {
        return Scene(std::make_shared<Inside>(
            Inside{asperity::read_case_text(text, name, overrides, world_size()),
                   {text, name, overrides}}));
    });
}

std::string Scene::name() const { return inside_->resolved.scene.name; }
std::string Scene::toml() const { return asperity::scene_toml(inside_->resolved.scene, false); }
std::vector<std::string> Scene::notes() const { return inside_->resolved.notes; }

Result Result::load(const std::string& directory) {
    return translated([&] {
        const std::string file = directory + "/result.json";
        std::string text = contents(file);
        io::Json values = io::parse_json(text, file);
        return Result(
            std::make_shared<Inside>(Inside{directory, std::move(text), std::move(values)}));
    });
}

std::string Result::directory() const { return inside_->directory; }
std::string Result::json() const { return inside_->text; }
bool Result::finished() const { return stopped().empty(); }

std::string Result::stopped() const {
    for (const char* why : {"failure.reason", "run.stopped"})
        if (const io::Json* found = io::find(inside_->values, why))
            return found->get<std::string>();
    return {};
}

bool Result::has(const std::string& name) const {
    const io::Json* found = io::find(inside_->values, name);
    return found && found->is_number();
}

double Result::number(const std::string& name) const {
    return translated([&] {
        const io::Json& value = inside_->value(name);
        if (!value.is_number())
            throw io::SceneError(io::Problem{inside_->directory + "/result.json",
                                             fmt::format("'{}' is no number", name), "",
                                             "Result::json() holds it"});
        return value.get<double>();
    });
}

std::string Result::unit(const std::string& name) const {
    return translated([&] { return inside_->value("units." + name).get<std::string>(); });
}

std::vector<std::string> Result::series() const {
    return translated([&] { return inside_->file().members("/series"); });
}

std::vector<double> Result::series(const std::string& column) const {
    return translated([&] {
        const io::Hdf5File from = inside_->file();
        return from.read<double>(inside_->checked(from, "/series/" + column));
    });
}

std::vector<std::string> Result::states() const {
    return translated([&] {
        const io::Hdf5File from = inside_->file();
        return from.exists("/fields") ? from.members("/fields") : std::vector<std::string>();
    });
}

std::vector<std::string> Result::maps(const std::string& state) const {
    return translated([&] {
        const io::Hdf5File from = inside_->file();
        const std::string group = "/fields/" + state;
        std::vector<std::string> found;
        for (const std::string& name : from.members(inside_->checked(from, group)))
            if (from.shape(group + "/" + name).size() == 2) found.push_back(name);
        return found;
    });
}

Map Result::map(const std::string& state, const std::string& name) const {
    return translated([&] { return inside_->map("/fields/" + state + "/" + name); });
}

Map Result::heights() const {
    return translated([&] { return inside_->map("/substrate/height"); });
}

Result run(const Scene& scene, const std::string& directory, const Options& options) {
    const asperity::Communicator ranks = world();
    return agreed(ranks, [&] {
        if (directory.empty())
            throw io::SceneError(io::Problem{"libasperity::run", "is given no directory",
                                             "a run writes its result into one",
                                             "name one that has no finished result"});
        io::set_commit(asperity::build_commit);
        asperity::RunOptions inner;
        inner.out = directory;
        inner.restart = options.restart;
        if (options.resume) inner.resume = "auto";
        if (options.wall_limit > 0.0) inner.wall_limit = options.wall_limit;
        inner.silent = true;
        inner.progress = io::ProgressMode::off;
        inner.stop = options.stop;
        if (options.progress)
            inner.listener = [&](const io::Progress::State& now) {
                options.progress({now.phase, now.steps, now.time_fs, now.fraction});
            };
        asperity::run(asperity::resolve(scene.inside().resolved.scene, ranks.size()), inner, ranks);
        return Result::load(directory);
    });
}

class Parallel::Inside {
public:
    Inside(int& argc, char**& argv) {
        session.emplace(argc, argv);
        ranks = session->world();
        if (session->unconnected() == 0) return;
        const int code = translated([&] { return asperity::refuse_unconnected(*session); });
        throw Error(code, "the first process says why");
    }
    explicit Inside(int communicator) : ranks(asperity::Communicator::of_fortran(communicator)) {}
    std::optional<asperity::ParallelSession> session;
    asperity::Communicator ranks;
};

Parallel::Parallel(int& argc, char**& argv) : inside_(std::make_unique<Inside>(argc, argv)) {
    inside_->ranks.share_processors();
    parallel_world = &inside_->ranks;
}
Parallel::Parallel(int communicator) : inside_(std::make_unique<Inside>(communicator)) {
    inside_->ranks.share_processors();
    parallel_world = &inside_->ranks;
}
Parallel::~Parallel() { parallel_world = nullptr; }
int Parallel::rank() const { return inside_->ranks.rank(); }
int Parallel::size() const { return inside_->ranks.size(); }

} // namespace libasperity
