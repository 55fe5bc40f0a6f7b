#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Faults that a run must survive: what it leaves goes on to the bits of an undisturbed run.

    bench.py PROGRAM FAULT_LIBRARY [--long] [TEST ...]

Each test disturbs runs, one fault a run, and then resumes them. A disturbed run must end with the
exit code of its fault and a message, never by a signal of its own; the resumed one must give run.h5
byte for byte, and result.json in all but times and counts of its `run` section.

    calls      each call of the system that changes a file fails in turn, once or from then on
    kills      SIGKILL before such a call and in the middle of a write
    kinds      SIGKILL at random moments of each kind of run, resumed on other numbers of ranks too
    full-disk  a full disk at every 7 kB of sizes (a tmpfs where one may be mounted, else skipped)
    file-size  the same by a limit on file sizes (ulimit -f), for which no rights are needed
    damage     bits, pages and lengths of checkpoints changed
    signals    TERM, INT, USR1, USR2, HUP, and a closed standard output
    directory  the result directory moved, removed, emptied during a run
    two        two runs in one directory; a killed run started again; the lock of another host
    memory     a limit on memory
    ranks      one of two MPI ranks killed, or stopped (SIGSTOP) for a while or for good; --long only
    cluster    four and eight ranks as on nodes of their own: a limit on the memory of each, one of them killed and
               the run resumed on others, a slow directory; --long only
