// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The quantities of the interface that may differ from site to site: one row for each key of the
// section [interface] that takes a number, or a map of the sites.
//
// The keys of a map's file, the digest, the least and the largest value in result.json, the map in
// run.h5 and the words of messages follow from the rows. A new map is a row here, its key in bind()
// and its number in set_largest() (engine/scene/scene.cpp), and the lines of the physics that read
// it.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace asperity {

/// A quantity that may be a map of the sites.
enum class SiteMapOf : std::size_t { adhesion, hardness };

namespace io {

/// Description of such a quantity, which is zero or more at each site.
struct SiteQuantity {
    /// Rule for a map that is 0 at some sites.
    enum Zero {
        taken,
        taken_without_repulsion, ///< refused with a law that includes a repulsion
        refused
    };

    SiteMapOf map;
    std::string_view name;      ///< name of its key, and in results
    std::string_view words;     ///< name in sentences
    std::string_view dimension; ///< dimension in sentences
    std::string_view unit;      ///< unit of the key
    std::string_view low, high; ///< values of an example
    std::string_view negative;  ///< reason why a value is not negative
    bool scales_law;            ///< the law of a site has a factor that follows from the value
    Zero zero;
    std::string_view why_no_zero{}, instead_of_zero{}; ///< reason and remedy of the refusal
};

/// All such quantities, in the order of SiteMapOf.
inline constexpr auto site_quantities = std::to_array<SiteQuantity>({
    {SiteMapOf::adhesion, "adhesion", "work of adhesion", "energy per area", "meV/Å^2", "10 mJ/m^2",
     "50 mJ/m^2", "a work of adhesion is zero or more: a site repels at contact alone", true,
     SiteQuantity::taken_without_repulsion,
     "the law (interface.law) repels by itself, and the work of adhesion multiplies its repulsion "
     "too: nothing would repel there",
     "take a small work of adhesion in place of 0, or law = \"exponential\""},
    {SiteMapOf::hardness, "hardness", "hardness", "pressure", "GPa", "1 GPa", "3 GPa",
     "a hardness is above zero", false, SiteQuantity::refused,
     "a site of no hardness would not be pressed at all",
     "take a hardness above 0 at each site, in GPa"},
});

static_assert(
    [] {
        for (std::size_t i = 0; i < site_quantities.size(); ++i)
            if (site_quantities[i].map != SiteMapOf(i)) return false;
        return true;
    }(),
    "the rows stand in the order of SiteMapOf");

} // namespace io

/// A value for each quantity that may be a map of the sites.
template <class Value>
struct PerSiteMap {
    std::array<Value, io::site_quantities.size()> of{};

    Value& operator[](SiteMapOf map) { return of[static_cast<std::size_t>(map)]; }
    const Value& operator[](SiteMapOf map) const { return of[static_cast<std::size_t>(map)]; }
};

} // namespace asperity
