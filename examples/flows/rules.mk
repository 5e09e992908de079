# Pattern rules for the stages of the pipe, each a file. Include it from the flow of a device.
#
#   part.stl > part.sym.tmesh > part.wedge.tmesh > part.surf.tmesh > part.tet.tmesh > part.vtk
#                                                                                  > part.quality.txt
#
# Any stage as it stands, to look at:
#   make -f FLOW part.wedge.vtk       one wedge, its walls labelled, for ParaView
#   make -f FLOW part.wedge.whole.vtk all copies of it
#   make -f FLOW part.wedge.txt       the document as text

SHELL := bash
.SHELLFLAGS := -euo pipefail -c
.DELETE_ON_ERROR:
.SUFFIXES:

# Folder of the tools, with a slash at the end; nothing takes them from PATH.
BIN ?=
# Generator of the bodies: `cargo build --release -p body`.
BODY ?= $(BIN)body

# Options of each stage; a flow sets what its device needs.
SYMDETECT_FLAGS ?=
WEDGECUT_FLAGS ?=
PERIODIC_SURF_FLAGS ?=
TETWEDGE_FLAGS ?=
ROTASSEMBLE_FLAGS ?=
MESHQUAL_FLAGS ?= --check

%.sym.tmesh: %.stl
	$(BIN)symdetect $(SYMDETECT_FLAGS) $< -o $@

%.wedge.tmesh: %.sym.tmesh
	$(BIN)wedgecut $(WEDGECUT_FLAGS) $< -o $@

%.surf.tmesh: %.wedge.tmesh
	$(BIN)periodic-surf $(PERIODIC_SURF_FLAGS) $< -o $@

%.tet.tmesh: %.surf.tmesh
	$(BIN)tetwedge $(TETWEDGE_FLAGS) $< -o $@

%.vtk: %.tet.tmesh
	$(BIN)rotassemble $(ROTASSEMBLE_FLAGS) $< -o $@

# For Gmsh and what takes meshes from it.
%.msh: %.tet.tmesh
	$(BIN)rotassemble $(ROTASSEMBLE_FLAGS) $< -o $@

%.quality.txt: %.tet.tmesh
	$(BIN)meshqual $(MESHQUAL_FLAGS) $< -o $@

# A stage to look at. The stem `part.wedge` matches these, `part` alone the rules above.
%.vtk: %.tmesh
	$(BIN)rotassemble --sector --boundary $< -o $@

%.whole.vtk: %.tmesh
	$(BIN)rotassemble --boundary $< -o $@

%.txt: %.tmesh
	$(BIN)rotassemble --to txt $< -o $@

# Stages are kept for the next run and for a look.
.SECONDARY:
