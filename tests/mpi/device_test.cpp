// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Steps on the emulated device give the bits of the processor's: displacements, velocities and
// every record, on any number of ranks; and what is wrong with a device's memory shows. Reference:
// the processor's steps on one rank (same_bits_test).
//
// The emulated device runs the text that CUDA runs; what this cannot show is the code generator of
// a device's compiler, and speed.
#include "engine/device/device_block.hpp"
#include "engine/dynamics/simulation.hpp"
#include "engine/run/checkpoint.hpp"
#include "io/error.hpp"
#include "kernels/variant.hpp"
#include "support/cases.hpp"
#include "support/message.hpp"
#include "support/world.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <span>

#include <sys/mman.h>
#include <unistd.h>

using namespace asperity;

namespace {

using test::Trace, test::world;

struct Variant {
    const char* stack;
    int thickness, layers;
    bool mixed, damped, tail;
    bool on_ranks; ///< with more than one rank, too
    double temperature = 0.0;
    bool finite = false; ///< strain
    double poisson = 0.42;
    double ratio = 1.0;        ///< of the lattice constants
    std::size_t potential = 0; ///< of test::potentials()
};
// Shallow and deep: as in same_bits_test, cut on one level and on all but the last.
constexpr Variant cases[] = {{"shallow", 32, 3, false, true, false, true},
                             {"shallow", 32, 3, true, false, false, false},
                             {"shallow", 32, 3, false, false, true, false},
                             {"deep", 62, 2, false, true, false, true},
                             {"deep", 62, 2, true, true, true, false},
                             {"deep", 62, 2, false, false, false, false},
                             {"lattice", 6, 0, false, true, false, false},
                             {"lattice", 6, 0, true, false, false, true},
                             {"deep", 62, 2, false, true, false, true, 300.0},
                             {"shallow", 32, 3, false, true, false, true, 0.0, true},
                             {"lattice", 6, 0, true, false, false, false, 0.0, true, 0.25},
                             {"shallow", 32, 3, false, true, true, true, 0.0, false, 0.42, 1.6},
                             {"deep", 62, 2, true, true, false, true, 0.0, false, 0.42, 0.7},
                             {"lattice", 6, 0, false, true, true, false, 0.0, false, 0.42, 1.0, 1},
                             {"lattice", 6, 0, true, true, false, true, 0.0, false, 0.42, 1.6, 1},
                             {"lattice", 6, 0, false, true, false, true, 0.0, false, 0.42, 1.6, 2},
                             {"lattice", 6, 0, true, true, false, false, 0.0, false, 0.42, 1.0, 2}};
void PrintTo(const Variant& c, std::ostream* out) {
    *out << c.stack << (c.mixed ? ", mixed" : ", double") << (c.damped ? ", damped" : "")
         << (c.tail ? ", tail" : "") << (c.temperature > 0.0 ? ", warm" : "")
         << (c.finite ? ", finite strain" : "") << (c.ratio != 1.0 ? ", rows" : "")
         << std::array{"", ", Morse", ", table"}[c.potential];
}

SimulationOptions options_of(const Variant& c, bool on_device) {
    SimulationOptions options;
    options.block = test::paper_block(32, c.thickness, c.layers);
    options.block.finite_strain = c.finite;
    options.block.poisson = c.poisson;
    options.interface = test::paper_interface();
    options.interface.potential = test::potentials()[c.potential];
    options.interface.mixed = c.mixed;
    options.interface.tail = c.tail;
    options.drive.velocity = 1e-3; // 100 m/s: into contact soon
    options.drive.ramp = 500.0;
    if (c.damped) {
        options.damping = 1e-3;
        options.damping_from = 0.3;
        options.temperature = c.temperature;
    }
    if (on_device) options.device.kind = DeviceChoice::Kind::emulated;
    return options;
}

/// The same heights, on a lattice of another spacing.
Surface at_ratio(const Surface& from, double ratio) {
    Surface to = from;
    to.sites = substrate_sites(from.sites, ratio);
    to.height.clear();
    for (int j = 0; j < to.sites; ++j)
        for (int i = 0; i < to.sites; ++i)
            to.height.push_back(from.height[static_cast<std::size_t>(
                j * from.sites / to.sites * from.sites + i * from.sites / to.sites)]);
    return to;
}

Simulation make(const Variant& c, const Communicator& ranks, bool on_device) {
    const SimulationOptions options = options_of(c, on_device);
    Surface surface = test::reference_surface("c3_N32_T32_rms1.5");
    if (c.ratio != 1.0) surface = at_ratio(surface, c.ratio);
    return Simulation(options, surface, ranks, test::grid_for(options.block, ranks));
}

constexpr double height = 6.0;
/// Atoms that do not stand below the hollows of the block's lattice are met earlier.
double height_of(const Variant& c) { return c.ratio == 1.0 ? height : height + 1.2; }
constexpr int steps = 200;

Trace run(const Variant& c, const Communicator& ranks, bool on_device, int count = steps) {
    Simulation s = make(c, ranks, on_device);
    s.start(height_of(c));
    Trace trace;
    trace.follow(s, count);
    trace.conclude(s);
    return trace;
}

/// The reference, on every rank.
Trace on_processor(const Variant& c) {
    return test::from_root([&] { return run(c, Communicator(), false); });
}

/// Settings of the emulated device for as long as it lives.
class Emulated {
public:
    explicit Emulated(const EmulatedSettings& settings) { emulated_settings() = settings; }
    ~Emulated() { emulated_settings() = {}; }
    Emulated(const Emulated&) = delete;
    Emulated& operator=(const Emulated&) = delete;
};

template <class Test>
class WhereItFuses : public Test {
    void SetUp() override {
        if (!fuses(processor_level()))
            GTEST_SKIP() << "refused on this processor: no fused multiply-add";
    }
};
class Device : public WhereItFuses<testing::TestWithParam<Variant>> {};
class OneDevice : public WhereItFuses<testing::Test> {};

} // namespace

