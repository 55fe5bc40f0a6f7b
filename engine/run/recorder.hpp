// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The records of a run: rows of the series, maps of states, frames of the trajectory (collective;
// the root writes).
//
// They are appended to run.journal as entries (io/journal.hpp), to which a checkpoint refers.
// run.h5 is made from them: at the start, at the end, and at checkpoints as long as that takes less
// than a small fraction of the time. It is always whole.
#pragma once

#include "engine/path/path.hpp"
#include "engine/run/series.hpp"
#include "io/files.hpp"
#include "io/hdf5_file.hpp"
#include "io/journal.hpp"

#include <array>
#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace asperity {

/// Recorder of a run.
class Recorder {
public:
    /// Amount recorded at some moment.
    struct Position {
        std::uint64_t rows = 0;
        io::Journal::Mark mark; ///< mark of the journal; the root's
        template <class Visitor>
        void visit(Visitor& v) {
            v("rows", rows);
            v("bytes", mark.bytes);
            v("digest", mark.digest);
        }
    };

    /// Writes further contents of run.h5 after the records.
    using AddToFile = std::function<void(io::Hdf5File&)>;

    /// Makes a new journal, or continues one from a position that it holds (Journal::holds). The
    /// surface must outlive the recorder. columns: those of the series.
    Recorder(const io::Directory& directory, const Surface& surface,
             const Communicator& communicator, std::vector<const SeriesColumn*> columns,
             const std::optional<Position>& resume, AddToFile add);

    /// Appends one row: an observed step, or a point of a quasi-static path (without time, kinetic
    /// energy, damping and their columns), made with wish_of_row().
    void row(const Path& path);
    Path::Wish wish_of_row() const;
    std::uint64_t rows() const { return rows_; }
    /// Appends maps of a state: gap, pressure, contact, displacement; and the distribution of gaps
    /// P(u). Must be called once for each name.
    void fields(const std::string& state, const VectorPlane<const double>& layer,
                const ProcessGrid& grid, const Interface& interface);
    /// Returns the entry that fields() appends to the journal, on the root. Collective.
    static io::PayloadWriter entry_of_fields(const std::string& state,
                                             const VectorPlane<const double>& layer,
                                             const Communicator& ranks, const ProcessGrid& grid,
                                             const Interface& interface);
    /// Appends a frame of the trajectory (H5MD): the lowest layer at path.now(), and its velocities
    /// if they are wanted.
    void frame(const Path& path, bool velocities);

    /// Writes all rows to the journal and returns its position.
    Position position();
    /// Brings the journal to the disk.
    void synchronize();
    /// Writes run.h5.
    void write();
    /// Writes run.h5 at a checkpoint if that takes less than largest_share of the time since the
    /// last.
    void write_if_cheap();

    // Root only.
    void write_on_root();
    /// Returns the columns of the series so far by their names in run.h5, one value a row.
    std::map<std::string, std::vector<double>> series() const;
    void remove_journal(); ///< removes the journal after the run

private:
    using Clock = std::chrono::steady_clock;
    static constexpr double largest_share = 0.005;
    void append_rows();
    void build();

    Communicator communicator_;
    const io::Directory directory_;
    const Surface& surface_;
    AddToFile add_;
    std::vector<const SeriesColumn*> columns_;
    std::optional<io::Journal> journal_; ///< root only
    std::vector<double> waiting_;        ///< rows that are not in the journal yet; root only
    std::uint64_t rows_ = 0;
    double build_seconds_ = 0.0; ///< time to write the last run.h5, s
    Clock::time_point built_ = Clock::now();
};

} // namespace asperity
