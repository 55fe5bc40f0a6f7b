// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The numbers of a run's state by name, for checkpoints, and the two visitors that collect and
// restore them.
//
// A class lists its members once, for both ways:
//
//     template <class Visitor>
//     void visit(Visitor& v) {
//         v("force", force);   // a double, an integer, an enumeration, a bool,
//         v("trail", trail);   // a class with a visit() of its own: "trail.points",
//         v("jumps", jumps);   // a vector of these: "jumps.count", "jumps.0.energy",
//         v("lost", lost);     // an optional of these: "lost.given", "lost"
//         v("slide", slide);   // an array of these: "slide.0", "slide.1"
//         if constexpr (Visitor::restores) ...; // values that follow from the new ones
//     }
//
// Collecting takes const objects and changes nothing.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace asperity {

/// Numbers by name; integers stay integers.
using StateNumbers = std::map<std::string, std::variant<double, std::int64_t>>;

/// Visitor that walks through the members of an object and passes each number with its full name to
/// Self, which has number(name, double&), integer(name, std::int64_t&, least, most) and
/// longest_list().
template <class Self>
class NumberVisitor {
public:
    template <class T>
    void operator()(const std::string& name, T& value) {
        if constexpr (std::is_floating_point_v<T>) {
            self().number(prefix_ + name, value);
        } else if constexpr (std::is_enum_v<T>) {
            std::underlying_type_t<T> number = static_cast<std::underlying_type_t<T>>(value);
            (*this)(name, number);
            if constexpr (Self::restores) value = static_cast<T>(number);
        } else if constexpr (std::is_integral_v<T>) {
            using Limits = std::numeric_limits<T>;
            constexpr std::uint64_t largest = std::numeric_limits<std::int64_t>::max();
            auto number = static_cast<std::int64_t>(value);
            self().integer(prefix_ + name, number, static_cast<std::int64_t>(Limits::lowest()),
                           static_cast<std::int64_t>(
                               std::min(static_cast<std::uint64_t>(Limits::max()), largest)));
            if constexpr (Self::restores) value = static_cast<T>(number);
        } else {
            visit_members(name, value);
        }
    }

private:
    template <class T, std::size_t n>
    void visit_members(const std::string& name, std::array<T, n>& values) {
        for (std::size_t i = 0; i < n; ++i)
            (*this)(name + "." + std::to_string(i), values[i]);
    }
    template <class T>
    void visit_members(const std::string& name, std::optional<T>& value) {
        bool given = value.has_value();
        (*this)(name + ".given", given);
        if constexpr (Self::restores) given ? void(value.emplace()) : value.reset();
        if (given) (*this)(name, *value);
    }
    template <class T>
    void visit_members(const std::string& name, std::vector<T>& list) {
        auto count = static_cast<std::int64_t>(list.size());
        self().integer(prefix_ + name + ".count", count, 0, self().longest_list());
        if constexpr (Self::restores) list.resize(static_cast<std::size_t>(count));
        for (std::size_t i = 0; i < list.size(); ++i)
            (*this)(name + "." + std::to_string(i), list[i]);
    }
    template <class T>
    void visit_members(const std::string& name, T& object) {
        const std::string outside = std::exchange(prefix_, prefix_ + name + ".");
        object.visit(self());
        prefix_ = outside;
    }
    Self& self() { return static_cast<Self&>(*this); }

    std::string prefix_;
};

/// Visitor that collects the numbers of objects by name.
class CollectNumbers : public NumberVisitor<CollectNumbers> {
public:
    static constexpr bool restores = false;
    StateNumbers numbers;

    template <class T>
    void operator()(const std::string& name, const T& value) {
        // One visit() lists the members for both visitors; this one writes to none of them.
        NumberVisitor::operator()(name, const_cast<T&>(value));
    }

    /// Collects the members of an object under their own names, without a prefix.
    template <class T>
    void members_of(const T& object) {
        const_cast<T&>(object).visit(*this); // writes to none of them
    }

    /// Adds a number. Throws std::logic_error if the name is taken.
    void number(const std::string& name, double& value) { put(name, value); }
    /// Adds an integer. Throws std::logic_error if the name is taken.
    void integer(const std::string& name, std::int64_t& value, std::int64_t, std::int64_t) {
        put(name, value);
    }
    /// Returns the largest accepted length of a list.
    std::int64_t longest_list() const { return std::numeric_limits<std::int64_t>::max(); }

private:
    void put(const std::string& name, std::variant<double, std::int64_t> value);
};

/// Visitor that sets the numbers of objects by name.
class RestoreNumbers : public NumberVisitor<RestoreNumbers> {
public:
    static constexpr bool restores = true;

    /// Keeps a reference to the numbers.
    explicit RestoreNumbers(const StateNumbers& numbers) : numbers_(numbers) {}

    /// Sets a number. Throws io::FileError if the name is missing or names an integer.
    void number(const std::string& name, double& value) const;
    /// Sets an integer. Throws io::FileError if the name is missing, or its value no integer from
    /// least to most.
    void integer(const std::string& name, std::int64_t& value, std::int64_t least,
                 std::int64_t most) const;
    /// Returns the largest accepted length of a list: a damaged count must not allocate memory.
    std::int64_t longest_list() const { return static_cast<std::int64_t>(numbers_.size()); }

private:
    template <class T>
    const T& find(const std::string& name) const;

    const StateNumbers& numbers_;
};

} // namespace asperity
