# Current heats the copper of a filled via, its outer surface is cooled: CalculiX solves one sector with
# cyclic symmetry, and the whole mesh, and every node of the sector has to have the same temperature
# in both.
#
#   make -f ../examples/flows/heat.mk BIN=../target/release/

all: tsv.heat.txt
	@cat $<

include $(dir $(lastword $(MAKEFILE_LIST)))rules.mk

CCX ?= ccx
ORDER ?= 16
THICKNESS ?= 2e-2
# The whole body has to fit the solver too.
EDGE ?= 0.08

# A sector between cut faces that match. Without a hub, for a sector is one wedge from the axis on, and
# of full height, for the load need not be symmetric in height.
WEDGECUT_FLAGS = --domain rotation --order $(ORDER) --hub none --horizontal-mirror off
PERIODIC_SURF_FLAGS = --edge-length $(EDGE)
TETWEDGE_FLAGS = --edge-length $(EDGE)

tsv.stl:
	$(BODY) tsv --order $(ORDER) --thickness $(THICKNESS) --height 0.5 --rotate 7 -v -o $@

tsv.sector.inp: tsv.tet.tmesh
	$(BIN)rotassemble --sector $(ROTASSEMBLE_FLAGS) $< -o $@

tsv.whole.inp: tsv.tet.tmesh
	$(BIN)rotassemble $(ROTASSEMBLE_FLAGS) $< -o $@

# Conductivities in W/(K um), lengths in um, power in W: temperatures are those above the surroundings.
define DECK
*INCLUDE, INPUT=$*.inp
*MATERIAL, NAME=silicon
*CONDUCTIVITY
1.5e-4
*MATERIAL, NAME=oxide
*CONDUCTIVITY
1.4e-6
*MATERIAL, NAME=copper
*CONDUCTIVITY
4e-4
*SOLID SECTION, ELSET=silicon, MATERIAL=silicon
*SOLID SECTION, ELSET=liner, MATERIAL=oxide
*SOLID SECTION, ELSET=copper, MATERIAL=copper
*INITIAL CONDITIONS, TYPE=TEMPERATURE
all-nodes, 0.
*STEP
*HEAT TRANSFER, STEADY STATE
1., 1.
*FILM
*INCLUDE, INPUT=$*.film
*DFLUX
copper, BF, 1e-3
*NODE PRINT, NSET=all-nodes
NT
*END STEP
endef

%.deck.inp: %.inp %.film
	$(file >$@,$(DECK))

# The surface of the name, as cooled faces: element, face, temperature of the surroundings, coefficient.
%.film: %.inp
	awk -F '[ ,]+' '/^\*/ { on = /^\*SURFACE, NAME=silicon,/; next } \
	  on { sub("S", "F", $$2); print $$1 ", " $$2 ", 0., 1e-4" }' $< >$@

# Said of the whole deck only where something is amiss.
%.deck.dat: %.deck.inp
	@TIMEFORMAT='$*: solved in %R s'; time $(CCX) -i $*.deck >$*.log
	@! grep -E -A3 '\*(WARNING|ERROR)' $*.log

%.heat.txt: %.sector.inp %.sector.deck.dat %.whole.inp %.whole.deck.dat
	awk -f $(dir $(filter %heat.mk,$(MAKEFILE_LIST)))same-temperatures.awk $^ >$@

clean:
	rm -f tsv.* spooles.out

.PHONY: all clean
