// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// `asperity export DIR --to xyz|lammps|xdmf|png`: what run.h5 holds, for other programs.
//
//     xyz, lammps   DIR/export/<state>.xyz (.dump): the atoms of the substrate and of the block's
//                   lowest layer, for every state with maps, with what is known of each atom as
//                   columns; DIR/export/trajectory.xyz (.dump): the frames of the trajectory
//     xdmf          DIR/run.xdmf: opens run.h5 in ParaView
//     png           DIR/export/<map>-<state>.png: gap, pressure and contact from above
//
// These files are the export's own: a second export writes them anew.
#pragma once

#include <string>

namespace asperity {

/// On one rank. Returns the exit code. Throws io::FileError for a directory without run.h5 or with
/// nothing in it to export, io::SceneError for another format.
int export_command(const std::string& directory, const std::string& format);

} // namespace asperity
