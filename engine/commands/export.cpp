// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/commands/export.hpp"

#include "engine/commands/report_plots.hpp"
#include "engine/commands/stored_run.hpp"
#include "io/atoms_file.hpp"
#include "io/error.hpp"
#include "io/h5md.hpp"
#include "io/hdf5_file.hpp"
#include "io/result.hpp"
#include "io/xdmf.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

namespace asperity {

namespace {

namespace fs = std::filesystem;

class Export {
public:
    explicit Export(const std::string& directory)
        : run_(read_run(directory)), spacing_(run_.number("scene.surface.spacing").value_or(0.0)) {
        expect_result(directory, {"run.h5"});
        for (const std::string& note : run_.notes)
            fmt::print("note: {}\n", note);
        if (run_.height.empty() || !(spacing_ > 0.0))
            throw io::FileError(run_.path("run.h5"), "has nothing to export",
                                "it holds no substrate, or result.json no scene",
                                "name the directory of a run that got past its start");
    }

    /// Every state and the trajectory as atoms.
    void atoms(io::AtomFormat format) {
        const std::string end = format == io::AtomFormat::extended_xyz ? ".xyz" : ".dump";
        for (const StoredState& state : run_.states) {
            io::AtomFrame frame = substrate();
            add_layer(frame, state);
            write("export/" + file_name(state.name) + end, format,
                  [&](io::AtomsFile& file) { file.append(frame); });
        }
        if (run_.frames > 0)
            write("export/trajectory" + end, format,
                  [&](io::AtomsFile& file) { trajectory(file); });
    }

    void xdmf() {
        std::vector<io::XdmfGrid> grids = {{"substrate",
                                            run_.substrate_sites,
                                            run_.edge() / run_.substrate_sites,
                                            0.0,
                                            {{"height (Å)", "/substrate/height"}}}};
        for (const StoredState& state : run_.states) {
            io::XdmfGrid grid{state.name, state.sites, spacing_, 0.5 * spacing_, {}};
            for (const auto& [name, map] : state.maps)
                grid.maps.push_back({name == "contact"    ? name
                                     : name == "pressure" ? name + " (GPa)"
                                                          : name + " (Å)",
                                     "/fields/" + state.name + "/" + name, name == "contact"});
            grids.push_back(std::move(grid));
        }
        io::write_whole(run_.path("run.xdmf"), io::xdmf("run.h5", grids, frames()));
        written_.push_back(run_.path("run.xdmf"));
    }

    void pictures() {
        io::make_directory(run_.path("export"));
        for (const StoredState& state : run_.states)
            for (const io::MapPlot& map : state_maps(run_, state)) {
                const std::string path = run_.path("export/" + map.id + ".png");
                io::write_whole(path, io::png_of_svg(io::map_document(map), 2.0));
                written_.push_back(path);
            }
    }

    void report() const {
        if (written_.empty())
            throw io::FileError(run_.path("run.h5"), "has nothing to export",
                                "it holds neither maps of a state nor a trajectory",
                                "a run that reaches its state at zero load has maps; "
                                "output.trajectory asks for frames");
        for (const std::string& path : written_)
            fmt::print("{}\n", path);
    }

private:
    /// The rigid atoms, the same in every frame; the box holds all there is.
    io::AtomFrame substrate() const {
        io::AtomFrame frame;
        const auto n = static_cast<std::size_t>(run_.substrate_sites);
        const double b = run_.edge() / static_cast<double>(n);
        for (std::size_t i = 0; i < n * n; ++i) {
            frame.type.push_back(1);
            frame.position.insert(
                frame.position.end(),
                {b * static_cast<double>(i % n), b * static_cast<double>(i / n), run_.height[i]});
        }
        return frame;
    }

    static void fit_box(io::AtomFrame& frame, double edge) {
        double low = frame.position[2], high = low;
        for (std::size_t i = 2; i < frame.position.size(); i += 3) {
            low = std::min(low, frame.position[i]);
            high = std::max(high, frame.position[i]);
        }
        frame.lowest = low - 1.0;
        frame.edges = {edge, edge, high - low + 2.0};
    }

