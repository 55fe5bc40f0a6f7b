// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "decomposition/bands.hpp"

#include "decomposition/aligned_array.hpp"
#include "decomposition/tile.hpp"

#include <fftw3.h>
#include <omp.h>

#include <algorithm>
#include <array>
#include <memory>
#include <stdexcept>
#include <string>

namespace asperity {

namespace {

using Complex = std::complex<double>;

fftw_complex* raw(Complex* values) { return reinterpret_cast<fftw_complex*>(values); }

/// Number of rows, or of columns, that are transformed together.
constexpr int block = 8;

/// Transforms blocks of lines of n values, and has a buffer for a block of each thread. distance:
/// from one value of a line to the next in the buffer; between: from one line to the next.
class Lines {
public:
    Lines(int n, int distance, int between, int sign) : size_(static_cast<std::size_t>(n) * block) {
        for (int t = 0; t < omp_get_max_threads(); ++t)
            buffers_.push_back(aligned_array<Complex>(size_));
        Complex* const any = buffers_.front().get();
        plan_.reset(fftw_plan_many_dft(1, &n, block, raw(any), nullptr, distance, between, raw(any),
                                       nullptr, distance, between, sign, FFTW_ESTIMATE));
        if (!plan_)
            throw std::runtime_error("surface: FFTW cannot plan a transform of " +
                                     std::to_string(n) + " points");
    }

