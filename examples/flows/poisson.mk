# A gear through Gmsh's reader into dolfinx, which solves for heat in it, on one rank and on several: the results
# have to be the same.
#
#   make -f ../examples/flows/poisson.mk BIN=../target/release/
#
# Needs dolfinx and Gmsh's Python package (on Debian python3-dolfinx, python3-gmsh, openmpi-bin).

all: gear.poisson.txt
	@cat $<

include $(dir $(lastword $(MAKEFILE_LIST)))rules.mk

TEETH ?= 12
VOLUME ?= 1e-3
RANKS ?= 4
# The Python that has dolfinx.
PYTHON ?= python3
MPIRUN ?= mpirun
# Open MPI refuses more ranks than there are cores unless it is told not to.
OMPI_MCA_rmaps_base_oversubscribe ?= 1
export OMPI_MCA_rmaps_base_oversubscribe

WEDGECUT_FLAGS = --max-volume $(VOLUME)
TETWEDGE_FLAGS = --max-volume $(VOLUME)
SOLVE = $(PYTHON) $(dir $(filter %poisson.mk,$(MAKEFILE_LIST)))poisson.py

gear.stl:
	$(BODY) gear --order $(TEETH) --height 0.3 --rotate 5 --to ascii -o $@

gear.serial.txt: gear.msh
	$(SOLVE) $< 2>gear.log >$@ || { cat gear.log >&2; false; }

gear.parallel.txt: gear.msh gear.serial.txt
	$(MPIRUN) -n $(RANKS) $(SOLVE) $< 2>gear.log >$@ || { cat gear.log >&2; false; }

# Below the first line, which tells the number of ranks.
gear.poisson.txt: gear.serial.txt gear.parallel.txt
	diff <(tail -n +2 gear.serial.txt) <(tail -n +2 gear.parallel.txt)
	cat $^ >$@

clean:
	rm -f gear.*

.PHONY: all clean
