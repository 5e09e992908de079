"""Heat in a body whose surface is kept at zero, by dolfinx, on as many ranks as MPI starts:

    mpirun -n 4 python3 poisson.py gear.msh

The mesh comes from Gmsh's Python package, which reads the file with its physical names. Solves -div grad u = 1
with u = 0 on the surfaces named, or on the whole boundary, and prints volume, names and areas of the surfaces,
and the integral of u.
"""
import sys

import dolfinx
import gmsh
import numpy as np
import ufl
from dolfinx import fem
from dolfinx.fem.petsc import LinearProblem
from mpi4py import MPI
from petsc4py import PETSc

try:
    from dolfinx.io import gmshio
except ImportError:
    from dolfinx.io import gmsh as gmshio

path, cooled = sys.argv[1], sys.argv[2:]
comm = MPI.COMM_WORLD
names = None
gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)
if comm.rank == 0:
    gmsh.open(path)
    groups = gmsh.model.getPhysicalGroups()
    names = {gmsh.model.getPhysicalName(d, tag): (d, tag) for d, tag in groups if d < 3}
names = comm.bcast(names)
mesh, cells, facets = gmshio.model_to_mesh(gmsh.model, comm, 0, gdim=3)[:3]
gmsh.finalize()

dx = ufl.Measure("dx", domain=mesh)
ds = ufl.Measure("ds", domain=mesh, subdomain_data=facets)
one = fem.Constant(mesh, PETSc.ScalarType(1.0))


def integral(form):
    return comm.allreduce(fem.assemble_scalar(fem.form(form)))


surfaces = {name: tag for name, (dimension, tag) in names.items() if dimension == 2}
tags = [surfaces[name] for name in cooled or surfaces]
space = getattr(fem, "functionspace", getattr(fem, "FunctionSpace", None))(mesh, ("Lagrange", 1))
fixed = facets.indices[np.isin(facets.values, tags)]
condition = fem.dirichletbc(
    PETSc.ScalarType(0.0), fem.locate_dofs_topological(space, 2, fixed), space
)
u, v = ufl.TrialFunction(space), ufl.TestFunction(space)
options = {"ksp_type": "cg", "pc_type": "jacobi", "ksp_rtol": 1e-12}
solution = LinearProblem(
    ufl.inner(ufl.grad(u), ufl.grad(v)) * dx, one * v * dx, bcs=[condition], petsc_options=options
).solve()
results = [f"volume {integral(one * dx):.10g}"]
results += [f"area {name} {integral(one * ds(tag)):.10g}" for name, tag in surfaces.items()]
results.append(f"integral of u {integral(solution * dx):.10g}")
count = comm.allreduce(mesh.topology.index_map(3).size_local)
if comm.rank == 0:
    print(f"dolfinx {dolfinx.__version__}, {comm.size} ranks, {count} tetrahedra")
    print("\n".join(results))
