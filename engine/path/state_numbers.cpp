// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/path/state_numbers.hpp"

#include "io/error.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace asperity {

void CollectNumbers::put(const std::string& name, std::variant<double, std::int64_t> value) {
    if (!numbers.emplace(name, value).second)
        throw std::logic_error("two numbers of a state are called " + name);
}

template <class T>
const T& RestoreNumbers::find(const std::string& name) const {
    const auto found = numbers_.find(name);
    if (found == numbers_.end() || !std::holds_alternative<T>(found->second))
        throw io::FileError("checkpoint", fmt::format("has no number \"{}\"", name),
                            "it was written by another version of the program",
                            "run the scene from its start");
    return std::get<T>(found->second);
}

void RestoreNumbers::number(const std::string& name, double& value) const {
    value = find<double>(name);
}

void RestoreNumbers::integer(const std::string& name, std::int64_t& value, std::int64_t least,
                             std::int64_t most) const {
    const std::int64_t there = find<std::int64_t>(name);
    if (there < least || there > most)
        throw io::FileError("checkpoint", fmt::format("has the number \"{}\" = {}", name, there),
                            fmt::format("one from {} to {} is expected", least, most),
                            "run the scene from its start");
    value = there;
}

} // namespace asperity
