// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/commands/command_line.hpp"

#include "decomposition/communicator.hpp"
#include "io/error.hpp"
#include "io/json.hpp"
#include "io/machine.hpp"
#include "io/terminal.hpp"
#include "kernels/device/device.hpp"
#include "kernels/variant.hpp"

#include <memory>
#include <string>

#include <fftw3.h>
#include <fmt/format.h>
#include <omp.h>

namespace asperity {

namespace {

int print_info(bool json, const Communicator& world) {
    if (!world.root()) return io::exit_code::done;
    const io::BuildInfo build = io::build_info();
    if (json) {
        const io::Json all = {{"version", build.version},
                              {"git", build.git},
                              {"compiler", build.compiler},
                              {"flags", build.flags},
                              {"mpi", ParallelSession::library()},
                              {"hdf5", build.hdf5},
                              {"fftw", std::string(fftw_version)},
                              {"ranks", world.size()},
                              {"threads", omp_get_max_threads()},
                              {"cuda", static_cast<bool>(cuda_device())},
                              {"processor", name(processor_level())}};
        fmt::print("{}\n", io::json_text(all));
        return io::exit_code::done;
    }
    io::Table table({"", ""}, "<<");
    table.row({"version", build.version});
    table.row({"git", build.git});
    table.row({"compiler", build.compiler});
    table.row({"flags", build.flags});
    table.row({"MPI", ParallelSession::library()});
    table.row({"HDF5", build.hdf5});
    table.row({"FFTW", fftw_version});
    table.row({"ranks", std::to_string(world.size())});
    table.row({"threads", fmt::format("{} a rank", omp_get_max_threads())});
    table.row({"devices", cuda_device()
                              ? fmt::format("CUDA ({} found), emulated", cuda_device_count())
                              : std::string("emulated; built without CUDA")});
    table.row({"processor", fmt::format("kernels for {}", name(processor_level()))});
    fmt::print("asperity {}\n", build.version);
    table.print(stdout);
    return io::exit_code::done;
}

} // namespace

Command info_command() {
    const auto given = std::make_shared<Arguments>();
    return {.options = {takes::quiet(*given), takes::json(*given)},
            .act = [given](const Communicator& world) { return print_info(given->json, world); }};
}

} // namespace asperity
