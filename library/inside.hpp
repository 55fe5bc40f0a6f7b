// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What the parts of libasperity share behind its header.
#pragma once

#include "engine/setup/case.hpp"
#include "io/error.hpp"
#include "library/asperity.hpp"

#include <string>
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

} // namespace libasperity
