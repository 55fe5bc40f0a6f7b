// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Steps on the emulated device, and on a CUDA device where there is one, give the bits of the
// processor's: displacements, velocities and every record, on any number of ranks; and what is
// wrong with a device's memory is reported.
// Reference: the processor's steps on one rank (same_bits_test).
#include "engine/device/device_block.hpp"
#include "engine/dynamics/simulation.hpp"
#include "io/error.hpp"
#include "kernels/variant.hpp"
#include "support/cases.hpp"
#include "support/message.hpp"
#include "support/simulation_checkpoint.hpp"
#include "support/threads.hpp"
#include "support/world.hpp"

#include <gtest/gtest.h>

#include <array>
#include <csignal>
#include <cstdint>
#include <span>
#include <vector>

#include <sys/mman.h>
#include <unistd.h>

using namespace asperity;

namespace {

using test::Trace, test::world;

struct Variant {
    const char* stack;
    int thickness, layers;
    bool damped, tail;
    bool on_ranks; ///< with more than one rank, too
    double temperature = 0.0;
    std::size_t potential = 0; ///< of test::potentials()
    double spring = 0.0;       ///< stiffness of the spring that holds the top plane, eV/Å^2
};
// Shallow and deep: as in same_bits_test, cut on one level and on all but the last.
constexpr Variant cases[] = {
    {"shallow", 32, 3, true, false, true},        {"shallow", 32, 3, false, true, false},
    {"deep", 62, 2, true, false, true},           {"deep", 62, 2, false, false, false},
    {"lattice", 6, 0, true, false, false},        {"lattice", 6, 0, false, false, true},
    {"deep", 62, 2, true, false, true, 300.0},    {"lattice", 6, 0, true, true, false, 0.0, 1},
    {"lattice", 6, 0, true, false, true, 0.0, 2}, {"deep", 62, 2, true, false, true, 0.0, 0, 20.0}};
constexpr const Variant &with_tail = cases[1], &with_table = cases[8];
void PrintTo(const Variant& c, std::ostream* out) {
    *out << c.stack << (c.damped ? ", damped" : "") << (c.tail ? ", tail" : "")
         << (c.temperature > 0.0 ? ", warm" : "")
         << std::array{"", ", Morse", ", table"}[c.potential] << (c.spring > 0.0 ? ", spring" : "");
}

constexpr DeviceChoice processor, emulated{DeviceChoice::Kind::emulated};
/// Returns the emulated device and, where there is one, a CUDA device, which all ranks share.
std::vector<DeviceChoice> devices() {
    std::vector<DeviceChoice> all{emulated};
    if (cuda_device() && cuda_device_count() > 0) all.push_back({DeviceChoice::Kind::cuda, 0});
    return all;
}

SimulationOptions options_of(const Variant& c, const DeviceChoice& device) {
    SimulationOptions options;
    options.block = test::paper_block(32, c.thickness, c.layers);
    options.block.top_spring.stiffness = c.spring;
    options.interface = test::paper_interface();
    options.interface.potential = test::potentials()[c.potential];
    options.interface.tail = c.tail;
    options.drive.velocity = 1e-3; // 100 m/s: into contact soon
    options.drive.ramp = 500.0;
    if (c.damped) {
        options.damping = 1e-3;
        options.damping_from = 0.3;
        options.temperature = c.temperature;
    }
    options.device = device;
    return options;
}

test::Driven make(const Variant& c, const Communicator& ranks, const DeviceChoice& device) {
    const SimulationOptions options = options_of(c, device);
    return test::Driven(options, test::reference_surface("c3_N32_T32_rms1.5"), ranks,
                        test::grid_for(options.block, ranks));
}

constexpr double height = 6.0;
constexpr int steps = 200;

Trace run(const Variant& c, const Communicator& ranks, const DeviceChoice& device,
          int count = steps) {
    test::Driven s = make(c, ranks, device);
    s.start(height);
    Trace trace;
    trace.follow(s, count);
    trace.conclude(s);
    return trace;
}

/// Steps `before`, lets the host write to the block, and steps `after`.
template <class Write>
Trace run_with(const Write& write, const DeviceChoice& device, int before, int after) {
    test::Driven s = make(cases[0], world(), device);
    s.start(height);
    Trace trace;
    trace.follow(s, before);
    write(s.block_to_write());
    trace.follow(s, after);
    trace.conclude(s);
    return trace;
}

/// The reference, on every rank.
Trace on_processor(const Variant& c) {
    return test::from_root([&] { return run(c, Communicator(), processor); });
}

/// Settings of the emulated device for as long as it lives.
class Emulated {
public:
    explicit Emulated(const EmulatedSettings& settings) { emulated_settings() = settings; }
    ~Emulated() { emulated_settings() = {}; }
    Emulated(const Emulated&) = delete;
    Emulated& operator=(const Emulated&) = delete;
};

class OneDevice : public testing::Test {
    void SetUp() override {
        if (!fuses(processor_level())) GTEST_SKIP() << "refused: no fused multiply-add here";
    }
};
class Device : public OneDevice, public testing::WithParamInterface<Variant> {};

} // namespace

