// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/interface/sliding_map.hpp"

#include <algorithm>
#include <cmath>

namespace asperity {

SlidingMap::SlidingMap(const HeightMap& map, const Tile& tile)
    : tile_(tile), sites_(map.sites()), spacing_(map.spacing()), radius_(map.radius()),
      map_(map.moving()), shift_(sites_),
      height_(tile, 1, 0), slope_{Field<double>(tile, 1, 0), Field<double>(tile, 1, 0)} {
    if (radius_ > 0.0)
        for (int y = 0; y < sites_; ++y)
            for (int x = 0; x < sites_; ++x)
                map_[at(x, y)] -=
                    cap_of(radius_, (x - 0.5 * sites_) * spacing_, (y - 0.5 * sites_) * spacing_);
    if (map.is_pair())
        for (int y = 0; y < tile.ny; ++y)
            for (int x = 0; x < tile.nx; ++x)
                own_.push_back(map.at(tile.x0 + x, tile.y0 + y) -
                               map_[at(tile.x0 + x, tile.y0 + y)]);
    const std::size_t rows = static_cast<std::size_t>(tile.ny) * shift_.waves();
    waves_.resize(rows);
    waves_of_slope_.resize(rows);
    slide_along_y(0.0);
    slide_to(0.0, 0.0);
}

/// Finds the waves along x of the tile's rows with the block at this place along y, Å. Columns are
/// shifted whole, on every rank.
void SlidingMap::slide_along_y(double y) {
    const auto phases = shift_.phases(y / spacing_);
    std::vector<double> heights(static_cast<std::size_t>(tile_.ny) *
                                static_cast<std::size_t>(sites_)),
        slopes(heights.size());
#pragma omp parallel
    {
        std::vector<double> column(static_cast<std::size_t>(sites_)), moved(column), slope(column);
        std::vector<Complex> waves(shift_.waves());
#pragma omp for schedule(static)
        for (int x = 0; x < sites_; ++x) {
            for (int j = 0; j < sites_; ++j)
                column[static_cast<std::size_t>(j)] = map_[at(x, j)];
            shift_.transform(column.data(), waves.data());
            shift_.shift(waves.data(), phases, moved.data(), slope.data());
            // A map that has not moved keeps its digits.
            const std::vector<double>& here = y == 0.0 ? column : moved;
            for (int j = 0; j < tile_.ny; ++j) {
                const auto from = static_cast<std::size_t>(tile_.y0 + j);
                heights[at(x, j)] = here[from];
                slopes[at(x, j)] = slope[from] / spacing_;
            }
        }
#pragma omp for schedule(static)
        for (int j = 0; j < tile_.ny; ++j) {
            const std::size_t first = static_cast<std::size_t>(j) * shift_.waves();
            shift_.transform(&heights[at(0, j)], &waves_[first]);
            shift_.transform(&slopes[at(0, j)], &waves_of_slope_[first]);
        }
    }
}

void SlidingMap::slide_to(double x, double y) {
    if (y != place_[1]) slide_along_y(y);
    place_ = {x, y};
    const auto phases = shift_.phases(x / spacing_);
    const double edge = sites_ * spacing_;
    const PlaneView<double> height = height_.plane(0), along_x = slope_[0].plane(0),
                            along_y = slope_[1].plane(0);
#pragma omp parallel
    {
        std::vector<double> row(static_cast<std::size_t>(sites_)), slope(row), cross(row);
#pragma omp for schedule(static)
        for (int j = 0; j < tile_.ny; ++j) {
            const std::size_t first = static_cast<std::size_t>(j) * shift_.waves();
            shift_.shift(&waves_[first], phases, row.data(), slope.data());
            shift_.shift(&waves_of_slope_[first], phases, cross.data(), nullptr);
            if (x == 0.0 && y == 0.0)
                std::copy_n(&map_[at(0, tile_.y0 + j)], row.size(), row.data());
            for (int i = 0; i < tile_.nx; ++i) {
                const auto from = static_cast<std::size_t>(tile_.x0 + i);
                height(i, j) = row[from];
                along_x(i, j) = slope[from] / spacing_;
                along_y(i, j) = cross[from];
            }
            if (!own_.empty())
                for (int i = 0; i < tile_.nx; ++i)
                    height(i, j) += own_[static_cast<std::size_t>(j * tile_.nx + i)];
            if (!(radius_ > 0.0)) continue;
            const auto from_centre = [&](int site, double by) {
                const double d = site * spacing_ + by - 0.5 * edge;
                return d - edge * std::floor(d / edge + 0.5);
            };
            const double dy = from_centre(tile_.y0 + j, y);
            for (int i = 0; i < tile_.nx; ++i) {
                const double dx = from_centre(tile_.x0 + i, x);
                const double z = std::sqrt(radius_ * radius_ - dx * dx - dy * dy);
                height(i, j) += cap_of(radius_, dx, dy);
                along_x(i, j) -= dx / z;
                along_y(i, j) -= dy / z;
            }
        }
    }
}

std::size_t SlidingMap::bytes() const {
    return (map_.size() + own_.size()) * sizeof(double) +
           (waves_.size() + waves_of_slope_.size()) * sizeof(Complex) + 3 * height_.bytes();
}

} // namespace asperity
