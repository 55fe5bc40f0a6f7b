// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Inside the HDF5 file (hdf5_file.cpp, hdf5_attributes.cpp) only: the C library's handles and
// types.
#pragma once

#include <cstdint>

#include <hdf5.h>

namespace asperity::io {

static_assert(sizeof(hid_t) == sizeof(std::int64_t));

/// One handle, closed by the function of its kind.
class Hdf5Handle {
public:
    Hdf5Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
    ~Hdf5Handle() {
        if (id_ >= 0) close_(id_);
    }
    Hdf5Handle(const Hdf5Handle&) = delete;
    Hdf5Handle& operator=(const Hdf5Handle&) = delete;
    operator hid_t() const { return id_; }
    bool good() const { return id_ >= 0; }

private:
    hid_t id_;
    herr_t (*close_)(hid_t);
};

/// The library's type for T.
template <class T>
hid_t hdf5_type();
template <>
inline hid_t hdf5_type<double>() {
    return H5T_NATIVE_DOUBLE;
}
template <>
inline hid_t hdf5_type<float>() {
    return H5T_NATIVE_FLOAT;
}
template <>
inline hid_t hdf5_type<std::int64_t>() {
    return H5T_NATIVE_INT64;
}
template <>
inline hid_t hdf5_type<std::int32_t>() {
    return H5T_NATIVE_INT32;
}
template <>
inline hid_t hdf5_type<std::uint8_t>() {
    return H5T_NATIVE_UINT8;
}

} // namespace asperity::io
