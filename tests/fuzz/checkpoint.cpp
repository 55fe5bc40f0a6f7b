// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A checkpoint whose digest is right: it is put behind the bytes here, or none would get past it.
#include "engine/path/checkpoint.hpp"
#include "engine/path/path_results.hpp"
#include "engine/run/run_storage.hpp"
#include "target.hpp"

#include "io/files.hpp"

#include <cstring>

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace asperity;
    std::string bytes(reinterpret_cast<const char*>(data), size);
    const std::uint64_t end[2] = {size, io::digest_of(std::as_bytes(std::span(bytes)))};
    bytes.append("asperity digest\n", 16).append(reinterpret_cast<const char*>(end), sizeof end);
    const fuzz::MemoryFile file(bytes);
    fuzz::try_out([&] {
        const StateNumbers numbers = read_checkpoint_numbers(file.name());
        fuzz::try_out([&] { position_in(numbers); });
        RestoreNumbers restore(numbers);
        PathResults results;
        Dissipation dissipation;
        fuzz::try_out([&] { restore("results", results); });
        fuzz::try_out([&] { restore("points.dissipation", dissipation); });
        const ProcessGrid grid(1, 0, 4, 1);
        Field<double> field(grid.tile(0), 2);
        const auto arrays = [&](const StateNumbers&) {
            return std::vector<RestoredArray>{{"/level0/u_x", 0, &field, 2}};
        };
        read_checkpoint(file.name(), Communicator(), grid, arrays, "scene");
    });
    return 0;
}
