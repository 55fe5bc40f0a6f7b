// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A result directory read back: what `asperity report` and `asperity export` work from.
//
// A directory holds what its run came to: a run that failed has a reason and perhaps half a series,
// one of the theory alone has no run.h5. What is not there is empty here; what is damaged is said
// in `notes`, and the rest is used.
#pragma once

#include "engine/scene/scene.hpp"
#include "io/json_value.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace asperity {

/// The maps of one state, [y * sites + x], as in /fields/<name> of run.h5.
struct StoredState {
    std::string name;
    int sites = 0;
    double reference_height = 0.0; ///< z of undisplaced sites, Å
    /// By data set: gap, distance, u_x, u_y, u_z (Å), pressure (GPa), contact (0 or 1).
    std::map<std::string, std::vector<double>> maps;
    std::vector<double> gap_edges, gap_density; ///< P(u): Å, 1/Å

    bool has(const std::string& map) const { return maps.count(map) > 0; }
};

struct StoredRun {
    std::string directory;
    std::string title;    ///< of its scene; of a result without one, the directory's name
    io::JsonValue result; ///< result.json
    std::optional<Scene> scene;
    std::string toml; ///< the scene as text

    /// Columns of the series along the path by name (engine/run/recorder.cpp), of equal length.
    std::map<std::string, std::vector<double>> series;
    std::vector<double> height; ///< of the substrate's atoms, Å
    int substrate_sites = 0;
    std::vector<double> spectrum_q, spectrum, spectrum_target; ///< 1/Å, Å^4, Å^4
    std::vector<StoredState> states;
    std::size_t frames = 0; ///< of the trajectory
    std::vector<std::string> notes;

    std::string path(const std::string& file) const; ///< in the directory
    double edge() const;                             ///< of the box, Å
    int sites() const;                               ///< of the block across the box
    bool curved() const { return scene && scene->surface.radius; }
    std::optional<double> number(const std::string& name) const; ///< "energy.residual" of result
    std::string text(const std::string& name) const;             ///< likewise; "" if not there
};

/// Throws io::FileError where there is no result.
StoredRun read_run(const std::string& directory);

/// The last name of a path, with or without a slash behind it.
std::string directory_name(const std::string& directory);

/// A whole text file. Throws io::FileError.
std::string read_text(const std::string& path);

/// No directory, or one without any of these files: io::FileError that says what is missing.
void expect_result(const std::string& directory, const std::vector<std::string>& any_of);

} // namespace asperity