    /// The block's lowest layer with its maps as columns; the substrate's are zero. Sites stand
    /// over the hollows of the substrate.
    void add_layer(io::AtomFrame& frame, const StoredState& state) const {
        for (const char* needed : {"u_x", "u_y", "u_z"})
            if (!state.has(needed))
                throw io::FileError(run_.path("run.h5"),
                                    "state \"" + state.name + "\" cannot be exported",
                                    std::string("it has no map ") + needed,
                                    "was the file written by another program?");
        const auto n = static_cast<std::size_t>(state.sites);
        const std::size_t rigid = frame.type.size();
        io::AtomColumn displacement{"displacement", 3, false, std::vector<double>(3 * rigid)};
        const std::array<const std::vector<double>*, 3> u = {
            &state.maps.at("u_x"), &state.maps.at("u_y"), &state.maps.at("u_z")};
        for (std::size_t i = 0; i < n * n; ++i) {
            frame.type.push_back(2);
            const std::array<double, 3> rest = {spacing_ * (static_cast<double>(i % n) + 0.5),
                                                spacing_ * (static_cast<double>(i / n) + 0.5),
                                                state.reference_height};
            for (std::size_t c = 0; c < 3; ++c) {
                frame.position.push_back(rest[c] + (*u[c])[i]);
                displacement.values.push_back((*u[c])[i]);
            }
        }
        frame.columns.push_back(std::move(displacement));
        const auto scalar = [&](const char* name, bool integer) {
            if (!state.has(name)) return;
            io::AtomColumn column{name, 1, integer, std::vector<double>(rigid)};
            for (const double v : state.maps.at(name)) // -1: no atom in reach
                column.values.push_back(std::isfinite(v) ? v : -1.0);
            frame.columns.push_back(std::move(column));
        };
        scalar("pressure", false);
        scalar("contact", true);
        scalar("gap", false);
        scalar("distance", false);
        fit_box(frame, run_.edge());
    }

    void trajectory(io::AtomsFile& out) const {
        const io::Hdf5File file(run_.path("run.h5"), io::Hdf5File::Mode::read);
        const std::string group = io::H5mdTrajectory::group;
        const auto steps = file.read<std::int64_t>(group + "/position/step");
        const auto times = file.read<double>(group + "/position/time");
        const std::uint64_t atoms = file.shape(group + "/position/value").at(1);
        const bool moving = file.exists(group + "/velocity");
        const io::AtomFrame rigid = substrate();
        const auto read = [&](const char* name, std::uint64_t frame) {
            std::vector<double> values(3 * atoms);
            file.read_slab<double>(group + name, {frame, 0, 0}, {1, atoms, 3}, values);
            return values;
        };
        for (std::size_t f = 0; f < run_.frames; ++f) {
            io::AtomFrame frame = rigid;
            frame.step = steps[f];
            frame.time = times[f];
            const auto position = read("/position/value", f);
            frame.position.insert(frame.position.end(), position.begin(), position.end());
            frame.type.insert(frame.type.end(), atoms, 2);
            if (moving) {
                io::AtomColumn velocity{"velocity", 3, false,
                                        std::vector<double>(3 * rigid.type.size())};
                const auto v = read("/velocity/value", f);
                velocity.values.insert(velocity.values.end(), v.begin(), v.end());
                frame.columns.push_back(std::move(velocity));
            }
            fit_box(frame, run_.edge());
            out.append(frame);
        }
    }

    /// The trajectory for XDMF: its frames one by one in export/trajectory.h5.
    io::XdmfPoints frames() {
        io::XdmfPoints points{"lowest layer", "export/trajectory.h5", 0, {}, {}};
        if (run_.frames == 0) return points;
        const io::Hdf5File file(run_.path("run.h5"), io::Hdf5File::Mode::read);
        const std::string position = std::string(io::H5mdTrajectory::group) + "/position";
        points.points = file.shape(position + "/value").at(1);
        points.times = file.read<double>(position + "/time");
        io::make_directory(run_.path("export"));
        io::Hdf5File copy(run_.path(points.hdf5), io::Hdf5File::Mode::create);
        std::vector<float> values(3 * points.points);
        for (std::size_t f = 0; f < run_.frames; ++f) {
            file.read_slab<float>(position + "/value", {f, 0, 0}, {1, points.points, 3}, values);
            points.datasets.push_back(fmt::format("/position-{}", f));
            copy.write<float>(points.datasets.back(), {points.points, 3}, values);
        }
        copy.close();
        written_.push_back(run_.path(points.hdf5));
        return points;
    }

    template <class Fill>
    void write(const std::string& name, io::AtomFormat format, const Fill& fill) {
        io::make_directory(run_.path("export"));
        io::AtomsFile file(run_.path(name), format);
        fill(file);
        file.close();
        written_.push_back(run_.path(name));
    }

    StoredRun run_;
    double spacing_; ///< of the block's sites, Å
    std::vector<std::string> written_;
};

} // namespace

int export_command(const std::string& directory, const std::string& format) {
    if (format != "xyz" && format != "lammps" && format != "xdmf" && format != "png")
        throw io::SceneError(io::Problem{
            "--to " + format, "is no format of export", "formats: xyz, lammps, xdmf, png",
            "for example: asperity export " + directory + " --to xyz"});
    Export work(directory);
    if (format == "xyz")
        work.atoms(io::AtomFormat::extended_xyz);
    else if (format == "lammps")
        work.atoms(io::AtomFormat::lammps_dump);
    else if (format == "xdmf")
        work.xdmf();
    else
        work.pictures();
    work.report();
    return io::exit_code::done;
}

} // namespace asperity
