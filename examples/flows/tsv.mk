# A filled through-silicon via: copper core, thin liner, silicon. Run it in a folder of its own:
#
#   make -f ../examples/flows/tsv.mk BIN=../target/release/

all: tsv.vtk tsv.quality.txt
	@cat tsv.quality.txt

include $(dir $(lastword $(MAKEFILE_LIST)))rules.mk

ORDER ?= 16
THICKNESS ?= 5e-3

# The size of elements, which the later stages take from the document.
WEDGECUT_FLAGS = --edge-length 0.08

# Anywhere in space: the pipe finds the axis by itself.
tsv.stl:
	$(BODY) tsv --order $(ORDER) --thickness $(THICKNESS) --rotate 7 -v -o $@

clean:
	rm -f tsv.*

.PHONY: all clean