TEST_P(Device, StepsHaveTheBitsOfTheProcessor) {
    const Variant& c = GetParam();
    if (world().size() > 1 && !c.on_ranks) return;
    const Trace expected = on_processor(c);
    EXPECT_GT(expected.in_contact, 100) << "the scene must touch, or nothing is tested";
    for (const DeviceChoice& device : devices()) {
        SCOPED_TRACE(describe_device(device));
        const Trace mine = run(c, world(), device);
        EXPECT_EQ(mine.state, expected.state) << "displacements and velocities";
        EXPECT_EQ(mine.records, expected.records);
        EXPECT_EQ(mine.in_contact, expected.in_contact);
    }
}
INSTANTIATE_TEST_SUITE_P(Stacks, Device, testing::ValuesIn(cases));

TEST_F(OneDevice, CheckpointsCrossBetweenDeviceAndProcessor) {
    const Variant& c = cases[0];
    const Trace expected = on_processor(c);
    for (const DeviceChoice& device : devices())
        for (const bool device_first : {true, false}) {
            SCOPED_TRACE(describe_device(device));
            const test::SharedScratch scratch("device_test");
            Trace trace;
            {
                test::Driven s = make(c, world(), device_first ? device : processor);
                s.start(height);
                trace.follow(s, steps / 2);
                test::write_checkpoint(scratch.file, s, {}, "");
                Trace beyond; // the state goes on after it has been read
                beyond.follow(s, 10);
            }
            test::Driven s = make(c, world(), device_first ? processor : device);
            test::read_checkpoint(scratch.file, s, "");
            trace.follow(s, steps - steps / 2);
            trace.conclude(s);
            EXPECT_EQ(trace, expected) << (device_first ? "device first" : "processor first");
        }
}

TEST_F(OneDevice, WhatTheHostWritesReachesTheDevice) {
    const auto write = [](Block& block) { // on all ranks, each in its own tile
        block.fields(block.levels()[0]).v.view().x(1, 2, 0) = 1e-3;
    };
    const Trace expected = run_with(write, processor, 15, 15);
    for (const DeviceChoice& device : devices())
        EXPECT_EQ(run_with(write, device, 15, 15), expected) << describe_device(device);
}

TEST_F(OneDevice, SitesDisplacedBeyondTheTablesAreSummedWhereTheyAre) {
    const auto displace = [](Block& block) { // by more than two spacings, in each rank's own tile
        block.fields(block.levels()[0]).u.view().x(1, 2, 0) += 2.4 * block.options().spacing;
    };
    const Trace expected = run_with(displace, processor, 180, 2);
    for (const DeviceChoice& device : devices())
        EXPECT_EQ(run_with(displace, device, 180, 2), expected) << describe_device(device);
}

