// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The roughness power spectrum C(q), isotropic, in Persson's normalisation
//     <h²> = 2π ∫ q C(q) dq,   <|∇h|²> = 2π ∫ q³ C(q) dq.
//
// A power law with roll-off and the ring averages of a surface both consist of pieces with C = c
// (q/qa)^n. On each piece every moment has a closed form (a logarithm if the exponents cancel, as
// at H = 1), for any width. Gaps are intervals of q without a piece. Units: any consistent set; q
// in 1/length, C in length⁴ (e.g. Å and Å⁴).
#pragma once

#include <span>
#include <vector>

namespace asperity::theory {

/// Spectrum C that is constant for q_L <= q < q0, ∝ q^(-2(1+H)) for q0 <= q <= q1, and zero
/// otherwise.
struct SelfAffine {
    /// Smallest, roll-off (q_L: none) and largest wavevector [1/length].
    double q_L = 0, q0 = 0, q1 = 0;
    double hurst = 0; ///< H, usually 0..1
    double h_rms = 0; ///< rms roughness [length]
};

/// A wavevector and the moments of all roughness up to it.
struct Magnification {
    double q = 0;      ///< [1/length]
    double slope = 0;  ///< M3(q) = ∫ q³ C dq [1]
    double energy = 0; ///< M2(q) = ∫ q² C dq [length]
};

/// Piece C = c (q/qa)^exponent on [qa, qb].
struct PowerLaw {
    double qa = 0, qb = 0, c = 0, exponent = 0;
};

/// The roughness power spectrum C(q) by pieces.
class Spectrum {
public:
    /// Makes a power law with roll-off, scaled to h_rms.
    static Spectrum self_affine(const SelfAffine& options);

    /// Makes a spectrum from the ring averages of a surface: C[k] between edges[k] and edges[k+1].
    /// The first edge is q_L even if C is zero there.
    static Spectrum rings(std::span<const double> edges, std::span<const double> C);

    /// Returns the spectrum scaled to another rms height; 0 gives a smooth surface that keeps the
    /// shape for further scaling.
    [[nodiscard]] Spectrum with_rms_height(double h_rms) const;

    [[nodiscard]] double operator()(double q) const; ///< returns C(q) [length⁴]
    [[nodiscard]] double q_L() const { return q_smallest_; }
    [[nodiscard]] double q1() const { return q_largest_; }
    [[nodiscard]] double rms_height() const; ///< returns √(2π ∫ q C dq) [length]
    [[nodiscard]] double rms_slope() const;  ///< returns √(2π ∫ q³ C dq) [1]

    /// Returns the moments of all roughness up to q.
    [[nodiscard]] Magnification at(double q) const;
    /// Returns the moments of all roughness.
    [[nodiscard]] Magnification last() const { return at(q_largest_); }
    /// Returns the moments up to q = q_first e^L, with q_first the smallest wavevector with
    /// roughness. Near q_first the moments are accurate in L, where q would lose digits.
    [[nodiscard]] Magnification from_first(double L) const;

    /// Returns ln(q/q_first) of both ends and of the edges of gaps, in ascending order; the first
    /// is 0.
    [[nodiscard]] std::vector<double> edges() const;
    /// Returns the pieces of the whole spectrum.
    [[nodiscard]] std::vector<PowerLaw> pieces() const;

    /// Returns true if there is no roughness.
    [[nodiscard]] bool smooth() const { return flat_ || segments_.empty(); }

private:
    struct Segment : PowerLaw {
        double log_width;             // ln(qb/qa)
        double height, energy, slope; // ∫ q^k C dq up to qa, k = 1, 2, 3
    };
    void append(double qa, double qb, double ca, double cb);
    void accumulate();
    [[nodiscard]] static double partial(const Segment& s, int k, double log_ratio);
    [[nodiscard]] static Magnification within(const Segment& s, double q, double log_ratio);
    [[nodiscard]] const Segment* segment_below(double q) const;

    double q_smallest_ = 0, q_largest_ = 0;
    double height_ = 0; // ∫ q C dq over everything
    bool flat_ = false; // scaled to zero: the segments hold the shape only
    std::vector<Segment> segments_;
};

} // namespace asperity::theory
