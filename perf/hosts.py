# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Several 'hosts' on one machine: network namespaces with names and addresses of their own, and mpirun over them.

Two hosts without a latency are joined by a veth pair. Not every kernel has the queueing discipline netem, which
would add a latency; so the program wire (wire.cpp) is the network then, and holds back the packets. Open MPI starts
its daemons as over ssh, by a launch agent that enters the namespace, and its ranks talk over TCP only.
"""
import os
import shutil
import subprocess
import sys
import tempfile


class CannotMakeHosts(Exception):
    """Says what the machine lacks."""


def mpirun():
    """The launcher, without options: that of the MPI that the tests were built with, or the one in PATH."""
    return os.environ.get("ASPERITY_MPIRUN", "mpirun").split()[:1]


def is_open_mpi(launcher):
    said = subprocess.run([*launcher, "--version"], capture_output=True, text=True).stdout
    return "Open MPI" in said or "OpenRTE" in said


def address(host):
    return f"10.77.0.{host + 1}"


class Hosts:
    """with Hosts() as hosts: hosts.mpirun([...]). With the path of the program wire: over a network of that
    latency one way and that bandwidth of each host (0: no limit)."""

    def __init__(self, count=2, microseconds=0.0, gigabits=0.0, wire=None):
        self.count, self.network, self.wire = count, (microseconds, gigabits), wire
        self.device = "wire0" if wire else "veth0"
        self.children = []

    def __enter__(self):
        self.launcher = mpirun()
        for program in ("ip", "unshare", "nsenter", "setpriv", "taskset", *self.launcher):
            if not shutil.which(program):
                raise CannotMakeHosts(f"{program} is not installed")
        if not is_open_mpi(self.launcher):
            raise CannotMakeHosts(f"{self.launcher[0]} is not that of Open MPI, whose daemon is started on the hosts")
        if os.geteuid() != 0:
            raise CannotMakeHosts("only root may make network namespaces")
        try:
            return self._make()
        except BaseException:
            self.__exit__()
            raise

    def _make(self):
        for host in range(self.count):
            # A namespace lives as long as this process, which ends with us in any case.
            child = subprocess.Popen(
                ["setpriv", "--pdeathsig", "KILL", "unshare", "--net", "--uts", "sh", "-c",
                 f"hostname asperity-{host} && ip link set lo up && echo ready && exec sleep infinity"],
                stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            self.children.append(child)
            if child.stdout.readline() != "ready\n":
                raise CannotMakeHosts("no network namespace: " + child.stderr.read().strip())
        pids = [str(child.pid) for child in self.children]
        if self.wire:
            child = subprocess.Popen([self.wire, *map(str, self.network), *pids], stdin=subprocess.PIPE,
                                     stdout=subprocess.PIPE, text=True)
            self.children.append(child)
            if child.stdout.readline() != "ready\n":
                raise CannotMakeHosts("wire made no devices, for the reason above")
        else:
            self._ip("link", "add", self.device, "netns", pids[0], "type", "veth", "peer", "name", self.device,
                     "netns", pids[1])
        for host in range(self.count):
            self._ip("addr", "add", address(host) + "/24", "dev", self.device, host=host)
            self._ip("link", "set", self.device, "mtu", "9000", "up", host=host)
        self.folder = tempfile.mkdtemp(prefix="asperity-hosts.")
        self.hostfile, self.agent = os.path.join(self.folder, "hosts"), os.path.join(self.folder, "enter")
        cores = sorted(os.sched_getaffinity(0))
        self.enter = [["nsenter", "-t", pid, "--net", "--uts", "taskset", "-c", str(cores[host % len(cores)])]
                      for host, pid in enumerate(pids)]
        with open(self.agent, "w") as file: # like ssh: HOST COMMAND
            file.write("#!/bin/sh\nhost=$1; shift\ncase $host in\n")
            for host in range(self.count):
                file.write(f"{address(host)}) exec {' '.join(self.enter[host])} sh -c \"$*\" ;;\n")
            file.write("esac\n")
        os.chmod(self.agent, 0o700)
        with open(self.hostfile, "w") as file:
            file.writelines(f"{address(host)} slots=1\n" for host in range(self.count))
        return self

    def __exit__(self, *_):
        for child in self.children:
            child.kill()
            child.wait()
        if hasattr(self, "folder"):
            shutil.rmtree(self.folder)

    def _ip(self, *words, host=None):
        enter = [] if host is None else ["nsenter", "-t", str(self.children[host].pid), "-n"]
        run = subprocess.run(enter + ["ip", *words], stderr=subprocess.PIPE, text=True)
        if run.returncode != 0:
            raise CannotMakeHosts(f"ip {' '.join(words)}: {run.stderr.strip()}")

    def mpirun(self, command, **options):
        """Runs the command with one rank on each host, kept to a core; returns the finished process."""
        mca = {"plm_rsh_agent": self.agent, "btl": "self,tcp", "pml": "ob1", "btl_tcp_if_include": self.device,
               "oob_tcp_if_include": self.device, "plm_rsh_no_tree_spawn": "1",
               "mpi_yield_when_idle": str(int(self.count > len(os.sched_getaffinity(0))))}
        words = [*self.enter[0], *self.launcher, "-n", str(self.count), "--hostfile", self.hostfile,
                 "--map-by", "node", "--bind-to", "none"]
        for name, value in mca.items():
            words += ["--mca", name, value]
        environment = {**os.environ, "OMP_NUM_THREADS": "1", "OMPI_ALLOW_RUN_AS_ROOT": "1",
                       "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
        return subprocess.run(words + list(command), env=environment, text=True, capture_output=True, **options)

    def bytes_sent(self, host):
        """By the host over the network since it was made."""
        with open(f"/proc/{self.children[host].pid}/net/dev") as file:
            line = next(line for line in file if line.strip().startswith(self.device))
        return int(line.split(":")[1].split()[8])