TEST_P(Device, StepsHaveTheBitsOfTheProcessor) {
    const Variant& c = GetParam();
    if (world().size() > 1 && !c.on_ranks) return;
    const Trace expected = on_processor(c);
    EXPECT_GT(expected.in_contact, 100) << "the scene must touch, or nothing is tested";
    const Trace mine = run(c, world(), true);
    if (c.finite && processor_level() == ProcessorLevel::v4) { // whose inverse root has other bits
        EXPECT_NEAR(mine.force, expected.force, 1e-9 * std::abs(expected.force));
        return;
    }
    EXPECT_EQ(mine.state, expected.state) << "displacements and velocities";
    EXPECT_EQ(mine.records, expected.records);
    EXPECT_EQ(mine.in_contact, expected.in_contact);
}
INSTANTIATE_TEST_SUITE_P(Stacks, Device, testing::ValuesIn(cases));

TEST_F(OneDevice, CheckpointsCrossBetweenDeviceAndProcessor) {
    const Variant& c = cases[0];
    const Trace expected = on_processor(c);
    for (const bool device_first : {true, false}) {
        const test::SharedScratch scratch("device_test");
        Trace trace;
        {
            Simulation s = make(c, world(), device_first);
            s.start(height);
            trace.follow(s, steps / 2);
            write_checkpoint(scratch.file, s, {}, "");
            Trace beyond; // the state goes on after it has been read
            beyond.follow(s, 10);
        }
        Simulation s = make(c, world(), !device_first);
        read_checkpoint(scratch.file, s, "");
        trace.follow(s, steps - steps / 2);
        trace.conclude(s);
        EXPECT_EQ(trace, expected) << (device_first ? "device first" : "processor first");
    }
}

TEST_F(OneDevice, WhatTheHostWritesReachesTheDevice) {
    std::array<Trace, 2> traces;
    for (const bool on_device : {false, true}) {
        Simulation s = make(cases[0], world(), on_device);
        Trace& trace = traces[on_device];
        s.start(height);
        trace.follow(s, 15);
        Block& block = s.block_to_write();
        block.fields(block.levels()[0]).v.view().x(1, 2, 0) =
            1e-3; // all ranks, each in its own tile
        trace.follow(s, 15);
        trace.conclude(s);
    }
    EXPECT_EQ(traces[0], traces[1]);
}

TEST_F(OneDevice, ReadingCostsNoUploadAndNoLaunch) {
    // The one upload is of the start. Looking at the state, in a checkpoint or a snapshot too, adds
    // none, and throws away no forces that were launched for the next step.
    Simulation s = make(cases[0], world(), true);
    s.start(height);
    Trace trace;
    Snapshot snapshot;
    for (int n = 0; n < 4; ++n) {
        trace.follow(s, 5);
        trace.state = test::fingerprint(s.block());
        snapshot.take(s);
    }
    EXPECT_EQ(s.phases()[Phase::exchange].calls, 20 + 1);
    s.block_to_write();
    trace.follow(s, 1);
    EXPECT_EQ(s.phases()[Phase::exchange].calls, 21 + 2);
}

TEST_F(OneDevice, NoResultDependsOnTheOrderOfItsThreads) {
    if (world().size() > 1) return;
    const Trace expected = run(cases[0], world(), true, 60);
    for (unsigned order : {1u, 2u, 77u}) {
        const Emulated in_order({.order = order});
        EXPECT_EQ(run(cases[0], world(), true, 60), expected) << "order " << order;
    }
}

// Late (all other tests) and at once: what lies between has the same bits if every read waits for
// its write, and every write for the reads before it.
TEST_F(OneDevice, NoResultDependsOnWhenItsQueueIsWorkedOff) {
    const Trace late = run(cases[3], world(), true, 60);
    const Emulated at_once({.at_once = true});
    EXPECT_EQ(run(cases[3], world(), true, 60), late);
}

TEST_F(OneDevice, MpiMayTakeItsMemory) {
    if (world().size() == 1) return;
    const Trace by_way_of_the_host = run(cases[3], world(), true, 60);
    const Emulated direct({.open_to_mpi = true});
    EXPECT_EQ(run(cases[3], world(), true, 60), by_way_of_the_host);
}

