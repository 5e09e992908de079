// Moves TetGen's output into the memory file that the parent maps.
#ifndef TETGEN_SHIM_RESULT_H
#define TETGEN_SHIM_RESULT_H

#include "tetgen_shim.h"

class tetgenio;

// Writes header and arrays; `output` may be null when `code` is not 0.
// Returns whether the whole result was written.
bool write_result(int file, int64_t code, const tetgenio *output);

#endif
