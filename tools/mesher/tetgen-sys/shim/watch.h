// Looks at the tetrahedra that TetGen has while it refines.
#ifndef TETGEN_SHIM_WATCH_H
#define TETGEN_SHIM_WATCH_H

#include "tetgen_shim.h"

class tetgenio;

// Has tetrahedra of the next mesh of `input` split that are larger than the sizes of `in` allow, and counts what was done
// unless nobody wants to know. The mesh does not depend on the counts.
void watch(const tetgen_shim_input &in, tetgenio &input);

#endif
