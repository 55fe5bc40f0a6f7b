// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/options/branches_in_series.hpp"

#include <numeric>

namespace asperity {

std::vector<Branch> branches_in_series(const std::vector<Branch>& branches, double share) {
    std::vector<Branch> both;
    for (std::size_t k = 0; k < branches.size(); ++k) {
        const double from = branches[k].time;
        /// Returns the sum of term(r tau, T - tau) over the branches for T = tau_k + beyond.
        const auto sum = [&](double beyond, const auto& term) {
            double total = 0.0;
            for (const auto& [ratio, time] : branches)
                total += term(ratio * time, beyond + (from - time));
            return total;
        };
        double low = 0.0, high = 0.0; // beyond tau_k
        for (const auto& [ratio, time] : branches)
            high += share * ratio * time;
        if (k + 1 < branches.size()) high = std::min(high, branches[k + 1].time - from);
        for (double t; t = std::midpoint(low, high), t != low && t != high;)
            (share * sum(t, [](double a, double d) { return a / d; }) > 1.0 ? low : high) = t;
        const double time = from + high;
        const double slope = sum(high, [](double a, double d) { return a / (d * d); });
        both.push_back({(1.0 - share) / (share * share * time * slope), time});
    }
    return both;
}

} // namespace asperity
