// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/error.hpp"
#include "io/hdf5_file.hpp"
#include "io/run_h5.hpp"

#include "support/scratch.hpp"

#include <cmath>
#include <numeric>

namespace asperity::io {
namespace {

template <class T>
class RoundTrip : public testing::Test {};
using Types = testing::Types<double, float, std::int64_t, std::int32_t, std::uint8_t>;
TYPED_TEST_SUITE(RoundTrip, Types);

TYPED_TEST(RoundTrip, Dataset) {
    using T = TypeParam;
    const Scratch scratch;
    std::vector<T> data(24);
    std::iota(data.begin(), data.end(), T(1));
    {
        Hdf5File file(scratch / "a.h5", Hdf5File::Mode::create);
        file.write<T>("/deep/down/data", {2, 3, 4}, data);
        file.close();
    }
    const Hdf5File file(scratch / "a.h5", Hdf5File::Mode::read);
    EXPECT_EQ(file.shape("/deep/down/data"), (Hdf5File::Shape{2, 3, 4}));
    EXPECT_EQ(file.read<T>("/deep/down/data"), data);
    EXPECT_EQ(file.members("/deep"), std::vector<std::string>{"down"});
    EXPECT_TRUE(file.is_dataset("/deep/down/data"));
    EXPECT_FALSE(file.is_dataset("/deep/down"));
    EXPECT_FALSE(file.exists("/deep/up/data"));
}

TEST(Hdf5File, Attributes) {
    const Scratch scratch;
    Hdf5File file(scratch / "a.h5", Hdf5File::Mode::create);
    file.make_group("/g");
    file.write_attribute("/g", "unit", "Å");
    file.write_attribute("/g", "unit", "meV/Å²"); // written over
    file.write_attribute("/g", "empty", "");
    file.write_attribute("/g", "x", 0.1);
    file.write_attribute("/g", "n", std::int64_t{1} << 60);
    file.write_attribute("/", "list", std::vector<std::int64_t>{1, 2});
    EXPECT_EQ(file.text_attribute("/g", "unit"), "meV/Å²");
    EXPECT_EQ(file.text_attribute("/g", "empty"), "");
    EXPECT_EQ(file.number_attribute("/g", "x"), 0.1);
    EXPECT_EQ(file.number_attribute("/g", "n"), std::pow(2.0, 60));
    EXPECT_FALSE(file.number_attribute("/g", "y").has_value());
    EXPECT_FALSE(file.text_attribute("/nothing", "y").has_value());
    EXPECT_THROW(file.number_attribute("/g", "unit"), FileError);
    EXPECT_THROW(file.text_attribute("/g", "x"), FileError);
    EXPECT_THROW(file.number_attribute("/", "list"), FileError);
    EXPECT_THROW(file.write_attribute("/nothing", "x", 1.0), FileError);
}

TEST(Hdf5File, PlaneByPlane) {
    const Scratch scratch;
    Hdf5File file(scratch / "a.h5", Hdf5File::Mode::create);
    file.make_dataset<double>("/u", {3, 2, 5});
    for (std::uint64_t z = 0; z < 3; ++z) {
        std::vector<double> plane(10);
        std::iota(plane.begin(), plane.end(), 10.0 * static_cast<double>(z));
        file.write_slab<double>("/u", {z, 0, 0}, {1, 2, 5}, plane);
    }
    std::vector<double> all(30);
    std::iota(all.begin(), all.end(), 0.0);
    EXPECT_EQ(file.read<double>("/u"), all);
    std::vector<double> part(4);
    file.read_slab<double>("/u", {1, 0, 3}, {1, 2, 2}, part);
    EXPECT_EQ(part, (std::vector<double>{13, 14, 18, 19}));
    EXPECT_THROW(file.read_slab<double>("/u", {3, 0, 0}, {1, 2, 5}, all), FileError);
    EXPECT_THROW(file.read_slab<double>("/u", {3, 0, 0}, {1, 2, 2}, part), FileError);
    EXPECT_THROW(file.write_slab<double>("/u", {0, 0}, {2, 2}, part), FileError);
    EXPECT_THROW(file.write_slab<double>("/v", {0, 0}, {2, 2}, part), FileError);
}

TEST(Hdf5File, ACompressedMapIsSmallerAndTheSame) {
    const Scratch scratch;
    Hdf5File file(scratch / "a.h5", Hdf5File::Mode::create);
    std::vector<double> map(300 * 200, 0.0); // several blocks of rows, the last one in part
    for (std::size_t i = 0; i < map.size(); i += 20)
        map[i] = 1.0 / static_cast<double>(i + 1);
    file.write<double>("/plain", {300, 200}, map);
    file.write<double>("/packed", {300, 200}, map, true);
    file.write<double>("/row", {1, 2}, std::vector<double>{1.0, 2.0}, true);
    file.close();
    const Hdf5File reading(scratch / "a.h5", Hdf5File::Mode::read);
    EXPECT_EQ(reading.read<double>("/packed"), map);
    EXPECT_EQ(reading.read<double>("/row"), (std::vector<double>{1.0, 2.0}));
    EXPECT_EQ(reading.stored_bytes("/plain"), 8 * map.size());
    EXPECT_LT(reading.stored_bytes("/packed"), reading.stored_bytes("/plain") / 3);
    std::vector<double> part(4);
    reading.read_slab<double>("/packed", {163, 19}, {2, 2}, part); // over the edge of two blocks
    EXPECT_EQ(part, (std::vector<double>{map[163 * 200 + 19], map[163 * 200 + 20],
                                         map[164 * 200 + 19], map[164 * 200 + 20]}));
}

TEST(Hdf5File, MapsOfARunAreCompressedIfTheyRepeat) {
    const Scratch scratch;
    Hdf5File file(scratch / "a.h5", Hdf5File::Mode::create);
    std::vector<double> pressure(100 * 100, 0.0), gap(pressure.size());
    std::iota(gap.begin(), gap.end(), 0.5);
    for (std::size_t i = 0; i < pressure.size(); i += 30)
        pressure[i] = gap[i];
    write_described(file, "/fields/relaxed/pressure", {100, 100}, pressure);
    write_described(file, "/fields/relaxed/gap", {100, 100}, gap);
    write_described(file, "/substrate/spectrum", {pressure.size()}, pressure);
    EXPECT_LT(file.stored_bytes("/fields/relaxed/pressure"), 8 * pressure.size() / 4);
    EXPECT_EQ(file.stored_bytes("/fields/relaxed/gap"), 8 * gap.size());
    EXPECT_EQ(file.stored_bytes("/substrate/spectrum"), 8 * pressure.size()) << "no map";
    EXPECT_EQ(file.read<double>("/fields/relaxed/pressure"), pressure);
}

TEST(Hdf5File, GrowingRows) {
    const Scratch scratch;
    Hdf5File file(scratch / "a.h5", Hdf5File::Mode::create);
    file.make_dataset<float>("/s", {0});
    file.make_dataset<float>("/frames/f", {0, 2, 2});
    for (int i = 0; i < 5; ++i) {
        const float x = static_cast<float>(i);
        file.write_slab<float>("/s", {file.extend("/s")}, {1}, std::vector<float>{x});
        const std::uint64_t frame = file.extend("/frames/f");
        for (std::uint64_t y = 0; y < 2; ++y) // in parts
            file.write_slab<float>("/frames/f", {frame, y, 0}, {1, 1, 2}, std::vector<float>{x, x});
    }
    EXPECT_EQ(file.shape("/s"), Hdf5File::Shape{5});
    EXPECT_EQ(file.shape("/frames/f"), (Hdf5File::Shape{5, 2, 2}));
    EXPECT_EQ(file.read<float>("/frames/f").back(), 4.0f);
    EXPECT_THROW(
        file.write_slab<float>("/frames/f", {5, 0, 0}, {1, 2, 2}, std::vector<float>{1, 2, 3, 4}),
        FileError)
        << "behind the last row";
}

TEST(Hdf5File, ErrorsNameFileObjectAndCause) {
    const Scratch scratch;
    EXPECT_THROW(Hdf5File(scratch / "none.h5", Hdf5File::Mode::read), FileError);
    EXPECT_THROW(Hdf5File(scratch.write("text.h5", "no"), Hdf5File::Mode::read), FileError);
    try {
        Hdf5File(scratch / "no/such/dir.h5", Hdf5File::Mode::create);
        FAIL();
    } catch (const FileError& error) {
        EXPECT_EQ(error.code(), 4);
        EXPECT_NE(std::string(error.what()).find("no/such: cannot be opened as a directory"),
                  std::string::npos)
            << error.what();
    }
    Hdf5File file(scratch / "a.h5", Hdf5File::Mode::create);
    file.write<double>("/x", {2}, std::vector<double>{1, 2});
    EXPECT_THROW(file.write<double>("/x", {2}, std::vector<double>{1, 2}), FileError); // is there
    EXPECT_THROW(file.write<double>("/y", {3}, std::vector<double>{1, 2}), FileError);
    EXPECT_THROW(file.write<double>("/x/y", {1}, std::vector<double>{1}), FileError);
    EXPECT_THROW(file.read<double>("/z"), FileError);
    EXPECT_THROW(file.members("/z"), FileError);
    file.close();
    const Hdf5File reading(scratch / "a.h5", Hdf5File::Mode::read);
    EXPECT_EQ(reading.read<float>("/x"), (std::vector<float>{1, 2})); // converted while reading
}

TEST(Hdf5File, ReadOnlyFilesStayAsTheyAre) {
    const Scratch scratch;
    Hdf5File(scratch / "a.h5", Hdf5File::Mode::create).close();
    Hdf5File file(scratch / "a.h5", Hdf5File::Mode::read);
    EXPECT_THROW(file.make_group("/g"), FileError);
    EXPECT_THROW(file.write<double>("/x", {1}, std::vector<double>{1}), FileError);
}

} // namespace
} // namespace asperity::io
