// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Files of a stepped path: the scene as it was given, the numbers and arrays of the path, and what
// the script has added.
#include "engine/script/stepped_path.hpp"

#include "engine/path/checkpoint.hpp"
#include "engine/script/refuse.hpp"
#include "io/hdf5_file.hpp"
#include "io/json.hpp"

#include <filesystem>

namespace asperity {

namespace {

namespace fs = std::filesystem;

/// Returns the scene in a file that save() wrote.
SceneText saved_scene(const std::string& file) {
    const io::Hdf5File saved(io::FilePlace(file), io::Hdf5File::Mode::read);
    const std::optional<std::string> text = saved.text_attribute("/", "scene");
    const io::Json all = text ? io::parse_json(*text, file) : io::Json();
    const io::Json* scene = io::find(all, "simulation");
    if (!scene)
        throw io::FileError(
            file, text ? "holds a run, not a simulation that was saved" : "holds no simulation",
            "Simulation.resume goes on from what save() wrote",
            "a run's own checkpoint is for `asperity run --resume`");
    return {(*scene)["text"].get<std::string>(), (*scene)["file"].get<std::string>(),
            (*scene)["overrides"].get<std::vector<std::string>>()};
}

/// Refuses to write over anything but a file of save(). A link is not followed.
void require_own_place(const std::string& file) {
    std::error_code error;
    const fs::file_type type = fs::symlink_status(file, error).type();
    if (type == fs::file_type::not_found) return;
    std::string what = "cannot be looked at", why = error.message();
    if (type == fs::file_type::symlink) {
        what = "is a symbolic link", why = "what it points to is not replaced";
    } else if (type == fs::file_type::directory) {
        what = "is a directory", why = "a simulation is saved in one file";
    } else if (type == fs::file_type::regular) {
        try {
            saved_scene(file);
            return;
        } catch (const io::Error&) {
            what = "is there already, and is no file of Simulation.save()";
            why = "only such a file is replaced";
        }
    } else if (type != fs::file_type::none) {
        what = "is no regular file", why = "a device, a pipe or a socket is not replaced";
    }
    refuse(file.c_str(), what, why, "name another file");
}

} // namespace

std::shared_ptr<SteppedPath> SteppedPath::resume(const std::string& file,
                                                 const Communicator& ranks) {
    SceneText source = saved_scene(file);
    Case c = source.read(ranks.size());
    // The path starts as a new one: a file has only the path's numbers, without its start height.
    auto path = std::make_shared<SteppedPath>(std::move(c), std::move(source), ranks);
    path->restore(file);
    return path;
}

/// All that a file has beside the numbers of the path.
struct SteppedPath::Saved {
    SteppedPath& all;
    template <class Visitor>
    void visit(Visitor& v) {
        bool by_hand = all.hand_.has_value(), pushed = all.external_ != nullptr;
        double velocity = all.hand_.value_or(TopMotion{}).z;
        v("top.by_hand", by_hand);
        v("top.velocity", velocity);
        v("external", all.pushing_);
        v("external.acts", pushed);
        if constexpr (Visitor::restores) {
            all.hand_.reset();
            if (by_hand) all.hand_ = TopMotion{.z = velocity};
            if (pushed && !all.external_) {
                all.external_ = std::make_unique<VectorField<double>>(all.tile(), 1);
                all.pushing_.set(all.external_.get());
            }
        }
    }
};

std::vector<StateArray> SteppedPath::own_arrays() const {
    std::vector<StateArray> list;
    add_arrays(0, "force", lowest_level().transferred, 1, list);
    if (external_) add_arrays(0, "external", std::as_const(*external_), 1, list);
    return list;
}

std::vector<RestoredArray> SteppedPath::own_arrays_to_restore() {
    std::vector<RestoredArray> list;
    Block& block = path_.simulation().block_to_write();
    add_arrays(0, "force", block.fields(block.levels().front()).transferred, 1, list);
    if (external_) add_arrays(0, "external", *external_, 1, list);
    return list;
}

/// Returns the scene that the numbers of a file belong to, as it was given, and the contents of its
/// files.
std::string SteppedPath::description() const {
    io::Json scene = {{"text", source_.text},
                      {"file", fs::absolute(source_.file).string()},
                      {"overrides", source_.overrides}};
    if (surface_.file_digest) scene["content_of_surface.file"] = *surface_.file_digest;
    if (surface_.pair) scene["content_of_surface.counter"] = surface_.pair->digest;
    for (const auto& [key, digest] : case_.digests())
        scene["content_of_" + key] = digest;
    return io::json_text(io::Json{{"simulation", scene}});
}

void SteppedPath::save(const std::string& file) {
    require_whole();
    take_in_writes();
    ranks_.on_root([&] { require_own_place(file); });
    CollectNumbers numbers;
    path_.collect(numbers);
    Saved saved{*this};
    numbers("program", saved);
    write_checkpoint(io::FilePlace(file), ranks_, path_.grid(),
                     joined(path_.arrays(), own_arrays()), numbers.numbers, description());
}

void SteppedPath::restore(const std::string& file) {
    const auto arrays = [this](const StateNumbers& all) {
        RestoreNumbers numbers(all);
        path_.restore(numbers);
        Saved saved{*this};
        numbers("program", saved); // decides if there is a field to be read
        return joined(path_.arrays_to_restore(), own_arrays_to_restore());
    };
    read_checkpoint(io::FilePlace(file), ranks_, path_.grid(), arrays, description());
    path_.restored();
    take_copies();
}

} // namespace asperity
