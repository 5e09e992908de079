# An impeller with twisted blades: no mirror plane, so the two cut faces of the wedge are made to
# match.
#
#   make -f ../examples/flows/impeller.mk BIN=../target/release/

all: impeller.vtk impeller.quality.txt
	@cat impeller.quality.txt

include $(dir $(lastword $(MAKEFILE_LIST)))rules.mk

BLADES ?= 7
TETWEDGE_FLAGS = --max-volume 1e-3

impeller.stl:
	$(BODY) impeller --order $(BLADES) --height 0.5 --bore 0.15 -o $@

clean:
	rm -f impeller.*

.PHONY: all clean
