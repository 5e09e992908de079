# Gears of several sizes, meshed side by side with `make -j`:
#
#   make -j4 -f ../examples/flows/gear.mk BIN=../target/release/

TEETH ?= 8 12 24 30
GEARS = $(TEETH:%=gear-%)

all: $(GEARS:%=%.vtk) $(GEARS:%=%.quality.txt)
	@grep -H '' $(GEARS:%=%.quality.txt)

include $(dir $(lastword $(MAKEFILE_LIST)))rules.mk

TETWEDGE_FLAGS = --max-volume 1e-3

gear-%.stl:
	$(BODY) gear --order $* --height 0.3 -o $@

clean:
	rm -f gear-*

.PHONY: all clean