TEST_F(OneDevice, ThatIsLostOrTooSmallIsSaid) {
    if (world().size() > 1) return;
    const auto message = [](auto&& work) { return test::message_of<io::FileError>(work); };
    {
        const Emulated small({.memory = 1 << 16});
        const std::string text = message([] { make(cases[0], world(), true); });
        EXPECT_NE(text.find("the allocation of its memory failed"), std::string::npos) << text;
        EXPECT_NE(text.find("out of memory"), std::string::npos) << text;
    }
    Simulation s = make(cases[0], world(), true);
    s.start(height);
    Trace trace;
    trace.follow(s, 5);
    const Emulated lost({.lost_after = 7});
    const std::string text = message([&] { trace.follow(s, 5); });
    EXPECT_NE(text.find("the device is lost"), std::string::npos) << text;
    EXPECT_NE(text.find("resume from the last checkpoint"), std::string::npos) << text;
}

TEST_F(OneDevice, ItsMemoryIsGivenBackWhereTheConstructorFails) {
    // The copies of the tables fail. The emulated device has room for 64 blocks at a time.
    if (world().size() > 1) return;
    for (int n = 0; n < 100; ++n) {
        const Emulated lost({.lost_after = 0});
        EXPECT_THROW(make(cases[0], world(), true), io::FileError);
    }
    EXPECT_NO_THROW(make(cases[0], world(), true));
}

TEST_F(OneDevice, TimesEveryStepByItsOwnClock) {
    Simulation s = make(cases[3], world(), true);
    s.start(height);
    Trace trace;
    trace.follow(s, 25);
    for (Phase phase : {Phase::interpolate, Phase::interface, Phase::advance, Phase::sums})
        EXPECT_EQ(s.phases()[phase].calls, 25) << static_cast<int>(phase);
    EXPECT_GT(s.phases()[Phase::advance].seconds, 0.0);
    trace.follow(s, 5);
    EXPECT_EQ(s.phases()[Phase::advance].calls, 30) << "none twice";
}

TEST_F(OneDevice, NeverTouchesTheFieldsOfTheHost) {
    if (world().size() > 1) return;
    const auto end = [](const Variant& c) { // in a process of its own, for the pages stay closed
        Simulation s = make(c, Communicator(), true);
        s.start(height);
        Trace trace;
        trace.follow(s, 1);
        const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
        int closed = 0;
        const auto close = [&](const auto& values) {
            const auto at = reinterpret_cast<std::uintptr_t>(values.data());
            const std::uintptr_t first = (at + page - 1) / page * page,
                                 last = (at + values.size_bytes()) / page * page;
            if (first >= last) return;
            mprotect(reinterpret_cast<void*>(first), last - first, PROT_NONE);
            ++closed;
        };
        for (const auto& level : s.block().levels())
            for (const VectorField<double>* field : {&level.u, &level.v})
                for (const Field<double>* f : {&field->x, &field->y, &field->z})
                    close(f->storage());
        const Interface::Tables tables = s.interface().tables();
        const int fields = closed;
        close(tables.heights->in_double().storage());
        close(tables.map);
        if (tables.mean_height) close(tables.mean_height->storage());
        if (const auto* p = std::get_if<Tabulated>(&s.interface().options().potential))
            close(std::span(p->cubics, 4 * static_cast<std::size_t>(p->intervals)));
        if (fields < 6 || closed != fields + 3) _exit(1);
        trace.follow(s, 20);
        _exit(0);
    };
    // With a tail, and with a table for a potential.
    for (const Variant& c : {cases[2], cases[15]})
        EXPECT_EXIT(end(c), testing::ExitedWithCode(0), "") << testing::PrintToString(c);
}

TEST(EmulatedDevice, AHostThatReadsItsMemoryStops) {
    if (world().size() > 1) return;
    const DeviceFunctions& device = emulated_device();
    std::byte* memory = nullptr;
    ASSERT_EQ(device.allocate(0, 4096, &memory), nullptr);
    const double one = 1.0;
    double back = 0.0;
    EXPECT_EQ(device.upload(memory, &one, sizeof one), nullptr);
    EXPECT_EQ(device.download(&back, memory, sizeof back), nullptr);
    EXPECT_EQ(back, one);
    EXPECT_EXIT(
        {
            volatile double read = *reinterpret_cast<double*>(memory);
            (void)read;
        },
        testing::KilledBySignal(SIGSEGV), "");
    device.release(memory);
}

TEST_F(OneDevice, TakesTheMemoryThatWasCounted) {
    for (const Variant& c : cases) {
        const SimulationOptions options = options_of(c, true);
        const Simulation s = make(c, world(), true);
        EXPECT_EQ(s.device_bytes(),
                  DeviceBlock::bytes_for(options.block, test::grid_for(options.block, world()),
                                         options.interface, s.interface().substrate_sites()));
        EXPECT_EQ(make(c, world(), false).device_bytes(), 0u) << "off: no byte";
    }
}
