// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A network between network namespaces of this machine, with a latency and a bandwidth. For kernels
// without the queueing discipline netem; for measurements only (hosts.py).
//
//     build/release/perf/wire MICROSECONDS GBIT/S PID ...
//
// Each PID is a process in a namespace of its own. There the network is the device wire0 (TUN: what
// is sent by it comes here as IP packets). The packet to 10.77.0.N goes to the N-th namespace. It
// arrives when it has left the sender at the bandwidth (0: at once), and after the latency. Prints
// a line when the devices are there; ends when its standard input does.
#include <fcntl.h>
#include <linux/if.h>
#include <linux/if_tun.h>
#include <poll.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <string>
#include <vector>

namespace {

using Clock = std::chrono::steady_clock;

struct Packet {
    Clock::time_point due;
    std::vector<char> bytes;
};

struct Host {
    int device = -1;
    Clock::time_point sends_until; ///< when its last packet has left
    std::deque<Packet> sent;       ///< on their way, in order
};

[[noreturn]] void fail(const std::string& what) {
    std::fprintf(stderr, "wire: %s: %s\n", what.c_str(), std::strerror(errno));
    std::exit(1);
}

int device_in(const std::string& pid) {
    const std::string path = "/proc/" + pid + "/ns/net";
    const int space = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (space < 0 || setns(space, CLONE_NEWNET) != 0) fail(path);
    close(space);
    const int device = open("/dev/net/tun", O_RDWR | O_NONBLOCK | O_CLOEXEC);
    if (device < 0) fail("/dev/net/tun");
    ifreq request{};
    request.ifr_flags = IFF_TUN | IFF_NO_PI;
    std::strcpy(request.ifr_name, "wire0");
    if (ioctl(device, TUNSETIFF, &request) != 0) fail("wire0");
    return device;
}

} // namespace

int main(int argc, char** argv) {
    if (argc < 5) {
        std::fprintf(stderr, "usage: wire MICROSECONDS GBIT/S PID PID ...\n");
        return 2;
    }
    const std::chrono::duration<double> latency(1e-6 * std::atof(argv[1]));
    const double seconds_a_byte = std::atof(argv[2]) > 0.0 ? 8e-9 / std::atof(argv[2]) : 0.0;
    std::vector<Host> hosts(static_cast<std::size_t>(argc - 3));
    for (std::size_t i = 0; i < hosts.size(); ++i)
        hosts[i].device = device_in(argv[i + 3]);
    // Ahead of the ranks, which poll without end and leave no processor idle.
    const sched_param priority{1};
    if (sched_setscheduler(0, SCHED_FIFO, &priority) != 0)
        std::fprintf(stderr, "wire: no real-time priority: packets will be late\n");
    std::puts("ready");
    std::fflush(stdout);

    std::vector<pollfd> watched = {{0, POLLIN, 0}};
    for (const Host& host : hosts)
        watched.push_back({host.device, POLLIN, 0});
    std::vector<char> buffer(65536);
    for (;;) {
        auto next = Clock::time_point::max();
        for (Host& host : hosts) {
            while (!host.sent.empty() && host.sent.front().due <= Clock::now()) {
                const auto& bytes = host.sent.front().bytes;
                const auto to = static_cast<std::size_t>(static_cast<unsigned char>(bytes[19])) - 1;
                // What a device refuses is lost, as in any network; TCP sends it again.
                [[maybe_unused]] ssize_t taken = 0;
                if (to < hosts.size()) taken = write(hosts[to].device, bytes.data(), bytes.size());
                host.sent.pop_front();
            }
            if (!host.sent.empty()) next = std::min(next, host.sent.front().due);
        }
        timespec wait{}, *until = nullptr;
        if (next != Clock::time_point::max()) {
            const auto left = std::chrono::nanoseconds(next - Clock::now()).count();
            wait = {std::max(left, 0L) / 1000000000, std::max(left, 0L) % 1000000000};
            until = &wait;
        }
        ppoll(watched.data(), watched.size(), until, nullptr);
        if (watched[0].revents != 0) return 0;
        for (std::size_t i = 0; i < hosts.size(); ++i) {
            if (watched[i + 1].revents == 0) continue;
            Host& host = hosts[i];
            for (ssize_t got; (got = read(host.device, buffer.data(), buffer.size())) > 0;) {
                if (got < 20 || (buffer[0] >> 4) != 4) continue; // IPv4
                const auto now = Clock::now();
                const std::chrono::duration<double> takes(seconds_a_byte *
                                                          static_cast<double>(got));
                host.sends_until = std::max(now, host.sends_until) +
                                   std::chrono::duration_cast<Clock::duration>(takes);
                host.sent.push_back(
                    {host.sends_until + std::chrono::duration_cast<Clock::duration>(latency),
                     {buffer.data(), buffer.data() + got}});
            }
        }
    }
}
