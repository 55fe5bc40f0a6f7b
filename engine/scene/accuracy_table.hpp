// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The calibration behind numerics.accuracy. Its rows are what scenes/cost/calibrate.sh prints; its
// limits are those of the scenes measured there.
#pragma once

#include <array>
#include <string_view>

namespace asperity::calibration {

inline constexpr std::string_view source =
    "scenes/cost/calibrate.sh: N = 32 to 128, rms 0.5 to 3 Å, 5 and 10 m/s";

/// What is chosen.
enum class Dial { layers, precision, timestep };

struct Row {
    Dial dial;
    double value; ///< layers a level (0: the lattice), fs; of precision 0: mixed
    double state; ///< largest relative error of gamma and contact at zero load
    double path;  ///< the same with works of adhesion and pull-off force
    double time;  ///< of the time with 4 layers a level, double precision and 10 fs
};

inline constexpr std::array rows = {
    Row{Dial::layers, 2, 0.026, 0.026, 0.87},
    Row{Dial::layers, 3, 0.0093, 0.011, 1.02},
    Row{Dial::layers, 4, 0.0082, 0.011, 1.03},
    Row{Dial::layers, 6, 0.0038, 0.0038, 1.68},
    Row{Dial::layers, 8, 0.0046, 0.0046, 2.06},
    Row{Dial::layers, 0, 0, 0, 17.41},
    Row{Dial::precision, 0, 1.1e-07, 1.7e-07, 0.93},
    Row{Dial::timestep, 60, 8.7e-08, 0.00045, 0.20},
    Row{Dial::timestep, 50, 7.7e-08, 0.00057, 0.22},
    Row{Dial::timestep, 40, 4.2e-07, 0.00024, 0.27},
    Row{Dial::timestep, 30, 4.2e-07, 0.00041, 0.35},
    Row{Dial::timestep, 20, 4.3e-07, 0.00026, 0.52},
    Row{Dial::timestep, 10, 2.2e-07, 7.3e-05, 1.00},
};

inline constexpr int fewest_sites = 32;
/// More sites than were measured, and the longest step for them, fs: among many some are pressed
/// harder. 512 sites diverge at 50 fs at rms 1 Å and at 60 fs at rms 3 Å; at 40 fs no surface did.
inline constexpr int most_sites = 128;
inline constexpr double longest_timestep_of_more = 40.0;
inline constexpr double most_bending = 178.0; ///< bending_energy() of rms 2 Å at N = 32, meV/Å²
inline constexpr double fastest = 10.0;       ///< m/s

} // namespace asperity::calibration
