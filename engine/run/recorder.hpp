// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The records of a run: rows of the series, maps of states, frames of the trajectory (collective;
// the root writes).
//
// Records are appended to run.journal as entries (io/journal.hpp), to which a checkpoint refers.
// run.h5 is made from the journal at the start, at the end, and at checkpoints as long as writing
// takes less than a small fraction of the time. run.h5 is complete at any time.
#pragma once

#include "engine/options/output_options.hpp"
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
    /// Number of rows and length of the journal at a checkpoint.
    struct Position {
        std::uint64_t rows = 0;
        io::Journal::Mark mark; ///< end of the journal, on the root
        template <class Visitor>
        void visit(Visitor& v) {
            v("rows", rows);
            v("bytes", mark.bytes);
            v("digest", mark.digest);
        }
    };

    /// Function that writes further contents of run.h5 after the records.
    using AddToFile = std::function<void(io::Hdf5File&)>;

    /// Makes a new journal, or continues the journal of a directory from the position `resume`,
    /// which the journal must hold (Journal::holds). The surface must outlive the recorder.
    /// columns: columns of the series; add: called when run.h5 is written.
    Recorder(const io::Directory& directory, const Surface& surface,
             const Communicator& communicator, std::vector<const SeriesColumn*> columns,
             const std::optional<Position>& resume, AddToFile add);

    /// Appends the last step or point as one row. A time step must have been made with
    /// wish_of_row().
    void row(const Path& path);
    /// Returns the quantities that a row needs of a time step.
    Path::Wish wish_of_row() const;
    /// Returns the number of rows so far.
    std::uint64_t rows() const { return rows_; }
    /// Appends the maps of a state (gap, pressure, contact, displacement) and the distribution of
    /// gaps P(u), in bands (decomposition/plane_bands.hpp).
    void fields(const std::string& state, const VectorPlane<const double>& layer,
                const ProcessGrid& grid, const Interface& interface, const BlockOptions& block);
    /// Appends the stresses below a state whose maps were appended last (output.stress).
    void stresses(const std::string& state, const VectorPlane<const double>& layer,
                  const ProcessGrid& grid, const Interface& interface, const BlockOptions& block,
                  const StressOptions& options);
    /// Appends a frame of the trajectory (H5MD): the positions of the lowest layer at path.now(),
    /// with its velocities if `velocities`.
    void frame(const Path& path, bool velocities);

    /// Writes all rows to the journal and returns its position.
    Position position();
    /// Flushes the journal to the disk.
    void synchronize();
    /// Writes run.h5.
    void write();
    /// Writes run.h5 at a checkpoint if writing takes less than largest_share of the time since
    /// run.h5 was last written.
    void write_if_cheap();

    // Functions for the root only.
    /// Writes run.h5 without the other ranks.
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
