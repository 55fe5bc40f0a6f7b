// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The terms of the energy balance: the side on which each stands, and the places where each is.
#include "engine/case/effects.hpp"
#include "engine/energy/energies.hpp"
#include "engine/run/series.hpp"
#include "io/quantities.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace asperity {

/// A path with 3 eV at its start: work goes into storage and losses, and a term that is off by x is
/// an error of x over the largest energy.
TEST(Energies, EachTermStandsOnItsSideOfTheBalance) {
    constexpr double start = 3.0, off = 0.01;
    Energies now;
    double spent = 0.0, next = 1.0;
    for (const io::EnergyTerm& row : io::energy_terms) {
        if (row.kind == io::EnergyTerm::work || row.kind == io::EnergyTerm::interior_work ||
            row.kind == io::EnergyTerm::part)
            continue;
        now[row.term] = next;
        spent += next;
        next += 0.25;
    }
    now[Term::work] = spent - start;
    const double largest = std::max(now.largest_stored(), now[Term::work]) + off;
    for (const io::EnergyTerm& row : io::energy_terms) {
        Energies wrong = now;
        wrong[row.term] += off;
        Balance balance;
        balance.begin(start);
        const double sign =
            row.kind == io::EnergyTerm::work                                                ? 1.0
            : row.kind == io::EnergyTerm::interior_work || row.kind == io::EnergyTerm::part ? 0.0
                                                                                            : -1.0;
        EXPECT_NEAR(balance.residual(wrong, largest), sign * off / largest, 1e-12) << row.column;
        EXPECT_NEAR(balance.residual(now, largest), 0.0, 1e-12) << row.column;
    }
}

TEST(Energies, EachTermHasItsColumnAndItsNames) {
    const auto has_column = [](std::string_view name) {
        return std::ranges::any_of(series_columns(),
                                   [&](const SeriesColumn& c) { return c.name() == name; });
    };
    for (const io::EnergyTerm& row : io::energy_terms) {
        EXPECT_TRUE(has_column(row.column)) << row.column;
        EXPECT_TRUE(row.column_at_rest.empty() || has_column(row.column_at_rest));
        EXPECT_NO_THROW(Effects().has(row.effect)) << row.effect;
        const std::string last = row.last.empty() ? "work" : std::string(row.last);
        EXPECT_NO_THROW(io::Key::composed("energy." + last)) << last;
        if (row.key.empty()) continue;
        for (const char* way : {".approach", ".pull_off"})
            EXPECT_NO_THROW(io::Key::of("", row, way)) << row.key << way;
        EXPECT_NO_THROW(io::Key::of("segments[].", row)) << row.key;
        if (!row.is_loss()) continue;
        EXPECT_NO_THROW(io::Key::of("", row, ".cycle")) << row.key;
        EXPECT_NO_THROW(io::Key::of("segments[].steady_", row)) << row.key;
    }
    for (const SeriesColumn& column : series_columns()) {
        const std::string_view result = column.result.empty() ? "energy.work" : column.result;
        EXPECT_NO_THROW(io::Key::composed(result)) << result;
    }
    EXPECT_THROW(Effects().has("no such effect"), std::logic_error);
}

} // namespace asperity
