// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Physical constants in the units of the engine: Å, eV, fs (docs/explanation/model.md).
#pragma once

#include <cmath>

namespace asperity::units {

inline constexpr double gigapascal = 1.0 / 160.21766208;            ///< eV/Å^3
inline constexpr double megapascal = 1e-3 * gigapascal;             ///< eV/Å^3
inline constexpr double newton_per_metre = 1.0 / 16.021766208;      ///< eV/Å^2
inline constexpr double nanonewton = 1.0 / 1.602176634;             ///< eV/Å
inline constexpr double attojoule = 1.0 / 0.1602176634;             ///< eV
inline constexpr double atomic_mass = 103.642695;                   ///< eV fs^2/Å^2
inline constexpr double metre_per_second = 1e-5;                    ///< Å/fs
inline constexpr double per_picosecond = 1e-3;                      ///< 1/fs
inline constexpr double picosecond = 1e3;                           ///< fs
inline constexpr double forever = HUGE_VAL;                         ///< fs, ps or s
inline constexpr double boltzmann = 8.617333262e-5;                 ///< eV/K
inline constexpr double milli_per_unit = 1e3;                       ///< meV/eV
inline constexpr double millijoule_per_square_metre = 16.021766208; ///< mJ/m^2 in a meV/Å^2

} // namespace asperity::units
