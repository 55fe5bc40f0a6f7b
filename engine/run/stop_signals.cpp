// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/run/stop_signals.hpp"

#include <array>
#include <csignal>

#include <signal.h>

namespace asperity::stop_signals {

namespace {

constexpr std::array stopping = {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGUSR2, SIGXCPU};
constexpr std::array harmless = {SIGPIPE, SIGXFSZ};

volatile std::sig_atomic_t last = 0;
std::array<struct sigaction, stopping.size() + harmless.size()> before;

extern "C" void on_stop(int signal) {
    if (signal == SIGINT && last == SIGINT) { // somebody cannot wait for the checkpoint
        std::signal(SIGINT, SIG_DFL);
        std::raise(SIGINT);
        return;
    }
    last = signal;
}

} // namespace

void catch_all() {
    struct sigaction action {};
    action.sa_handler = on_stop;
    action.sa_flags = SA_RESTART;
    sigset_t blocked;
    sigemptyset(&blocked);
    for (std::size_t i = 0; i < stopping.size(); ++i) {
        sigaction(stopping[i], nullptr, &before[i]);
        if (before[i].sa_handler != SIG_IGN) sigaction(stopping[i], &action, nullptr);
        sigaddset(&blocked, stopping[i]);
    }
    action.sa_handler = SIG_IGN;
    for (std::size_t i = 0; i < harmless.size(); ++i)
        sigaction(harmless[i], &action, &before[stopping.size() + i]);
    pthread_sigmask(SIG_UNBLOCK, &blocked, nullptr);
}

void release() {
    for (std::size_t i = 0; i < stopping.size(); ++i)
        sigaction(stopping[i], &before[i], nullptr);
    sigaction(SIGPIPE, &before[stopping.size()], nullptr);
    if (last != 0) std::raise(last);
}

bool caught() { return last != 0; }

} // namespace asperity::stop_signals
