// Sizes that change from place to place.
#ifndef TETGEN_SHIM_SIZES_H
#define TETGEN_SHIM_SIZES_H

#include "tetgen_shim.h"

// Takes the sizes of `in` for this process, if it has any.
void bound_sizes(const tetgen_shim_input &in);

// Whether a tetrahedron has more volume than the size at its middle allows.
bool is_too_large(const double *a, const double *b, const double *c, const double *d);

#endif
