// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Means of a slide after its running-in: known noise and drift.
#include "engine/path/slide_average.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

using namespace asperity;

namespace {

/// Works and losses of a point.
Energies flows(double work, double in_block, double lost) {
    Energies all;
    all[Term::work] = work;
    all[Term::in_block] = in_block;
    all[Term::lost] = lost;
    return all;
}

/// A slide of this length in steps of 0.5 whose friction is a function of the distance.
SlideAverage slide(double length, const std::function<double(double)>& friction) {
    SlideAverage average;
    double work = 0.0;
    average.add({.flows = {}, .load = 10.0});
    for (double at = 0.5; at <= length; at += 0.5) {
        work += 0.5 * friction(at - 0.25);
        average.add({.distance = at,
                     .flows = flows(work, 0.75 * work, 0.25 * work),
                     .load = 10.0,
                     .in_contact = 100.0,
                     .mean_height = 2.0});
    }
    return average;
}

constexpr SlideAverage::Lengths lengths{20.0, 1.0};

} // namespace

TEST(SlideAverage, LeavesTheRunningInOut) {
    const auto friction = [](double s) { return 3.0 + 5.0 * std::exp(-s / 10.0); };
    const SlideAverage average = slide(400.0, friction);
    const auto means = average.means(lengths);
    ASSERT_TRUE(means);
    EXPECT_NEAR(means->friction, 3.0, 0.02);
    EXPECT_GT(means->running_in, 25.0);
    EXPECT_TRUE(means->steady);
    EXPECT_DOUBLE_EQ(means->load, 10.0);
    EXPECT_DOUBLE_EQ(means->in_contact, 100.0);
    EXPECT_NEAR(means->losses[Term::in_block], 0.75 * means->friction, 1e-9);
    EXPECT_NEAR(means->losses[Term::lost], 0.25 * means->friction, 1e-9);
    EXPECT_FALSE(slide(30.0, friction).is_steady(lengths)) << "less than three windows";
    EXPECT_FALSE(slide(400.0, [](double s) { return 3.0 + 0.002 * s; }).is_steady(lengths));
    EXPECT_FALSE(
        slide(400.0, [](double s) { return 3.0 + std::exp(-s / 500.0); }).is_steady(lengths))
        << "what is still to come counts";
}

/// Blocking does not see an energy that is missing in every step.
TEST(SlideAverage, FrictionThatIsNotDissipatedIsItsError) {
    SlideAverage average;
    for (double at = 0.0; at <= 400.0; at += 0.5)
        average.add({.distance = at, .flows = flows(3.0 * at, 2.5 * at, 0.3 * at)});
    const auto means = average.means(lengths);
    ASSERT_TRUE(means && means->steady);
    EXPECT_NEAR(means->friction_error, 0.2, 1e-9);
}

TEST(SlideAverage, FrictionOfAViscoelasticBlockIsWhatItDissipates) {
    SlideAverage dissipates, elastic;
    for (double at = 0.0; at <= 200.0; at += 0.5) {
        dissipates.add({.distance = at, .flows = flows(3.0 * at, 2.5 * at, 0.3 * at)});
        elastic.add({.distance = at, .flows = flows(3.0 * at, 0.0, 2.8 * at)});
    }
    EXPECT_NEAR(dissipates.means(lengths)->friction, 2.8, 1e-9);
    EXPECT_NEAR(elastic.means(lengths)->friction, 3.0, 1e-9);
}

TEST(SlideAverage, ErrorsKnowHowFarForcesHangTogether) {
    // Noise that keeps its value over stretches of eight: independent ones are fewer than bins.
    std::mt19937 random(11);
    std::normal_distribution<double> noise(0.0, 1.0);
    double squares = 0.0, judged = 0.0;
    constexpr int slides = 200;
    for (int i = 0; i < slides; ++i) {
        double value = noise(random);
        int stretch = -1;
        const auto means = slide(512.0, [&](double s) {
                               const int now = static_cast<int>(s / 32.0);
                               if (now != stretch) value = noise(random);
                               stretch = now;
                               return 5.0 + value;
                           }).means(lengths);
        squares += std::pow(means->friction - 5.0, 2) / slides;
        judged += std::pow(means->friction_error, 2) / slides;
    }
    EXPECT_NEAR(std::sqrt(judged / squares), 1.0, 0.35);
}

TEST(SlideAverage, AForceOfTheSitesLeavesTheMeanAlone) {
    const auto means = slide(303.0, [](double s) {
                           return 1.0 + 50.0 * std::sin(2.0 * 3.14159265358979 * s + 0.3);
                       }).means(lengths);
    EXPECT_NEAR(means->friction, 1.0, 1e-6);
}

TEST(SlideAverage, LongSlidesKeepFewerPoints) {
    const SlideAverage average = slide(20000.0, [](double) { return 2.0; });
    const auto means = average.means(lengths);
    EXPECT_NEAR(means->friction, 2.0, 1e-9);
    EXPECT_LT(means->friction_error, 1e-9);
}

TEST(SlideAverage, ErrorsOfTheMeshAndOfTheWayToTheWork) {
    const auto with = [](double edges, double left_out) {
        SlideAverage average;
        for (double at = 0.0; at <= 400.0; at += 0.5)
            average.add({.distance = at,
                         .flows = flows(3.0 * at, 3.0 * at, 0.0),
                         .load = 10.0,
                         .in_contact = 100.0,
                         .contact_edges = edges,
                         .work_left_out = left_out * at});
        return average;
    };
    const auto plain = with(0.0, 0.0).means(lengths);
    EXPECT_DOUBLE_EQ(plain->area, 100.0);
    EXPECT_NEAR(plain->area_error, 0.0, 1e-9);
    EXPECT_NEAR(plain->friction_error, 0.0, 1e-9);
    EXPECT_EQ(plain->mesh_error, 0.0);
    // The forces would give 3.1: that is an error of 0.1, whether the slide is steady or not.
    EXPECT_NEAR(with(0.0, 0.1).means(lengths)->friction, 3.0, 1e-9);
    EXPECT_NEAR(with(0.0, 0.1).means(lengths)->friction_error, 0.1, 1e-9);
    // Edges of 40 sites count 40 (pi - 1 + ln 2)/24 sites too much.
    const auto edges = with(40.0, 0.0).means(lengths);
    EXPECT_NEAR(edges->area, 100.0 - 40.0 * 0.118114, 1e-4);
    EXPECT_NEAR(edges->area_error, std::hypot(0.85 * std::sqrt(40.0), 0.15 * 40.0 * 0.118114),
                1e-4);
    // A map whose shortest wave is four sites.
    auto of_map = lengths;
    of_map.shortest_wave = 4.0 * lengths.spacing;
    EXPECT_GT(with(40.0, 0.0).means(of_map)->mesh_error, 0.0);
    EXPECT_NEAR(with(0.0, 0.0).means(of_map)->friction_error, 3.0 * 0.2 / 16.0, 1e-9);
    EXPECT_NEAR(with(40.0, 0.0).means(of_map)->friction_error,
                3.0 * 0.2 * std::hypot(1.0 / 16.0, 100.0 / edges->area - 1.0), 1e-9);
}
