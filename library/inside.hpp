// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What the parts of libasperity share behind its header.
#pragma once

#include "engine/setup/case.hpp"
#include "io/error.hpp"
#include "library/asperity.hpp"

#include <chrono>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace libasperity {

/// A scene as it was given.
struct SceneSource {
    std::string text, file;
    std::vector<std::string> overrides;
};

class Scene::Inside {
public:
    asperity::Case resolved;
    SceneSource source;
};

/// Errors of the engine as those of the header.
template <class Work>
auto translated(const Work& work) {
    try {
        return work();
    } catch (const asperity::io::Error& error) {
        throw Error(error.code(), error.what());
    }
}

/// FFTW's plans and HDF5 are of the process, and threads are shared: one call works at a time.
std::recursive_mutex& at_work();

template <class Work>
auto at_work_on(const Work& work) {
    const std::lock_guard<std::recursive_mutex> lock(at_work());
    return translated(work);
}

/// The ranks of a Parallel; without one, this process alone.
asperity::Communicator world();

[[noreturn]] void refuse(const char* where, std::string what, std::string why, std::string fix);

/// Calls a Look, now and then.
class Looking {
public:
    explicit Looking(const Simulation::Look& look) : look_(look) {}
    void now_and_then() {
        if (!look_ || Clock::now() < next_) return;
        look_();
        next_ = Clock::now() + pause;
    }

private:
    using Clock = std::chrono::steady_clock;
    static constexpr std::chrono::milliseconds pause{50};
    const Simulation::Look& look_;
    Clock::time_point next_ = Clock::now() + pause;
};

SiteMaps site_maps(const asperity::Interface& interface,
                   const asperity::VectorPlane<const double>& layer, double height);

} // namespace libasperity
