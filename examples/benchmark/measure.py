"""Runs pipes of whole processes and measures them."""

import os
import resource
import signal
import statistics
import subprocess
import threading
import time
from dataclasses import dataclass, field


@dataclass
class Run:
    """One run of a pipe. Times in seconds, memory in bytes, one entry per process."""

    wall: float
    cpu: list
    memory: list
    status: list
    messages: list
    timed_out: bool = False
    output: str = ""

    @property
    def ok(self):
        return not self.timed_out and not any(self.status)

    @property
    def failure(self):
        """Why the run did not succeed, in a sentence."""
        if self.timed_out:
            return f"exceeded its limit of {self.wall:.0f} s"
        for position, status in enumerate(self.status):
            if status:
                lines = self.messages[position].strip().splitlines()
                what = f"signal {-status}" if status < 0 else f"status {status}"
                return f"{what}: {lines[-1].strip()}" if lines else what
        return None


def peak(pid):
    """Peak memory so far of a process that runs, bytes; 0 if it cannot be read any more."""
    try:
        with open(f"/proc/{pid}/status") as status:
            for line in status:
                if line.startswith("VmHWM:"):
                    return 1024 * int(line.split()[1])
    except (OSError, ValueError):
        pass
    return 0


def children(pid):
    """Processes that a process has started and not yet waited for."""
    found = []
    try:
        for thread in os.listdir(f"/proc/{pid}/task"):
            with open(f"/proc/{pid}/task/{thread}/children") as file:
                found += [int(word) for word in file.read().split()]
    except OSError:
        pass
    return found


def footprint(pid):
    """Peak memory so far of a process and of those it has running, bytes.

    `tetwedge` runs TetGen in a child. Memory that both see counts twice: an upper bound.
    """
    return peak(pid) + sum(map(peak, children(pid)))


def run(commands, folder, limit, source=None, sink=os.devnull, sample=False):
    """Runs `commands` as a pipe in `folder`, from the file `source` to the file `sink`.

    The clock runs from before the first process starts until the last has ended; what an earlier run
    left in the sink is removed before. What the system says of a process's peak memory when it has
    ended is never less than that of this program, which is why files are not processed here; with
    `sample`, memory is looked at every two milliseconds instead, for runs whose time does not matter.
    """
    files = [open(os.path.join(folder, f".stderr-{i}"), "w+b") for i in range(len(commands))]
    sink = os.path.join(folder, sink)
    if os.path.isfile(sink):
        os.unlink(sink)
    start = time.perf_counter()
    processes, upstream = [], open(source or os.devnull, "rb")
    for i, command in enumerate(commands):
        last = i + 1 == len(commands)
        out = open(sink, "wb") if last else subprocess.PIPE
        process = subprocess.Popen(command, cwd=folder, stdin=upstream, stdout=out, stderr=files[i])
        upstream.close()
        upstream = process.stdout
        if last:
            out.close()
        processes.append(process)

    expired = threading.Event()

    def kill():
        expired.set()
        running = [p.pid for p in processes if p.returncode is None]
        for pid in [pid for p in running for pid in (*children(p), p)]:
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                pass

    timer = threading.Timer(limit, kill)
    timer.daemon = True
    timer.start()
    sampled = [0] * len(processes)
    while sample and any(p.poll() is None for p in processes[-1:]):
        sampled = [max(old, footprint(p.pid)) for old, p in zip(sampled, processes)]
        time.sleep(0.002)
    cpu, memory, status = [], [], []
    for process in processes if not sample else []:
        _, code, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(code)
        cpu.append(usage.ru_utime + usage.ru_stime)
        memory.append(usage.ru_maxrss * 1024)
        status.append(process.returncode)
    if sample:
        memory, status = sampled, [p.wait() for p in processes]
    wall = time.perf_counter() - start
    timer.cancel()
    messages = []
    for file in files:
        file.seek(0)
        messages.append(file.read().decode(errors="replace"))
        file.close()
    return Run(wall, cpu, memory, status, messages, expired.is_set())


def own_memory():
    """Peak memory of this program, below which no other can be measured, bytes."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024


@dataclass
class Repeats:
    """How often a measurement is repeated: until `least` runs and `seconds` have passed, at most
    `most` times; once if a run alone takes `once`."""

    least: int = 3
    most: int = 9
    seconds: float = 2.0
    once: float = 30.0

    def enough(self, runs):
        if not runs:
            return False
        if not runs[-1].ok or runs[0].wall >= self.once or len(runs) >= self.most:
            return True
        return len(runs) >= self.least and sum(r.wall for r in runs) >= self.seconds


@dataclass
class Series:
    """Runs of the same thing."""

    runs: list = field(default_factory=list)

    @property
    def ok(self):
        return bool(self.runs) and all(r.ok for r in self.runs)

    def summary(self):
        """Medians of times, maxima of memory, as plain data."""
        if not self.ok:
            bad = next(r for r in self.runs if not r.ok)
            return {"failure": bad.failure, "timed_out": bad.timed_out, "seconds": bad.wall}
        walls = [r.wall for r in self.runs]
        return {
            "seconds": statistics.median(walls),
            "seconds_min": min(walls),
            "seconds_max": max(walls),
            "cpu_seconds": statistics.median(sum(r.cpu) for r in self.runs),
            "runs": len(walls),
            # Processes of a pipe run at the same time: the sum of their peaks is an upper bound.
            "memory": max(sum(r.memory) for r in self.runs),
        }


def interleaved(tasks, repeats):
    """Measures several things in turn, so that a drift of the machine meets all of them.

    `tasks`: name to a function without arguments that gives a Run. Returns name to Series.
    """
    series = {name: Series() for name in tasks}
    waiting = dict(tasks)
    while waiting:
        for name, task in list(waiting.items()):
            series[name].runs.append(task())
            if repeats.enough(series[name].runs):
                del waiting[name]
    return series
