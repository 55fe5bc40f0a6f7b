// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The start of the program `asperity`. In a wheel the Python module is the program
// (python/binding/program.cpp).
#include "engine/commands/program.hpp"

int main(int argc, char** argv) { return asperity::program(argc, argv); }
