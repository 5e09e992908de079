"""The two ways to the mesh: the pipe, and the mesher on the whole body."""

import os
import re
import sys

import measure

HERE = os.path.dirname(os.path.abspath(__file__))
STAGES = ("symdetect", "wedgecut", "tetwedge", "rotassemble")

# The angle of `tetwedge --optimize`, by variant; as it comes, the pipe optimizes to 130 degrees.
VARIANTS = {"default": None, "off": "off"}


def decimal(value):
    """A number as TetGen's switches take it."""
    return f"{value:.15f}".rstrip("0").rstrip(".")


class Pipe:
    """symdetect | wedgecut | tetwedge | rotassemble, from an STL file to a VTK file."""

    def __init__(self, binaries, elements, optimize=None):
        tool = lambda name: os.path.join(binaries, name)
        volume = ["--max-volume", repr(elements.max_volume)]
        ratio = ["--radius-edge", repr(elements.radius_edge)]
        quality = [*ratio, "--min-dihedral", repr(elements.min_dihedral)]
        angle = ["--optimize", optimize] if optimize else []
        self.commands = [
            [tool("symdetect"), "body.stl"],
            [tool("wedgecut"), *ratio, *volume],
            [tool("tetwedge"), *quality, *volume, *angle],
            [tool("rotassemble")],
        ]

    def run(self, folder, limit, sink="pipe.vtk"):
        """The whole pipe."""
        return measure.run(self.commands, folder, limit, sink=sink)

    def memory(self, folder, limit):
        """Peak memory of each process of the pipe, bytes, from a run of its own."""
        return measure.run(self.commands, folder, limit, sink=os.devnull, sample=True).memory

    def stage(self, index, folder, limit):
        """One stage alone, from a file to a file; the stages before it must have run."""
        source = os.path.join(folder, f"stage-{index}.tmesh") if index else None
        sink = f"stage-{index + 1}.tmesh" if index < 3 else "stage.vtk"
        command = self.commands[index] + (["-v"] if STAGES[index] == "tetwedge" else [])
        return measure.run([command], folder, limit, source, sink)


def mesher_seconds(run):
    """Time that tetwedge spent in TetGen, from its messages."""
    return sum(float(s) for s in re.findall(r"meshed in ([0-9.]+) s", run.messages[0]))


class Direct:
    """TetGen's program on the whole body, with its usual output."""

    def __init__(self, elements, optimize=None):
        switches = f"-pq{elements.radius_edge:g}/{elements.min_dihedral:g}a{decimal(elements.max_volume)}A"
        if optimize not in (None, "off"):
            switches += f"o/{optimize}"
        self.switches = switches
        self.commands = [["tetgen", switches, "body.poly"]]

    def run(self, folder, limit):
        for name in os.listdir(folder):
            if name.startswith("body.1."):
                os.unlink(os.path.join(folder, name))
        result = measure.run(self.commands, folder, limit, sink="direct.log")
        if result.ok and not os.path.exists(os.path.join(folder, "body.1.ele")):
            result.status, result.messages = [1], ["no elements written"]
        return result

    @staticmethod
    def output_seconds(folder):
        """Time that TetGen says it spent writing its files, which are text."""
        with open(os.path.join(folder, "direct.log"), errors="replace") as log:
            found = re.search(r"Output seconds:\s*([0-9.eE+-]+)", log.read())
        return float(found.group(1)) if found else 0.0


class Hxt:
    """Gmsh's HXT on the whole body, if a Python that has the package `gmsh` is given."""

    def __init__(self, python, cell):
        e = cell.elements
        self.commands = [
            [python, os.path.join(HERE, "hxt.py"), cell.category, str(cell.order), repr(e.max_volume), "hxt.msh"]
        ]

    @staticmethod
    def available(python):
        run = measure.run([[python or sys.executable, "-c", "import gmsh"]], "/", 60)
        return run.ok

    def run(self, folder, limit):
        mesh = os.path.join(folder, "hxt.msh")
        if os.path.exists(mesh):
            os.unlink(mesh)
        return measure.run(self.commands, folder, limit, sink="hxt.log")
