// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "support/parallel_main.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>

namespace asperity::test {

namespace {

const Communicator* the_world = nullptr;

/// Of the ranks that are not the first: failures alone.
class Quiet : public testing::EmptyTestEventListener {
    void OnTestPartResult(const testing::TestPartResult& result) override {
        if (result.failed())
            std::fprintf(stderr, "rank %d: %s:%d: %s\n", world().rank(), result.file_name(),
                         result.line_number(), result.summary());
    }
};

} // namespace

const Communicator& world() { return *the_world; }

} // namespace asperity::test

int main(int argc, char** argv) {
    asperity::ParallelSession session(argc, argv);
    asperity::test::the_world = &session.world();
    testing::InitGoogleTest(&argc, argv);
    if (!session.world().root()) {
        auto& listeners = testing::UnitTest::GetInstance()->listeners();
        delete listeners.Release(listeners.default_result_printer());
        listeners.Append(new asperity::test::Quiet);
    }
    std::array<double, 1> failed = {RUN_ALL_TESTS() == 0 ? 0.0 : 1.0};
    session.world().max(failed);
    return failed[0] == 0.0 ? 0 : 1;
}
