"""What the figures were measured on. No names of hosts or users."""

import hashlib
import os
import platform
import re
import subprocess


def read(path):
    try:
        with open(path) as file:
            return file.read()
    except OSError:
        return ""


def output(*command):
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=60)
        return done.stdout + done.stderr
    except OSError:
        return ""


def describe():
    """Processor, cores, memory, system and versions."""
    model = re.search(r"model name\s*:\s*(.*)", read("/proc/cpuinfo"))
    memory = re.search(r"MemTotal:\s*(\d+)", read("/proc/meminfo"))
    system = re.search(r'PRETTY_NAME="?([^"\n]*)', read("/etc/os-release"))
    tetgen = re.search(r"tetgen\s+(\S+)", output("dpkg-query", "-W", "tetgen"))
    return {
        "processor": model.group(1).strip() if model else platform.machine(),
        "cores": os.cpu_count(),
        "memory_gib": round(int(memory.group(1)) / 2**20, 1) if memory else None,
        "system": system.group(1) if system else platform.system(),
        "kernel": platform.release().split("-")[0],
        "python": platform.python_version(),
        "tetgen": tetgen.group(1) if tetgen else "unknown",
    }


def fingerprint(binaries, tools):
    """Identity of the programs measured: results of different ones must not be mixed."""
    digest = hashlib.sha256()
    for tool in tools:
        with open(os.path.join(binaries, tool), "rb") as file:
            while block := file.read(1 << 20):
                digest.update(block)
    return digest.hexdigest()[:16]
