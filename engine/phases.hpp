// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Wall time of the parts of a run: one clock for each line of the step, named like the line.
#pragma once

#include <array>
#include <chrono>
#include <string_view>

namespace asperity {

/// Parts of a run with clocks of their own.
enum class Phase {
    interpolate, ///< constrained planes are interpolated from the coarse planes
    interface,   ///< forces of the substrate
    advance,     ///< elastic forces, kick and drift, level by level
    thermostat,  ///< noise of a scene with a temperature
    exchange,    ///< halos
    device,      ///< a whole step on a device
    sums,        ///< global sums of a step; work and dissipation integrated
    observe,     ///< mean height; energies and contact of observed steps
    relax,       ///< relaxation of a state
    checkpoint,
    output,
    count
};

inline constexpr std::array<std::string_view, static_cast<std::size_t>(Phase::count)> phase_names =
    {"interpolate", "interface", "advance", "thermostat", "exchange", "device",
     "sums",        "observe",   "relax",   "checkpoint", "output"};

/// Wall time and number of calls of a phase.
struct PhaseClock {
    double seconds = 0.0;
    long long calls = 0;
};

/// Clocks of all phases.
class Phases {
public:
    using Clock = std::chrono::steady_clock;

    const PhaseClock& operator[](Phase p) const { return clocks_[static_cast<std::size_t>(p)]; }

    /// Timer that runs from its construction to its destruction.
    class Timer {
    public:
        Timer(Phases& phases, Phase phase)
            : clock_(phases.clocks_[static_cast<std::size_t>(phase)]), start_(Clock::now()) {}
        ~Timer() {
            clock_.seconds += std::chrono::duration<double>(Clock::now() - start_).count();
            ++clock_.calls;
        }
        Timer(const Timer&) = delete;
        Timer& operator=(const Timer&) = delete;

    private:
        PhaseClock& clock_;
        Clock::time_point start_;
    };
    /// Returns a timer of a phase.
    Timer time(Phase phase) { return Timer(*this, phase); }
    /// Calls work() on the clock of a phase.
    template <class Work>
    void during(Phase phase, const Work& work) {
        const Timer timer(*this, phase);
        work();
    }

private:
    std::array<PhaseClock, static_cast<std::size_t>(Phase::count)> clocks_{};
};

} // namespace asperity