    /// Transforms lines [0, count): get(buffer, first, some) fills the buffer of the thread, put()
    /// takes the results out of it.
    template <class Get, class Put>
    void transform(int count, const Get& get, const Put& put) const {
#pragma omp parallel for schedule(static) num_threads(static_cast <int>(buffers_.size()))
        for (int first = 0; first < count; first += block) {
            Complex* const mine = buffers_[static_cast<std::size_t>(omp_get_thread_num())].get();
            const int some = std::min(block, count - first);
            if (some < block) std::fill_n(mine, size_, Complex());
            get(mine, first, some);
            fftw_execute_dft(plan_.get(), raw(mine), raw(mine));
            put(mine, first, some);
        }
    }

private:
    std::size_t size_;
    std::vector<AlignedArray<Complex>> buffers_;
    struct Destroy {
        void operator()(fftw_plan plan) const { fftw_destroy_plan(plan); }
    };
    std::unique_ptr<fftw_plan_s, Destroy> plan_;
};

/// Transforms the columns of `rows` rows of this width.
void transform_columns(Complex* values, int width, int rows, int sign) {
    const Lines columns(rows, block, 1, sign);
    const auto line = [&](int y) { return values + static_cast<std::ptrdiff_t>(y) * width; };
    columns.transform(
        width,
        [&](Complex* to, int first, int some) {
            for (int y = 0; y < rows; ++y)
                std::copy_n(line(y) + first, some, to + static_cast<std::ptrdiff_t>(y) * block);
        },
        [&](const Complex* from, int first, int some) {
            for (int y = 0; y < rows; ++y)
                std::copy_n(from + static_cast<std::ptrdiff_t>(y) * block, some, line(y) + first);
        });
}

void transform_rows(Complex* values, int width, int rows, int sign) {
    const Lines lines(width, 1, width, sign);
    const auto line = [&](int y) { return values + static_cast<std::ptrdiff_t>(y) * width; };
    const auto length = static_cast<std::size_t>(width);
    lines.transform(
        rows,
        [&](Complex* to, int first, int some) {
            std::copy_n(line(first), length * static_cast<std::size_t>(some), to);
        },
        [&](const Complex* from, int first, int some) {
            std::copy_n(from, length * static_cast<std::size_t>(some), line(first));
        });
}

std::span<double> numbers(Complex* from, std::size_t count) {
    return {reinterpret_cast<double*>(from), 2 * count};
}

} // namespace

Bands::Bands(const Communicator& ranks, int columns, int rows) : ranks_(ranks), columns_(columns) {
    for (int r = 0; r <= ranks_.size(); ++r)
        first_.push_back(share(rows, r));
}

Bands Bands::of_rows(const Communicator& ranks, int columns, int held) {
    Bands bands(ranks, columns, 0);
    std::vector<double> rows(static_cast<std::size_t>(ranks.size()));
    const std::vector<int> counts(rows.size(), 1);
    ranks.all_gather(std::array{1.0 * held}, counts, rows);
    for (std::size_t r = 0; r < rows.size(); ++r)
        bands.first_[r + 1] = bands.first_[r] + static_cast<int>(rows[r]);
    return bands;
}

void Bands::pass_on(std::span<double> sums) const {
    const int size = ranks_.size(), rank = ranks_.rank();
    const std::vector<double> mine(sums.begin(), sums.end());
    const Message message{(rank + 1) % size, (rank + size - 1) % size, 0, mine, sums};
    ranks_.exchange(std::span(&message, 1));
}

void Bands::fetch(std::span<const double> band, std::size_t length, int from, int count,
                  std::span<double> rows) const {
    const int size = ranks_.size(), all = first_.back();
    std::vector<double> asked(2 * static_cast<std::size_t>(size));
    const std::vector<int> counts(static_cast<std::size_t>(size), 2);
    ranks_.all_gather(std::array{1.0 * from, 1.0 * count}, counts, asked);
    // The rows of a band among [from, from + count), in their order.
    const auto each_of_band = [&](int of, int begin, int some, const auto& visit) {
        for (int k = 0; k < some;) {
            const int y = periodic(begin + k, all);
            if (y < first(of))
                k += first(of) - y;
            else if (y >= first(of + 1))
                k += all - y;
            else
                visit(y - first(of), k++);
        }
    };
    std::vector<std::vector<double>> out(static_cast<std::size_t>(size)), in(out.size());
    std::vector<Message> messages;
    for (int r = 0; r < size; ++r) {
        const auto to = static_cast<std::size_t>(r);
        const auto begin = static_cast<int>(asked[2 * to]),
                   some = static_cast<int>(asked[2 * to + 1]);
        if (r == ranks_.rank()) {
            each_of_band(r, begin, some, [&](int own, int k) {
                std::copy_n(band.begin() + static_cast<std::ptrdiff_t>(length) * own, length,
                            rows.begin() + static_cast<std::ptrdiff_t>(length) * k);
            });
            continue;
        }
        each_of_band(ranks_.rank(), begin, some, [&](int own, int) {
            const auto row = band.begin() + static_cast<std::ptrdiff_t>(length) * own;
            out[to].insert(out[to].end(), row, row + static_cast<std::ptrdiff_t>(length));
        });
        std::size_t coming = 0;
        each_of_band(r, from, count, [&](int, int) { coming += length; });
        in[to].resize(coming);
        messages.push_back({r, r, 0, out[to], in[to]});
    }
    ranks_.exchange(messages);
    for (int r = 0; r < size; ++r) {
        if (r == ranks_.rank()) continue;
        auto next = in[static_cast<std::size_t>(r)].begin();
        each_of_band(r, from, count, [&](int, int k) {
            std::copy_n(next, length, rows.begin() + static_cast<std::ptrdiff_t>(length) * k);
            next += static_cast<std::ptrdiff_t>(length);
        });
    }
}

std::vector<double> Bands::spread(std::vector<double> whole) const {
    if (ranks_.size() == 1) return whole;
    std::vector<double> band(size());
    std::vector<Message> messages;
    const auto length = static_cast<std::size_t>(columns_);
    const auto part = [&](int rank) { // part of the root's map
        return std::span<const double>(whole).subspan(
            length * static_cast<std::size_t>(first(rank)),
            length * static_cast<std::size_t>(first(rank + 1) - first(rank)));
    };
    if (!ranks_.root())
        messages.push_back({0, 0, 0, {}, band});
    else
        for (int r = 0; r < ranks_.size(); ++r)
            messages.push_back({r, r, 0, part(r), r == 0 ? std::span(band) : std::span<double>()});
    ranks_.exchange(messages);
    return band;
}

/// Exchanges bands of rows for strips of whole columns, or back.
void Bands::transpose(std::vector<Complex>& band, std::vector<Complex>& strip, bool back) const {
    const int size = ranks_.size(), rank = ranks_.rank();
    const auto left = [&](int r) { return share(columns_, r); };
    const auto width = [&](int r) { return static_cast<std::size_t>(left(r + 1) - left(r)); };
    // Values of this band in each strip, row by row.
    std::vector<Complex> parts(band.size());
    const auto each_row = [&](const auto& visit) {
        auto next = parts.begin();
        for (int r = 0; r < size; ++r)
            for (int y = 0; y < held(); ++y, next += static_cast<std::ptrdiff_t>(width(r)))
                visit(next, band.begin() + static_cast<std::ptrdiff_t>(y) * columns_ + left(r),
                      width(r));
    };
    if (!back)
        each_row([](auto part, auto row, std::size_t some) { std::copy_n(row, some, part); });
    std::vector<Message> messages;
    std::size_t from = 0;
    for (int r = 0; r < size; ++r) {
        const std::size_t count = width(r) * static_cast<std::size_t>(held());
        const auto mine = numbers(parts.data() + from, count);
        const auto theirs =
            numbers(strip.data() + width(rank) * static_cast<std::size_t>(first(r)),
                    width(rank) * static_cast<std::size_t>(first(r + 1) - first(r)));
        messages.push_back(back ? Message{r, r, 0, theirs, mine} : Message{r, r, 0, mine, theirs});
        from += count;
    }
    ranks_.exchange(messages);
    if (back) each_row([](auto part, auto row, std::size_t some) { std::copy_n(part, some, row); });
}

void Bands::transform(std::vector<Complex>& band, int sign) const {
    transform_rows(band.data(), columns_, held(), sign);
    if (ranks_.size() == 1) return transform_columns(band.data(), columns_, rows(), sign);
    const int width = share(columns_, ranks_.rank() + 1) - share(columns_, ranks_.rank());
    std::vector<Complex> strip(static_cast<std::size_t>(width) * static_cast<std::size_t>(rows()));
    transpose(band, strip, false);
    transform_columns(strip.data(), width, rows(), sign);
    transpose(band, strip, true);
}

} // namespace asperity
