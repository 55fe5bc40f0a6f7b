// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Attributes of groups and data sets: numbers, lists of numbers, texts.
#include "io/hdf5_file.hpp"

#include "io/hdf5_handle.hpp"

#include <algorithm>

namespace asperity::io {

namespace {

hid_t string_type() { return H5Tcopy(H5T_C_S1); }

} // namespace

void Hdf5File::put_attribute(const std::string& object, const std::string& name, std::int64_t type,
                             std::int64_t space, const void* data) {
    const Hdf5Handle owner(H5Oopen(id_, object.c_str(), H5P_DEFAULT), H5Oclose);
    const htri_t there = owner.good() ? H5Aexists(owner, name.c_str()) : -1;
    const bool free = there == 0 || (there > 0 && H5Adelete(owner, name.c_str()) >= 0);
    const Hdf5Handle attribute(
        free ? H5Acreate2(owner, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT) : -1,
        H5Aclose);
    if (!attribute.good() || H5Awrite(attribute, type, data) < 0)
        fail(object, "cannot take the attribute " + name);
}

void Hdf5File::write_attribute(const std::string& object, const std::string& name,
                               const std::string& value) {
    // Of variable length: such strings are text to Python, fixed ones are bytes.
    const Hdf5Handle type(string_type(), H5Tclose), space(H5Screate(H5S_SCALAR), H5Sclose);
    const char* text = value.c_str();
    if (!type.good() || H5Tset_size(type, H5T_VARIABLE) < 0 || H5Tset_cset(type, H5T_CSET_UTF8) < 0)
        fail(object, "cannot take the attribute " + name);
    put_attribute(object, name, type, space, &text);
}

template <class T>
void Hdf5File::write_attribute(const std::string& object, const std::string& name, T value) {
    const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    put_attribute(object, name, hdf5_type<T>(), space, &value);
}

template <class T>
void Hdf5File::write_attribute(const std::string& object, const std::string& name,
                               const std::vector<T>& value) {
    const hsize_t count = value.size();
    const Hdf5Handle space(H5Screate_simple(1, &count, nullptr), H5Sclose);
    put_attribute(object, name, hdf5_type<T>(), space, value.data());
}

void Hdf5File::write_text_list_attribute(const std::string& object, const std::string& name,
                                         const std::vector<std::string>& value) {
    std::size_t longest = 1;
    for (const std::string& text : value)
        longest = std::max(longest, text.size());
    std::string padded;
    for (std::string text : value) {
        text.resize(longest, '\0');
        padded += text;
    }
    const hsize_t count = value.size();
    const Hdf5Handle type(string_type(), H5Tclose),
        space(H5Screate_simple(1, &count, nullptr), H5Sclose);
    if (!type.good() || H5Tset_size(type, longest) < 0 ||
        H5Tset_strpad(type, H5T_STR_NULLPAD) < 0 || H5Tset_cset(type, H5T_CSET_UTF8) < 0)
        fail(object, "cannot take the attribute " + name);
    put_attribute(object, name, type, space, padded.data());
}

bool Hdf5File::has_attribute(const std::string& object, const std::string& name) const {
    return H5Aexists_by_name(id_, object.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

std::string Hdf5File::read_text_attribute(const std::string& object,
                                          const std::string& name) const {
    const Hdf5Handle attribute(
        H5Aopen_by_name(id_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    if (!attribute.good()) fail(object, "has no attribute " + name);
    const Hdf5Handle type(H5Aget_type(attribute), H5Tclose),
        space(H5Aget_space(attribute), H5Sclose);
    if (!type.good() || !space.good() || H5Tget_class(type) != H5T_STRING ||
        H5Sget_simple_extent_npoints(space) != 1)
        fail(object, "has an attribute " + name + " that is not one string");
    if (H5Tis_variable_str(type) > 0) {
        char* data = nullptr;
        const Hdf5Handle memory(string_type(), H5Tclose);
        if (H5Tset_size(memory, H5T_VARIABLE) < 0 || H5Tset_cset(memory, H5Tget_cset(type)) < 0 ||
            H5Aread(attribute, memory, &data) < 0)
            fail(object, "has an attribute " + name + " that cannot be read");
        const std::string text = data ? data : "";
        if (data) H5free_memory(data);
        return text;
    }
    std::string text(H5Tget_size(type), '\0');
    if (H5Aread(attribute, type, text.data()) < 0)
        fail(object, "has an attribute " + name + " that cannot be read");
    text.resize(std::min(text.find('\0'), text.size()));
    return text;
}

template <class T>
T Hdf5File::read_attribute(const std::string& object, const std::string& name) const {
    const Hdf5Handle attribute(
        H5Aopen_by_name(id_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    const Hdf5Handle space(attribute.good() ? H5Aget_space(attribute) : -1, H5Sclose);
    T value{};
    if (!space.good() || H5Sget_simple_extent_npoints(space) != 1 ||
        H5Aread(attribute, hdf5_type<T>(), &value) < 0)
        fail(object, "has no number as attribute " + name);
    return value;
}

#define ASPERITY_HDF5_TYPE(T)                                                                      \
    template void Hdf5File::write_attribute<T>(const std::string&, const std::string&, T);         \
    template void Hdf5File::write_attribute<T>(const std::string&, const std::string&,             \
                                               const std::vector<T>&);                             \
    template T Hdf5File::read_attribute<T>(const std::string&, const std::string&) const;
ASPERITY_HDF5_TYPE(double)
ASPERITY_HDF5_TYPE(std::int64_t)
#undef ASPERITY_HDF5_TYPE

} // namespace asperity::io