"""

import contextlib
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
from run_outcome import outcome

SCENE = """
[surface]
sites = 16
rms = 0.5
[drive]
velocity = 100
timestep = 20
[output]
series = 10
checkpoint = 0.01
trajectory = 40
fields = ["relaxed", "pull-off"]
"""
KINDS = {
    "dynamic": [],
    "thermostat": ["drive.temperature=300"],
    "quasistatic": ["drive.mode=quasistatic", "output.trajectory=none", "drive.displacement_step=0.4"],
    "wall": ["drive.mode=quasistatic", "drive.path=relax", "interface.kind=wall", "surface.sites=512", "surface.rms=2",
             "drive.tolerance=0.3", "output.trajectory=none", "output.checkpoint=60", 'output.fields=["relaxed"]'],
}
# The words that start ranks, as CMake found them.
MPIRUN = os.environ.get("ASPERITY_MPIRUN", "mpirun --oversubscribe --bind-to none").split()
ENVIRONMENT = {**os.environ, "OMP_NUM_THREADS": "1", "OMPI_ALLOW_RUN_AS_ROOT": "1",
               "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
EXIT_INPUT_OUTPUT, EXIT_SCENE, EXIT_STOPPED = 4, 2, 75
UNFINISHED = ".part"  # end of the names of files that are not in their places yet; a killed run leaves them


class Bench:
    def __init__(self, program, library, long):
        self.program, self.long = program, long
        self.work = os.path.realpath(tempfile.mkdtemp(prefix="asperity-faults-"))
        # LD_PRELOAD separates its libraries by blanks, and the build's path may have some.
        self.library = os.path.join(self.work, "fault.so")
        os.symlink(os.path.abspath(library), self.library)
        self.scene = os.path.join(self.work, "scene.toml")
        with open(self.scene, "w") as file:
            file.write(SCENE)
        self.undisturbed = {}
        self.failures = 0
        self.random = random.Random(13)

    def fail(self, text):
        self.failures += 1
        print("FAILED:", text, flush=True)

    def command(self, out, kind="dynamic", extra=(), ranks=1):
        command = [self.program, "run", self.scene, "--out", out, "--progress", "off"]
        for assignment in KINDS[kind]:
            command += ["--set", assignment]
        command += extra
        if ranks > 1:
            command = MPIRUN + ["-n", str(ranks)] + command
        return command

    def run(self, out, kind="dynamic", extra=(), ranks=1, fault=None, **options):
        environment = dict(ENVIRONMENT)
        if fault:
            environment.update(LD_PRELOAD=self.library, ASPERITY_FAULT_BELOW=out,
                               ASPERITY_FAULT_AT=str(fault[0]), ASPERITY_FAULT_HOW=str(fault[1]))
        return subprocess.run(self.command(out, kind, extra, ranks), env=environment, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=900, **options)

    def start(self, out, kind="dynamic", extra=(), ranks=1, **options):
        child = subprocess.Popen(self.command(out, kind, extra, ranks), env=ENVIRONMENT, text=True,
                                 stdout=subprocess.PIPE, stderr=subprocess.STDOUT, **options)
        child.out, child.ranks = out, ranks
        return child

    def reference(self, kind):
        """The undisturbed run: its bytes and numbers, and how long it took."""
        if kind not in self.undisturbed:
            out = os.path.join(self.work, "undisturbed-" + kind)
            start = time.monotonic()
            done = self.run(out, kind)
            assert done.returncode == 0, done.stdout
            self.undisturbed[kind] = (*self.outcome(out), time.monotonic() - start)
        return self.undisturbed[kind]

    @staticmethod
    def outcome(out):
        data, result, run = outcome(out)
        return data, result, run.get("steps")

    def resumes(self, out, kind="dynamic", what="", ranks=1):
        """Goes on to the end and compares. True: the same bits."""
        done = self.run(out, kind, ["--resume", "auto"], ranks)
        if done.returncode == EXIT_SCENE and "nothing is left to do" in done.stdout:
            pass  # the fault came after its end
        elif done.returncode != 0:
            self.fail(f"{what}: not resumed (exit {done.returncode}): {done.stdout[-600:]}")
            return False
        data, result, steps, _ = self.reference(kind)
        found = self.outcome(out)
        if found[0] != data or found[1] != result or found[2] != steps:
            where = "run.h5" if found[0] != data else "result.json"
            self.fail(f"{what}: other bits in {where} of {out}")
            return False
        left = sorted(set(os.listdir(out)) - {"result.json", "run.h5", "checkpoint-damaged.h5", ".asperity-files.json"})
        if left:
            self.fail(f"{what}: left over: {left}")
        shutil.rmtree(out)
        return True

    def ended_well(self, done, codes, what):
        """Its exit code is one of these, and it said why."""
        if done.returncode not in codes:
            self.fail(f"{what}: exit {done.returncode} instead of {codes}: {done.stdout[-600:]}")
            return False
        if done.returncode == EXIT_INPUT_OUTPUT and "why:" not in done.stdout:
            self.fail(f"{what}: no message: {done.stdout[-300:]}")
            return False
        return True

    def out(self, name):
        return os.path.join(self.work, name)

    # The tests.

    def count_calls(self):
        """How many calls an undisturbed run makes."""
        out, log = self.out("counted"), self.out("calls.log")
        os.environ["ASPERITY_FAULT_LOG"] = ENVIRONMENT["ASPERITY_FAULT_LOG"] = log
        done = self.run(out, fault=(0, 0))
        del os.environ["ASPERITY_FAULT_LOG"], ENVIRONMENT["ASPERITY_FAULT_LOG"]
        assert done.returncode == 0, done.stdout
        shutil.rmtree(out)
        with open(log) as file:
            calls = len(file.readlines())
        os.remove(log)
        return calls

    def chosen_calls(self, few):
        calls = self.count_calls()
        if self.long:
            return range(1, calls + 1)
        return sorted({3} | set(self.random.sample(range(1, calls), few)))

    def test_calls(self):
        good = total = 0
        errors = ("28", "-28", "5")  # ENOSPC once, ENOSPC from then on, EIO once
        for at in self.chosen_calls(3):
            for how in errors if self.long else (self.random.choice(errors),):
                what, out = f"call {at} fails with {how}", self.out("calls")
                done = self.run(out, fault=(at, how))
                total += 1
                if self.ended_well(done, (0, EXIT_INPUT_OUTPUT), what):
                    good += self.resumes(out, what=what)
                shutil.rmtree(out, ignore_errors=True)
        return f"{good} of {total} resumed to the same bits"

    def test_kills(self):
        good = total = 0
        for at in self.chosen_calls(2):
            for how in ("kill", "half") if self.long else ("half",):
                what, out = f"killed at call {at} ({how})", self.out("killed")
                self.run(out, fault=(at, how))
                total += 1
                good += self.resumes(out, what=what)
        return f"{good} of {total} resumed to the same bits"

    def test_kinds(self):
        good = total = 0
        for kind in KINDS:
            seconds = self.reference(kind)[3]
            for i in range(20 if self.long else 1):
                out = self.out(f"killed-{kind}")
                child = self.start(out, kind)
                time.sleep(self.random.uniform(0.2, 1.0) * seconds)
                child.kill()
                child.wait()
                # Bits are promised across ranks in time.
                ranks = 2 if self.long and i % 3 == 2 and kind != "quasistatic" else 1
                total += 1
                good += self.resumes(out, kind, f"killed ({kind})", ranks)
            print(f"  {kind}: {good} of {total} so far", flush=True)
        return f"{good} of {total} resumed to the same bits"

    def disturbed_by_space(self, name, run_with, sizes):
        good = total = stopped = 0
        for size in sizes:
            out = self.out(name)
            done = run_with(out, size)
            total += 1
            stopped += done.returncode == EXIT_INPUT_OUTPUT
            if self.ended_well(done, (0, EXIT_INPUT_OUTPUT), f"{name} of {size} kB"):
                good += self.resumes(out, what=f"{name} of {size} kB")
            shutil.rmtree(out, ignore_errors=True)
        return f"{stopped} of {total} too small (exit 4); {good} of {total} resumed to the same bits"

    def test_file_size(self):
        def limited(out, size):
            import resource
            return self.run(out, preexec_fn=lambda: resource.setrlimit(
                resource.RLIMIT_FSIZE, (1024 * size, resource.RLIM_INFINITY)))
        sizes = range(0, 800, 8) if self.long else (0, 64, 120)
        return self.disturbed_by_space("file-size", limited, sizes)

    def test_full_disk(self):
        disk = self.out("disk")
        os.mkdir(disk)

        def mounted(out, size):
            options = f"size={size}k"
            if subprocess.run(["mount", "-t", "tmpfs", "-o", options, "none", disk]).returncode:
                raise PermissionError
            try:
                done = self.run(os.path.join(disk, "run"))
                shutil.copytree(os.path.join(disk, "run"), out)
            finally:
                subprocess.run(["umount", "-l", disk], check=True)
            return done
        if os.geteuid() != 0 or subprocess.run(["mount", "-t", "tmpfs", "none", disk],
                                               stderr=subprocess.DEVNULL).returncode:
            return "skipped: a tmpfs cannot be mounted here"
        subprocess.run(["umount", disk], check=True)
        sizes = range(16, 716, 7) if self.long else (200, 600)
        return self.disturbed_by_space("full-disk", mounted, sizes)

    def paused_run(self, out, files):
        """A run that SIGSTOP holds where it has these files and no result yet.

        A run of a tenth of a second may end before the bench looks at it; then another is started.
        """
        def there():
            return all(os.path.exists(os.path.join(out, file)) for file in files)
        for _ in range(200):
            child = self.start(out)
            while child.poll() is None and not there():
                time.sleep(0.0005)
            child.send_signal(signal.SIGSTOP)
            with contextlib.suppress(ChildProcessError):
                os.waitid(os.P_PID, child.pid, os.WSTOPPED | os.WEXITED | os.WNOWAIT)
            if there() and not os.path.exists(os.path.join(out, "result.json")):
                return child
            child.kill()
            child.communicate()
            shutil.rmtree(out, ignore_errors=True)
        raise AssertionError(f"200 runs ended before they could be stopped with {files}")

    def test_damage(self):
        good = total = older = 0
        source = self.out("to-damage")
        child = self.paused_run(source, ("checkpoint.h5", "checkpoint-before.h5"))
        child.kill()
        child.communicate()
        for i in range(200 if self.long else 3):
            out = self.out("damaged")
            shutil.copytree(source, out)
            path = os.path.join(out, "checkpoint.h5")
            with open(path, "rb") as file:
                data = bytearray(file.read())
            before = bytes(data)
            kind = i % 3
            place = self.random.randrange(len(data))
            if kind == 0:
                data[place] ^= 1 << self.random.randrange(8)
            elif kind == 1:
                page = place // 4096 * 4096
                data[page:page + 4096] = bytes(len(data[page:page + 4096]))
            else:
                del data[place:]
            if bytes(data) == before:
                data[place] ^= 1
            with open(path, "wb") as file:
                file.write(data)
            what = f"damage {i} at byte {place}"
            done = self.run(out, extra=["--resume", "auto"])
            total += 1
            taken = "is damaged" in done.stdout or "cannot be opened" in done.stdout
            older += "going on from the checkpoint before" in done.stdout
            if done.returncode != 0 or not taken:
                self.fail(f"{what}: exit {done.returncode}: {done.stdout[-500:]}")
            else:
                found = self.outcome(out)
                same = found[:3] == self.reference("dynamic")[:3]
                good += same
                if not same:
                    self.fail(f"{what}: other bits")
            shutil.rmtree(out)
            if i % 8 == 2:  # both of them: refused
                shutil.copytree(source, out)
                for name in ("checkpoint.h5", "checkpoint-before.h5"):
                    with open(os.path.join(out, name), "r+b") as file:
                        file.truncate(1000)
                done = self.run(out, extra=["--resume", "auto"])
                self.ended_well(done, (EXIT_INPUT_OUTPUT,), "both checkpoints damaged")
                shutil.rmtree(out)
        return f"{good} of {total} ended with the same bits, {older} of them from the older checkpoint"

    def test_signals(self):
        good = total = 0
        numbers = (signal.SIGTERM, signal.SIGINT, signal.SIGUSR1, signal.SIGUSR2, signal.SIGHUP)
        for number in numbers if self.long else numbers[1:3]:
            for moment in (0.0, 0.1, 0.5) if self.long else (0.3,):
                out = self.out("signalled")
                # Blocked until the program catches them, so that the first one is not too early.
                child = self.start(out, preexec_fn=lambda: signal.pthread_sigmask(
                    signal.SIG_BLOCK, {number}))
                time.sleep(moment * self.reference("dynamic")[3])
                child.send_signal(number)
                text = child.communicate()[0]
                total += 1
                if child.returncode not in (0, EXIT_STOPPED):
                    self.fail(f"{number.name}: exit {child.returncode}: {text[-300:]}")
                good += self.resumes(out, what=number.name)
        # A relaxation that cannot reach its tolerance, stopped in it.
        out = self.out("relaxing")
        unreachable = ["--set", "drive.tolerance=1e-15", "output.checkpoint=none"]
        child = self.start(out, extra=unreachable)
        time.sleep(self.reference("dynamic")[3] * 1.5 + 0.5)
        child.send_signal(signal.SIGTERM)
        text = child.communicate(timeout=60)[0]
        if child.returncode not in (3, EXIT_STOPPED):
            self.fail(f"TERM in a relaxation: exit {child.returncode}: {text[-300:]}")
        # Nobody reads what it says.
        out = self.out("unread")
        command = [*self.command(out), "--set", "output.checkpoint=0.05"]
        command[command.index("off")] = "lines"
        child = subprocess.Popen(command, env=ENVIRONMENT, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        child.stdout.close()
        error = child.stderr.read().decode()
        child.wait()
        total += 1
        good += child.returncode == 0
        if child.returncode != 0:
            self.fail(f"standard output closed: exit {child.returncode}: {error}")
        return f"{good} of {total}"

    def test_directory(self):
        good = total = 0
        for what in ("moved", "removed", "emptied") * (5 if self.long else 1):
            out = self.out("directory")
            child = self.paused_run(out, ("checkpoint.h5",))
            place = out
            if what == "moved":
                place = self.out("elsewhere")
                os.rename(out, place)
            elif what == "removed":
                shutil.rmtree(out, ignore_errors=True)
            else:
                for name in os.listdir(out):
                    try:
                        os.remove(os.path.join(out, name))
                    except FileNotFoundError:
                        pass
            child.send_signal(signal.SIGCONT)
            text = child.communicate()[0]
            total += 1
            told = child.returncode == EXIT_INPUT_OUTPUT
            if what == "moved" and told and f"it is {place} now" in text:  # what it had open it went on with
                same = self.outcome(place)[:3] == self.reference("dynamic")[:3]
                good += same
                if not same:
                    self.fail(f"{what}: other bits")
            elif what != "moved" and told and "cannot be" in text:
                good += 1
            elif child.returncode == 0 and what == "emptied":
                good += self.outcome(place)[:3] == self.reference("dynamic")[:3]
            else:
                self.fail(f"{what}: exit {child.returncode}: {text[-300:]}")
            for path in (out, place):
                shutil.rmtree(path, ignore_errors=True)
        return f"{good} of {total}: the same bits in the directory, wherever it is, or an error with exit code 4"

    def test_two(self):
        longest = 0.0
        for locking in ("TRUE", "FALSE"):
            ENVIRONMENT["HDF5_USE_FILE_LOCKING"] = locking
            out = self.out("shared")
            child = self.paused_run(out, ("run.lock", "run.journal"))
            start = time.monotonic()
            done = self.run(out)
            longest = max(longest, time.monotonic() - start)
            child.send_signal(signal.SIGCONT)
            if done.returncode != EXIT_INPUT_OUTPUT or f"process {child.pid}" not in done.stdout:
                self.fail(f"the second of two: exit {done.returncode}: {done.stdout[-300:]}")
            text = child.communicate()[0]
            if child.returncode != 0 or self.outcome(out)[:3] != self.reference("dynamic")[:3]:
                self.fail(f"the first of two: exit {child.returncode}: {text[-300:]}")
            shutil.rmtree(out)
        del ENVIRONMENT["HDF5_USE_FILE_LOCKING"]
        out = self.out("again")
        child = self.paused_run(out, ("run.journal",))
        child.kill()
        child.communicate()
        before = {file for file in os.listdir(out) if file != "run.lock" and not file.endswith(UNFINISHED)}
        done = self.run(out)
        if done.returncode != EXIT_SCENE or "--restart" not in done.stdout:
            self.fail(f"a killed run started again: exit {done.returncode}: {done.stdout[-300:]}")
        if not before <= set(os.listdir(out)):
            self.fail("a refused start removed something")
        self.resumes(out, what="after a refusal")
        return f"the second of two refused in {longest:.2f} s at most"

    def test_memory(self):
        import resource
        flags = subprocess.run([self.program, "info"], capture_output=True, text=True).stdout
        if "-fsanitize=address" in flags:
            return "not with the address sanitizer, which reserves 16 TB of addresses itself"
        out = self.out("memory")
        codes = []
        for most in (400, 200, 100, 60, 52, 48, 44, 40, 20):  # MB
            def limited(m=most):
                resource.setrlimit(resource.RLIMIT_AS, (m << 20, resource.RLIM_INFINITY))
            # Below this the loader, or the start of CUDA's library before main(), ends it: none of ours has run.
            if subprocess.run([self.program, "--version"], preexec_fn=limited, capture_output=True).returncode != 0:
                codes.append("not started")
                continue
            done = self.run(out, preexec_fn=limited)
            codes.append(done.returncode)
            if done.returncode < 0 or "internal error" in done.stdout:
                self.fail(f"{most} MB of memory: exit {done.returncode}: {done.stdout[-300:]}")
            shutil.rmtree(out, ignore_errors=True)
        return f"exit codes {codes}"


    def ranks_of(self, child):
        """The processes of a run that mpirun has started, when it has begun to record."""
        few = child.ranks
        while child.poll() is None:
            found = [child.pid]
            while len(found) == 1:  # MPICH's mpirun has a process between
                with open(f"/proc/{found[0]}/task/{found[0]}/children") as file:
                    found = [int(word) for word in file.read().split()]
            if len(found) == few and os.path.exists(os.path.join(child.out, "run.journal")):
                return found
            time.sleep(0.001)
        return []

    def have_ended(self, ranks):
        """Whether the ranks have ended within a minute: mpirun ends before they do."""
        give_up = time.monotonic() + 60.0
        while any(os.path.exists(f"/proc/{rank}") for rank in ranks):
            if time.monotonic() > give_up:
                self.fail(f"processes {ranks} are left")
                return False
            time.sleep(0.01)
        return True

    def test_cluster(self):
        import resource
        if not shutil.which(MPIRUN[0]):
            return "skipped: there is no mpirun"
        found, out = [], self.out("cluster")
        wide = ["--set", "surface.sites=1024"]  # several times what MPI takes on each rank

        def limited(megabytes):
            return lambda: resource.setrlimit(resource.RLIMIT_DATA, (megabytes << 20, resource.RLIM_INFINITY))

        # The largest memory, within 8 MB, in which one process does not hold the surface.
        for most in range(24, 1024, 8):
            alone = self.run(out, "wall", wide, preexec_fn=limited(most + 8))
            if alone.returncode == 0:
                undisturbed = self.outcome(out)[:2]
                shutil.rmtree(out)
                break
            shutil.rmtree(out, ignore_errors=True)
            if self.ended_well(alone, [EXIT_SCENE], f"{most + 8} MB for one process") and "memory" not in alone.stdout:
                self.fail(f"{most + 8} MB for one process: {alone.stdout[-300:]}")
        for ranks in (4, 8):
            done = self.run(out, "wall", wide, ranks, preexec_fn=limited(most))
            if done.returncode != 0:
                self.fail(f"{most} MB for each of {ranks} ranks: exit {done.returncode}: {done.stdout[-600:]}")
                continue
            if self.outcome(out)[:2] != undisturbed:
                self.fail(f"other bits with {most} MB for each of {ranks} ranks")
            shutil.rmtree(out)
            found.append(f"{ranks} ranks within {most} MB each")
        for kind, ranks, others in (("quasistatic", 4, 8), ("quasistatic", 8, 4), ("dynamic", 4, 1)):
            wait = self.random.uniform(0.0, 1.0) * self.reference(kind)[3]
            child = self.start(out, kind, ranks=ranks)
            processes = self.ranks_of(child)
            time.sleep(wait)
            with contextlib.suppress(IndexError, ProcessLookupError):  # it has ended
                os.kill(self.random.choice(processes), signal.SIGKILL)
            text = child.communicate(timeout=900)[0]
            if child.returncode != 0 and "killed" not in text.lower():
                self.fail(f"a rank of {ranks} killed ({kind}): exit {child.returncode}: {text[-600:]}")
            if not self.have_ended(processes):
                return "ended: a process that is left would disturb what follows"
            if self.resumes(out, kind, f"a rank of {ranks} killed ({kind})", others):
                found.append(f"killed on {ranks}, resumed on {others}")
            shutil.rmtree(out, ignore_errors=True)
        done = self.run(out, "wall", ranks=4, fault=(20, "slow"))
        if self.ended_well(done, [0], "a slow directory"):
            data, result, _ = self.outcome(out)
            if (data, result) != self.reference("wall")[:2]:
                self.fail("other bits in a slow directory")
            found.append("20 ms for each call of the directory")
        shutil.rmtree(out, ignore_errors=True)
        return "; ".join(found)

    def test_ranks(self):
        if not shutil.which(MPIRUN[0]):
            return "skipped: there is no mpirun"
        good = total = 0
        for i in range(20 if self.long else 2):
            what, out = ("killed", "stopped and continued", "stopped, then mpirun ended")[i % 3], self.out("rank")
            child = self.start(out, ranks=2)
            ranks = self.ranks_of(child)
            time.sleep(self.random.uniform(0.0, 0.5) * self.reference("dynamic")[3])
            total += 1
            try:
                os.kill(ranks[1 - i // 3 % 2], signal.SIGKILL if what == "killed" else signal.SIGSTOP)
            except (IndexError, ProcessLookupError):
                pass  # it has ended
            else:
                if what != "killed":
                    time.sleep(1.0)  # the other one waits for it
                    if what == "stopped and continued":
                        os.kill(ranks[1 - i // 3 % 2], signal.SIGCONT)
                    else:
                        child.send_signal(signal.SIGTERM)
            text = child.communicate(timeout=900)[0]
            if what == "stopped and continued" and child.returncode != 0:
                self.fail(f"rank {what}: exit {child.returncode}: {text[-600:]}")
            if not self.have_ended(ranks):
                return "ended: a process that is left would disturb what follows"
            good += self.resumes(out, what=f"rank {what}", ranks=1 + i % 2)
            shutil.rmtree(out, ignore_errors=True)
        return f"{good} of {total} resumed to the same bits"


def main():
    words = sys.argv[1:]
    long = "--long" in words
    program, library, *names = [w for w in words if w != "--long"]
    bench = Bench(program, library, long)
    tests = ["calls", "kills", "kinds", "file-size", "full-disk", "damage", "signals", "directory", "two", "memory"]
    if long:
        tests += ["ranks", "cluster"]
    try:
        for name in names or tests:
            start = time.monotonic()
            found = getattr(bench, "test_" + name.replace("-", "_"))()
            print(f"{name}: {found} ({time.monotonic() - start:.1f} s)", flush=True)
    finally:
        if bench.failures:
            print("kept for a look:", bench.work)
        else:
            shutil.rmtree(bench.work, ignore_errors=True)
    sys.exit(bench.failures > 0)


main()
