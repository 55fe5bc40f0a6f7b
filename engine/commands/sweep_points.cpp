// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/commands/sweep_points.hpp"

#include "io/error.hpp"
#include "io/result.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace asperity {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

volatile std::sig_atomic_t interruptions = 0;
extern "C" void on_interruption(int) { interruptions = interruptions + 1; }

/// Signals that stop the sweep are caught as long as this lives.
class Interruptions {
public:
    Interruptions() {
        interruptions = 0;
        struct sigaction action {};
        action.sa_handler = on_interruption;
        for (std::size_t i = 0; i < 3; ++i)
            sigaction(signals[i], &action, &before_[i]);
    }
    ~Interruptions() {
        for (std::size_t i = 0; i < 3; ++i)
            sigaction(signals[i], &before_[i], nullptr);
    }
    Interruptions(const Interruptions&) = delete;
    Interruptions& operator=(const Interruptions&) = delete;

private:
    static constexpr int signals[3] = {SIGINT, SIGTERM, SIGUSR1};
    struct sigaction before_[3];
};

std::string contents(const std::string& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

std::string checkpoint_of(const SweepJob& job) { return job.directory + "/checkpoint.h5"; }
std::string log_of(const SweepJob& job) { return job.directory + "/log.txt"; }

/// The last line of the log with something in it.
std::string last_line(const SweepJob& job) {
    std::ifstream stream(log_of(job), std::ios::binary | std::ios::ate);
    if (!stream) return "";
    const std::streamoff size = stream.tellg();
    stream.seekg(std::max<std::streamoff>(0, size - 400));
    std::string line, last;
    while (std::getline(stream, line))
        if (line.find_first_not_of(" \r") != std::string::npos) last = line;
    return last;
}

/// How far a point has come, by what it says of itself (" 45 %  approach, ..."); 0 if nothing yet.
double fraction_of(const SweepJob& job) {
    const std::string line = last_line(job);
    const std::size_t sign = line.find(" %");
    if (sign == std::string::npos || sign > 3) return 0.0;
    return std::clamp(std::atof(line.c_str()) / 100.0, 0.0, 1.0);
}

std::vector<char*> pointers(std::vector<std::string>& words) {
    std::vector<char*> list;
    for (std::string& word : words)
        list.push_back(word.data());
    list.push_back(nullptr);
    return list;
}

struct Child {
    std::size_t job = 0;
    pid_t pid = 0;
    Clock::time_point start;
};

class Pool {
public:
    Pool(const std::vector<SweepJob>& jobs, std::vector<PointOutcome>& outcomes,
         const SweepRunOptions& options)
        : jobs_(jobs), outcomes_(outcomes), options_(options), progress_(options.progress) {
        for (std::size_t i = 0; i < jobs.size(); ++i)
            if (outcomes[i].state == PointState::waiting) waiting_.push_back(i);
        std::reverse(waiting_.begin(), waiting_.end()); // taken from the back
        asked_for_ = waiting_.size();
    }

    bool run(const std::function<void(std::size_t)>& done) {
        const Interruptions caught;
        while (!waiting_.empty() || !children_.empty()) {
            while (!stopping_ && !waiting_.empty() &&
                   children_.size() < static_cast<std::size_t>(options_.at_once)) {
                start(waiting_.back());
                waiting_.pop_back();
            }
            if (stopping_ && children_.empty()) break;
            collect(done);
            look_for_a_reason_to_stop();
            if (progress_.due()) progress_.update({state_text(), 0, 0.0, -1.0});
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
        progress_.finish();
        return !stopping_ && std::none_of(outcomes_.begin(), outcomes_.end(), [](const auto& o) {
            return o.state == PointState::waiting;
        });
    }

private:
    void start(std::size_t i) {
        const SweepJob& job = jobs_[i];
        io::make_directory(job.directory);
        const bool goes_on = fs::exists(checkpoint_of(job));
        if (!goes_on) fs::remove(job.directory + "/result.json"); // of a failure, to be tried again
        std::vector<std::string> words = options_.launcher;
        words.insert(words.end(), {fs::read_symlink("/proc/self/exe").string(), "run",
                                   job.scene.file, "--out", job.directory, "--progress", "lines"});
        if (goes_on) words.insert(words.end(), {"--resume", "auto"});
        for (const std::string& assignment : job.overrides)
            words.insert(words.end(), {"--set", assignment});
        // A team of threads for each that share the machine, unless somebody has chosen.
        std::vector<std::string> variables;
        for (char** v = environ; *v; ++v)
            variables.emplace_back(*v);
        const bool shared = !std::getenv("OMP_NUM_THREADS") && options_.launcher.empty();
        if (options_.threads > 0 || shared) {
            std::erase_if(variables,
                          [](const std::string& v) { return v.starts_with("OMP_NUM_THREADS="); });
            const int share = std::max(1, omp_get_max_threads() / options_.at_once);
            variables.push_back(
                fmt::format("OMP_NUM_THREADS={}", options_.threads > 0 ? options_.threads : share));
        }
        const std::vector<char*> argv = pointers(words), environment = pointers(variables);
        const std::string log = log_of(job);
        const pid_t parent = ::getpid(), pid = ::fork();
        if (pid < 0)
            throw io::FileError(job.directory, "cannot be run", std::strerror(errno),
                                "start fewer points at once: --jobs");
        if (pid == 0) {      // nothing here allocates
            ::setpgid(0, 0); // Ctrl-C goes to the sweep, and from there on as USR1
            ::prctl(PR_SET_PDEATHSIG, SIGUSR1);
            if (::getppid() != parent) ::_exit(io::exit_code::stopped);
            const int out = ::open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
            const int in = ::open("/dev/null", O_RDONLY);
            if (out < 0 || in < 0 || ::dup2(in, 0) < 0 || ::dup2(out, 1) < 0 || ::dup2(out, 2) < 0)
                ::_exit(io::exit_code::input_output);
            ::execvpe(argv[0], argv.data(), environment.data());
            ::_exit(127);
        }
        children_.push_back({i, pid, Clock::now()});
    }

    /// Takes in those that have ended.
    void collect(const std::function<void(std::size_t)>& done) {
        for (std::size_t c = 0; c < children_.size();) {
            int status = 0;
            if (::waitpid(children_[c].pid, &status, WNOHANG) != children_[c].pid) {
                ++c;
                continue;
            }
            const Child child = children_[c];
            children_.erase(children_.begin() + static_cast<std::ptrdiff_t>(c));
            conclude(child, status);
            done(child.job);
        }
    }

    void conclude(const Child& child, int status) {
        const SweepJob& job = jobs_[child.job];
        PointOutcome& outcome = outcomes_[child.job];
        outcome = look_at(job);
        outcome.was_there = false;
        const int code = WIFEXITED(status) ? WEXITSTATUS(status) : io::exit_code::internal;
        const bool stopped = code == io::exit_code::stopped ||
                             (stopping_ && WIFSIGNALED(status)); // before it had anything to save
        if (outcome.state == PointState::finished) {
            ++concluded_;
            const double seconds =
                std::chrono::duration<double>(Clock::now() - child.start).count();
            say(job, "done in " + io::duration_text(seconds));
        } else if (stopped) {
            say(job, fs::exists(checkpoint_of(job)) ? "stopped, with a checkpoint"
                                                    : "stopped before its first checkpoint");
        } else {
            ++concluded_;
            outcome.state = PointState::failed;
            outcome.exit_code = code == 0 ? io::exit_code::internal : code;
            if (outcome.reason.empty())
                outcome.reason =
                    WIFSIGNALED(status) ? fmt::format("ended by signal {} ({})", WTERMSIG(status),
                                                      strsignal(WTERMSIG(status)))
                    : code == 127
                        ? "'" + options_.launcher.front() + "' of --launch cannot be started"
                        : last_line(job);
            say(job, fmt::format("FAILED (exit {}): {}", outcome.exit_code, outcome.reason));
        }
    }

    void look_for_a_reason_to_stop() {
        const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
        const bool late = options_.wall_limit && seconds >= *options_.wall_limit;
        if (!stopping_ && (interruptions > 0 || late)) {
            stopping_ = true;
            for (const Child& child : children_)
                ::kill(child.pid, SIGUSR1);
            progress_.say(fmt::format("stopping{}: {} point{} under way, {} not begun",
                                      late ? " at the wall limit" : "", children_.size(),
                                      children_.size() == 1 ? "" : "s", waiting_.size()));
        }
        if (interruptions > 1 && !killed_) { // somebody cannot wait for the checkpoints
            killed_ = true;
            for (const Child& child : children_)
                ::kill(-child.pid, SIGKILL);
        }
    }

    void say(const SweepJob& job, const std::string& what) {
        const auto over = std::count_if(outcomes_.begin(), outcomes_.end(), [](const auto& o) {
            return o.state != PointState::waiting;
        });
        progress_.say(fmt::format("[{}/{}] {}: {}", over, jobs_.size(), job.name, what));
    }

    std::string state_text() const {
        const auto over = jobs_.size() - waiting_.size() - children_.size();
        std::string text = fmt::format("{} of {} points", over, jobs_.size());
        double done = static_cast<double>(concluded_), longest = 0.0;
        for (const Child& child : children_) {
            const double fraction = fraction_of(jobs_[child.job]);
            done += fraction;
            const double age = std::chrono::duration<double>(Clock::now() - child.start).count();
            if (fraction > 0.0) longest = std::max(longest, age * (1.0 - fraction) / fraction);
            text += fmt::format(" | {} {:.0f} %", jobs_[child.job].name, 100.0 * fraction);
        }
        const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
        // As the mean so far, but no less than what those under way need.
        const double by_mean = seconds * (static_cast<double>(asked_for_) - done) / done;
        if (done > 0.02) text += " | " + io::duration_text(std::max(by_mean, longest)) + " left";
        return text;
    }

    const std::vector<SweepJob>& jobs_;
    std::vector<PointOutcome>& outcomes_;
    const SweepRunOptions& options_;
    io::Progress progress_;
    std::vector<std::size_t> waiting_;
    std::vector<Child> children_;
    std::size_t asked_for_ = 0, concluded_ = 0; ///< by this sweep
    bool stopping_ = false, killed_ = false;
    Clock::time_point start_ = Clock::now();
};

} // namespace

PointOutcome look_at(const SweepJob& job) {
    PointOutcome outcome;
    const std::string path = job.directory + "/result.json";
    if (!fs::exists(path)) return outcome;
    outcome.was_there = true;
    outcome.result = io::JsonValue::parse(contents(path), path);
    const io::JsonValue* scene = outcome.result.find("scene");
    if (!scene || scene->dump(-1) != scene_json(job.scene).dump(-1))
        throw io::SceneError(io::Problem{
            job.directory, "holds the result of another scene",
            "a sweep goes on with the points that are there, and this one is not of this sweep",
            "name another directory (--out), or remove this one"});
    if (const io::JsonValue* code = outcome.result.find("failure.exit_code")) {
        outcome.exit_code = static_cast<int>(code->number());
        const io::JsonValue* reason = outcome.result.find("failure.reason");
        if (reason && reason->is_text())
            outcome.reason = reason->text().substr(0, reason->text().find('\n'));
        if (outcome.exit_code == io::exit_code::physics) outcome.state = PointState::failed;
        return outcome;
    }
    const io::JsonValue* stopped = outcome.result.find("run.stopped");
    if (!stopped || stopped->text() == "max_steps") outcome.state = PointState::finished;
    return outcome;
}

bool run_points(const std::vector<SweepJob>& jobs, std::vector<PointOutcome>& outcomes,
                const SweepRunOptions& options, const std::function<void(std::size_t)>& done) {
    return Pool(jobs, outcomes, options).run(done);
}

} // namespace asperity
