// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/digest.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

namespace asperity::io {

namespace {

constexpr std::uint64_t odd = 0x9e3779b97f4a7c15u; // 2^64 over the golden ratio

std::uint64_t step(std::uint64_t h, std::uint64_t word) { return std::rotl((h ^ word) * odd, 29); }

} // namespace

Digest::Digest() {
    for (std::size_t i = 0; i < lanes; ++i)
        state_[i] = step(odd, i);
}

void Digest::take(const std::byte* from) {
    for (std::size_t i = 0; i < lanes; ++i) {
        std::uint64_t word = 0;
        std::memcpy(&word, from + 8 * i, 8);
        state_[i] = step(state_[i], word);
    }
}

void Digest::update(std::span<const std::byte> bytes) {
    const std::size_t filled = length_ % block;
    length_ += bytes.size();
    if (filled > 0) {
        const std::size_t more = std::min(block - filled, bytes.size());
        std::copy_n(bytes.data(), more, rest_.data() + filled);
        bytes = bytes.subspan(more);
        if (filled + more < block) return;
        take(rest_.data());
    }
    for (; bytes.size() >= block; bytes = bytes.subspan(block))
        take(bytes.data());
    std::copy(bytes.begin(), bytes.end(), rest_.begin());
}

std::uint64_t Digest::value() const {
    Digest end = *this;
    std::fill(end.rest_.begin() + static_cast<std::ptrdiff_t>(length_ % block), end.rest_.end(),
              std::byte{0});
    end.take(end.rest_.data());
    std::uint64_t h = step(odd, length_);
    for (const std::uint64_t lane : end.state_)
        h = step(h, lane);
    return h ^ (h >> 31);
}

} // namespace asperity::io
