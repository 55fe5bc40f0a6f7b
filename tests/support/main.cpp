// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// main() of every test program:
//
//     test_engine block_test simulation_test     runs the tests of these two files
//     test_engine                                runs all
//
// GoogleTest's own options work as well; a --gtest_filter goes without names of files. A name
// without tests is an error. Under mpirun all ranks run all tests; the program fails if any rank
// saw a failure, and the ranks but the first print failures alone.
#include "support/world.hpp"

#include <cstdio>
#include <filesystem>
#include <set>
#include <string>

#include <gtest/gtest.h>
#include <omp.h>

namespace asperity::test {
namespace {

const Communicator* the_world = nullptr;

/// Of the ranks that are not the first: failures alone.
class FailuresOnly : public testing::EmptyTestEventListener {
    void OnTestPartResult(const testing::TestPartResult& result) override {
        if (result.failed())
            std::fprintf(stderr, "rank %d: %s:%d: %s\n", world().rank(), result.file_name(),
                         result.line_number(), result.summary());
    }
};

/// Fails a test that leaves another number of threads to the next one.
class ThreadsAreRestored : public testing::EmptyTestEventListener {
    void OnTestStart(const testing::TestInfo&) override { before_ = omp_get_max_threads(); }
    void OnTestEnd(const testing::TestInfo&) override {
        EXPECT_EQ(omp_get_max_threads(), before_) << "see support/threads.hpp";
        omp_set_num_threads(before_);
    }
    int before_ = 1;
};

/// The names of all tests of the named files ("block_test"), as a filter; removes from `missing`
/// what was found.
std::string tests_of(const std::set<std::string>& files, std::set<std::string>& missing) {
    std::string filter;
    const auto& tests = *testing::UnitTest::GetInstance();
    for (int s = 0; s < tests.total_test_suite_count(); ++s) {
        const auto& suite = *tests.GetTestSuite(s);
        for (int t = 0; t < suite.total_test_count(); ++t) {
            const auto& test = *suite.GetTestInfo(t);
            const std::string file = std::filesystem::path(test.file()).stem();
            if (!files.contains(file)) continue;
            missing.erase(file);
            filter += std::string(filter.empty() ? "" : ":") + suite.name() + "." + test.name();
        }
    }
    return filter;
}

} // namespace

const Communicator& world() { return *the_world; }

} // namespace asperity::test

int main(int argc, char** argv) {
    using namespace asperity;
    const ParallelSession session(argc, argv);
    if (session.unconnected() > 0) {
        std::fprintf(stderr, "%d processes were started, and MPI connects none of them\n",
                     session.unconnected());
        return 2;
    }
    test::the_world = &session.world();
    testing::InitGoogleTest(&argc, argv);
    if (argc > 1) {
        const std::set<std::string> files(argv + 1, argv + argc);
        std::set<std::string> missing = files;
        const std::string filter = test::tests_of(files, missing);
        for (const std::string& name : missing)
            std::fprintf(stderr, "no tests in a file %s.cpp of this program\n", name.c_str());
        if (!missing.empty()) return 2;
        testing::GTEST_FLAG(filter) = filter;
    }
    auto& listeners = testing::UnitTest::GetInstance()->listeners();
    listeners.Append(new test::ThreadsAreRestored);
    if (!session.world().root()) {
        delete listeners.Release(listeners.default_result_printer());
        listeners.Append(new test::FailuresOnly);
    }
    return session.world().max(RUN_ALL_TESTS() == 0 ? 0.0 : 1.0) == 0.0 ? 0 : 1;
}
