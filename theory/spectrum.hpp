// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The roughness power spectrum C(q), isotropic, in Persson's normalisation
//     <h²> = 2π ∫ q C(q) dq,   <|∇h|²> = 2π ∫ q³ C(q) dq.
//
// Why segments. A power law with roll-off, a table interpolated log-log and the ring averages of a
// realised surface are all the same thing: pieces on which C = c (q/qa)^n. On such a piece every
// moment has a closed form (a logarithm where the exponents cancel, as at H = 1), so nothing is
// lost to quadrature however wide (q1/q0 = 10⁶) or narrow the spectrum. Gaps are simply wavevectors
// that no segment covers.
//
// The coordinate of the theory is the slope moment, M3(q) = ∫ q³ C dq from q_L to q: T = (π/2) E*²
// M3. `Magnification` is a point along it. It carries M3 beside q because near q_L the moment
// starts at M3 = 0 and steps of 10⁻³⁰ in M3 do not move q in double precision.
//
// Units: any consistent set; q in 1/length, C in length⁴ (e.g. Å and Å⁴).
// Cost: O(log segments) a look-up, no allocation after construction.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace asperity::theory {

/// C constant for q_L <= q < q0, ∝ q^(-2(1+H)) for q0 <= q <= q1, zero otherwise.
struct SelfAffine {
    double q_L = 0;   ///< 2π/L, smallest wavevector [1/length]
    double q0 = 0;    ///< roll-off wavevector [1/length]; q0 = q_L: no roll-off
    double q1 = 0;    ///< largest wavevector [1/length]
    double hurst = 0; ///< H, usually 0..1
    double h_rms = 0; ///< rms roughness [length]
};

/// A point of the spectrum: the wavevector and its slope moment.
struct Magnification {
    double q = 0;        ///< [1/length]
    double slope = 0;    ///< M3(q) = ∫ q³ C dq from the smallest wavevector [1]
    double energy = 0;   ///< M2(q) = ∫ q² C dq [length]
    double coordinate{}; ///< y = ln M3 + ln q, the coordinate in which the integration steps
};

class Spectrum {
public:
    /// Power law with roll-off, scaled to h_rms.
    static Spectrum self_affine(const SelfAffine& options);

    /// Points (q, C) joined by straight lines in log-log. Two points suffice. q must not decrease;
    /// a wavevector given twice is a jump. A piece that touches C = 0 is empty (the limit of
    /// log-log): that is how a table has gaps. The first q is q_L even where C is zero there.
    static Spectrum tabulated(std::span<const double> q, std::span<const double> C);

    /// Ring averages of a realised surface: C[k] between edges[k] and edges[k+1].
    static Spectrum rings(std::span<const double> edges, std::span<const double> C);

    /// The same shape at another roughness; 0 is smooth, and remembers the shape.
    [[nodiscard]] Spectrum with_rms_height(double h_rms) const;

    [[nodiscard]] double operator()(double q) const; ///< C(q) [length⁴]
    [[nodiscard]] double q_L() const { return q_smallest_; }
    [[nodiscard]] double q1() const { return q_largest_; }
    [[nodiscard]] double rms_height() const; ///< √(2π ∫ q C dq) [length]
    [[nodiscard]] double rms_slope() const;  ///< √(2π ∫ q³ C dq) [1]

    /// Number of waves of equal variance with the same (Σ variance)² / Σ variance², on a square
    /// periodic over 2π/q_L: <h²>² / (q_L² 2π ∫ q C² dq). Zero for a smooth surface.
    [[nodiscard]] double waves() const;

    /// <h²> carried by wavevectors above q [length²].
    [[nodiscard]] double height_variance_above(double q) const;

    [[nodiscard]] Magnification at(double q) const;
    [[nodiscard]] Magnification last() const { return at(q_largest_); }

    /// The point where ln M3 + ln q = y. In a gap: the gap's upper edge.
    [[nodiscard]] Magnification at_coordinate(double y) const;

    /// Marks in y between which C is smooth: gap edges, always in pairs (a gap is one interval of
    /// no roughness); kinks too while the segments are few. First -infinity, last y(q1).
    struct Band {
        double y_begin, y_end;
    };
    [[nodiscard]] std::vector<Band> bands() const;

    [[nodiscard]] bool smooth() const { return flat_ || segments_.empty(); } ///< no roughness

private:
    struct Segment {
        double qa, qb, c, exponent;   // C = c (q/qa)^exponent on [qa, qb]
        double log_width;             // ln(qb/qa)
        double height, energy, slope; // ∫ q^k C dq up to qa, k = 1, 2, 3
        double y_begin, y_end;        // ln M3 + ln q at qa (-infinity if M3 = 0) and qb
    };
    void append(double qa, double qb, double ca, double cb);
    void accumulate();
    [[nodiscard]] static double partial(const Segment& s, int k, double log_ratio);
    [[nodiscard]] const Segment* segment_below(double q) const;

    double q_smallest_ = 0, q_largest_ = 0;
    double height_ = 0; // ∫ q C dq over everything
    bool flat_ = false; // scaled to zero: the segments hold the shape only
    std::vector<Segment> segments_;
};

} // namespace asperity::theory
