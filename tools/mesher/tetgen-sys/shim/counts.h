// Counts what TetGen has done while it refines.
#ifndef TETGEN_SHIM_COUNTS_H
#define TETGEN_SHIM_COUNTS_H

#include "tetgen_shim.h"

class tetgenio;

// Has the next mesh of `input` counted into `counts`, unless that is null. The mesh does not depend on it.
void count_into(tetgen_shim_counts *counts, tetgenio &input);

#endif
