// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A checkpoint whose digest is right: it is put behind the bytes here, or none would get past it.
#include "engine/run/checkpoint.hpp"
#include "engine/equilibrium/findings.hpp"
#include "engine/run/run_storage.hpp"
#include "target.hpp"

#include "io/digest.hpp"

#include <cstring>

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace asperity;
    std::string bytes(reinterpret_cast<const char*>(data), size);
    io::Digest digest;
    digest.update(std::as_bytes(std::span(bytes)));
    const std::uint64_t end[2] = {size, digest.value()};
    bytes.append("asperity digest\n", 16).append(reinterpret_cast<const char*>(end), sizeof end);
    const fuzz::MemoryFile file(bytes);
    fuzz::try_out([&] {
        const RunScalars scalars = read_checkpoint_scalars(file.name());
        position_in(scalars);
        Findings findings;
        findings.dissipated.emplace();
        for (std::size_t at = 0; at < scalars.size(); ++at)
            fuzz::try_out([&] { // from wherever they may begin
                RestoreScalars restore{scalars, at};
                if (scalars[at].first == "dissipation.approach")
                    findings.dissipated->visit(restore);
                else
                    findings.visit(restore);
            });
        const ProcessGrid grid(1, 0, 4, 1);
        Field<double> field(grid.tile(0), 2);
        read_checkpoint(file.name(), Communicator(), grid, {{"/level0/u_x", 0, &field, 2}},
                        "scene");
    });
    return 0;
}
