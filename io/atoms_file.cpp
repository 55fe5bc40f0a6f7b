// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/atoms_file.hpp"

#include "io/error.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iterator>

#include <fmt/format.h>
#include <unistd.h>

namespace asperity::io {

namespace {

// Labels that every reader of XYZ knows as elements: X stands for no element.
constexpr std::array<const char*, 3> species = {"X", "X", "Au"};

/// Comment line of extended XYZ: the lattice, what the columns are, and what else is known.
std::string xyz_head(const AtomFrame& f) {
    std::string head = fmt::format("{}\nLattice=\"{:.8g} 0 0 0 {:.8g} 0 0 0 {:.8g}\" "
                                   "Origin=\"0 0 {:.8g}\" pbc=\"T T F\" "
                                   "Properties=species:S:1:pos:R:3:type:I:1",
                                   f.type.size(), f.edges[0], f.edges[1], f.edges[2], f.lowest);
    for (const AtomColumn& c : f.columns)
        head += fmt::format(":{}:{}:{}", c.name, c.integer ? 'I' : 'R', c.width);
    return head + fmt::format(" step={} time={:.8g}\n", f.step, f.time);
}

std::string dump_head(const AtomFrame& f) {
    std::string head =
        fmt::format("ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS pp pp ff\n"
                    "0 {:.8g}\n0 {:.8g}\n{:.8g} {:.8g}\nITEM: ATOMS id type x y z",
                    f.step, f.type.size(), f.edges[0], f.edges[1], f.lowest, f.lowest + f.edges[2]);
    for (const AtomColumn& c : f.columns)
        for (int k = 0; k < c.width; ++k)
            head += ' ' + (c.width == 1 ? c.name : c.name + fmt::format("[{}]", k + 1));
    return head + "\n";
}

} // namespace

AtomsFile::AtomsFile(const std::string& path, AtomFormat format)
    : path_(path), temporary_(fmt::format("{}.{}.tmp", path, ::getpid())), format_(format),
      file_(temporary_, std::ios::binary | std::ios::trunc) {
    if (!file_)
        throw FileError(path, "cannot be written", std::strerror(errno),
                        "check the permissions of its directory");
}

AtomsFile::~AtomsFile() {
    std::error_code ignored;
    if (file_.is_open()) std::filesystem::remove(temporary_, ignored);
}

void AtomsFile::append(const AtomFrame& f) {
    const bool xyz = format_ == AtomFormat::extended_xyz;
    fmt::memory_buffer text;
    const auto out = std::back_inserter(text);
    fmt::format_to(out, "{}", xyz ? xyz_head(f) : dump_head(f));
    for (std::size_t i = 0; i < f.type.size(); ++i) {
        const double* p = &f.position[3 * i];
        const int type = f.type[i];
        if (xyz)
            fmt::format_to(out, "{} {:.8g} {:.8g} {:.8g} {}", species.at(f.type[i]), p[0], p[1],
                           p[2], type);
        else
            fmt::format_to(out, "{} {} {:.8g} {:.8g} {:.8g}", i + 1, type, p[0], p[1], p[2]);
        for (const AtomColumn& c : f.columns)
            for (int k = 0; k < c.width; ++k) {
                const double v =
                    c.values[i * static_cast<std::size_t>(c.width) + static_cast<std::size_t>(k)];
                if (c.integer)
                    fmt::format_to(out, " {:.0f}", v);
                else
                    fmt::format_to(out, " {:.6g}", v);
            }
        text.push_back('\n');
    }
    file_.write(text.data(), static_cast<std::streamsize>(text.size()));
    if (!file_)
        throw FileError(path_, "cannot be written", std::strerror(errno),
                        "check the space on its disk");
}

void AtomsFile::close() {
    file_.close();
    std::error_code error;
    std::filesystem::rename(temporary_, path_, error);
    if (!file_ || error)
        throw FileError(path_, "cannot be put in its place",
                        error ? error.message() : "it could not be written to its end",
                        "check the permissions of its directory and the space on its disk");
}

} // namespace asperity::io
