// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Work that may crash, in a process of its own.
//
// The child is forked, not started anew: it works in every program that links this library, tests
// and Python included. fork() after MPI_Init is allowed as long as the child calls neither MPI nor
// exit(), and does not write to memory that a network card reads: it has copies of all pages, runs
// on the calling thread alone, writes to its pipe and ends by _exit(). Maps are read before the
// first exchange between ranks.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace asperity::io {

/// The child's end of the pipe. Everything or nothing: false if the reader is gone.
bool write_all(int pipe, const void* data, std::size_t bytes);
/// The parent's. False if the child ended before.
bool read_all(int pipe, void* data, std::size_t bytes);

/// Runs work(pipe) in a child, and take(pipe) here meanwhile. Returns how the child ended if not
/// well ("by signal 11 (Segmentation fault)"), else nothing. seconds: of processor time for the
/// child. What the child prints is lost. Throws std::system_error if no process can be made.
std::string in_child_process(unsigned seconds, const std::function<void(int)>& work,
                             const std::function<void(int)>& take);

} // namespace asperity::io
