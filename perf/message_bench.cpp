// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What does a message cost? Two ranks play ping-pong with messages of many sizes, swap messages
// both ways at once, as the exchange of halos does, and add up the numbers of a step.
//
//     mpirun -n 2 build/release/perf/message_bench [BYTES ...]
//
// Sizes are the powers of two from 8 bytes to 4 MB, and those asked for. Prints JSON: seconds, the
// least of many trials.
#include "decomposition/communicator.hpp"
#include "kernels/exact_sum.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <vector>

using namespace asperity;

namespace {

/// Seconds of one call, the least over up to twenty trials of many calls each; a trial takes a few
/// milliseconds, all of them a third of a second where calls are not longer.
template <class Call>
double least(const Communicator& ranks, const Call& call) {
    double best = 1e300, spent = 0.0;
    int calls = 4;
    for (int trial = 0; trial < 20 && spent < 0.3; ++trial) {
        ranks.barrier();
        const auto start = std::chrono::steady_clock::now();
        for (int n = 0; n < calls; ++n)
            call();
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
        const double longest = ranks.max(took.count()); // all ranks decide alike
        best = std::min(best, longest / calls);
        spent += longest;
        calls = static_cast<int>(std::clamp(4e-3 / best, 4.0, 200.0));
    }
    return best;
}

} // namespace

int main(int argc, char** argv) {
    ParallelSession session(argc, argv);
    const Communicator& ranks = session.world();
    if (ranks.size() != 2) {
        if (ranks.root()) std::fprintf(stderr, "usage: mpirun -n 2 message_bench [BYTES ...]\n");
        return 2;
    }
    const int other = 1 - ranks.rank();
    nlohmann::json swaps = nlohmann::json::array(), pings = swaps;
    std::set<std::size_t> sizes;
    for (std::size_t bytes = 8; bytes <= (std::size_t{4} << 20); bytes *= 2)
        sizes.insert(bytes);
    for (int i = 1; i < argc; ++i)
        sizes.insert(std::strtoul(argv[i], nullptr, 10));
    for (const std::size_t bytes : sizes) {
        std::vector<double> out(bytes / sizeof(double), 1.0), in(out.size()), out2 = out, in2 = in;
        // There and back: half of it is one message.
        const Message there[] = {{other, other, 0, out, {}}}, back[] = {{other, other, 0, {}, in}};
        const Message both[] = {{other, other, 0, out, in}, {other, other, 1, out2, in2}};
        const double swap = least(ranks, [&] { ranks.exchange(both); });
        const double ping = least(ranks, [&] {
            ranks.exchange(ranks.root() ? there : back);
            ranks.exchange(ranks.root() ? back : there);
        });
        swaps.push_back({{"bytes", bytes}, {"seconds", swap}});
        pings.push_back({{"bytes", bytes}, {"seconds", 0.5 * ping}});
    }
    // The nine exact sums of a step, in one reduction (Simulation::enter_in_ledger).
    std::vector<double> bins(9 * ExactSum::bins, 0.0);
    const double sum = least(ranks, [&] { ranks.sum(bins); });
    const nlohmann::json result = {{"ping", pings}, {"swap", swaps}, {"sum", sum}};
    if (ranks.root()) std::printf("%s\n", result.dump(1).c_str());
    return 0;
}