TEST_F(OneDevice, NoResultDependsOnTheOrderOfItsThreads) {
    if (world().size() > 1) return;
    const Trace expected = run(cases[0], world(), emulated, 60);
    for (unsigned order : {1u, 2u, 77u}) {
        const Emulated in_order({.order = order});
        EXPECT_EQ(run(cases[0], world(), emulated, 60), expected) << "order " << order;
    }
}

TEST_F(OneDevice, ThatIsLostOrTooSmallIsSaid) {
    if (world().size() > 1) return;
    const auto message = [](auto&& work) { return test::message_of<io::FileError>(work); };
    {
        const Emulated small({.memory = 1 << 16});
        const std::string text = message([] { make(cases[0], world(), emulated); });
        EXPECT_NE(text.find("the allocation of its memory failed"), std::string::npos) << text;
        EXPECT_NE(text.find("out of memory"), std::string::npos) << text;
    }
    test::Driven s = make(cases[0], world(), emulated);
    s.start(height);
    Trace trace;
    trace.follow(s, 5);
    const Emulated lost({.lost_after = 7});
    const std::string text = message([&] { trace.follow(s, 5); });
    EXPECT_NE(text.find("the device is lost"), std::string::npos) << text;
    EXPECT_NE(text.find("resume from the last checkpoint"), std::string::npos) << text;
}

TEST_F(OneDevice, NeverTouchesTheFieldsOfTheHost) {
    if (world().size() > 1) return;
    const test::Threads one(1);             // a process has no other threads after fork()
    const auto end = [](const Variant& c) { // in a process of its own, for the pages stay closed
        test::Driven s = make(c, Communicator(), emulated);
        s.start(height);
        Trace trace;
        trace.follow(s, 1);
        const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
        int closed = 0;
        const auto close = [&](const auto& values) { // whole pages
            const auto at = reinterpret_cast<std::uintptr_t>(values.data());
            const std::uintptr_t first = (at + page - 1) / page * page,
                                 last = (at + values.size_bytes()) / page * page;
            if (first < last)
                closed += !mprotect(reinterpret_cast<void*>(first), last - first, PROT_NONE);
        };
        for (const auto& level : s.block().levels())
            for (const VectorField<double>* field : {&level.u, &level.v})
                close(field->x.storage()), close(field->y.storage()), close(field->z.storage());
        const Interface::Tables tables = s.interface().tables();
        const int fields = closed;
        close(tables.lattice->heights().field().storage());
        close(tables.map);
        if (tables.mean_height) close(tables.mean_height->storage());
        if (const auto* p = std::get_if<Tabulated>(&s.interface().options().potential))
            close(std::span(p->cubics, 4 * static_cast<std::size_t>(p->intervals)));
        if (fields < 6 || closed != fields + 3) _exit(1);
        trace.follow(s, 20);
        _exit(0);
    };
    for (const Variant& c : {with_tail, with_table})
        EXPECT_EXIT(end(c), testing::ExitedWithCode(0), "") << testing::PrintToString(c);
}

TEST(EmulatedDevice, AHostThatReadsItsMemoryStops) {
    if (world().size() > 1) return;
    const DeviceFunctions& device = emulated_device();
    std::byte* memory = nullptr;
    ASSERT_EQ(device.allocate(0, 4096, &memory), nullptr);
    const double one = 1.0;
    double back = 0.0;
    EXPECT_EQ(device.copy(memory, &one, sizeof one), nullptr);
    EXPECT_EQ(device.copy(&back, memory, sizeof back), nullptr);
    EXPECT_EQ(back, one);
    EXPECT_EXIT(
        {
            volatile double read = *reinterpret_cast<double*>(memory);
            (void)read;
        },
        testing::KilledBySignal(SIGSEGV), "");
    device.release(memory);
}
