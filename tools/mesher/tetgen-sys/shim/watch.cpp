#include "watch.h"

#include <unordered_set>

#include <tetgen.h>

#include "sizes.h"

namespace {

// The share of points that are remembered is one in two to the power of this, so that a count is off by the root of
// 64 over its size: 8 % of ten thousand, 2.5 % of a hundred thousand. Remembering all points takes a tenth of TetGen's
// own time.
const int SHARE_BITS = 6;

tetgen_shim_counts *counted = nullptr;
uint64_t checked = 0;
std::unordered_set<const REAL *> remembered;

// Whether a point is one of those that are remembered. Points lie at regular addresses, which the multiplication
// mixes (by the golden ratio, see Knuth, "The Art of Computer Programming" 3, section 6.4).
bool is_remembered(const REAL *point) {
  return uint64_t(reinterpret_cast<uintptr_t>(point)) * 0x9e3779b97f4a7c15u >> (64 - SHARE_BITS) == 0;
}

void count(REAL *a, REAL *b, REAL *c, REAL *d) {
  for (const REAL *point : {a, b, c, d}) {
    if (is_remembered(point) && remembered.insert(point).second) {
      __atomic_store_n(&counted->points, uint64_t(remembered.size()) << SHARE_BITS, __ATOMIC_RELAXED);
    }
  }
  __atomic_store_n(&counted->tetrahedra, ++checked, __ATOMIC_RELAXED);
}

// TetGen asks this of each tetrahedron that it has checked for its volume, whether it is to be split for a reason of
// ours.
bool is_to_be_split(REAL *a, REAL *b, REAL *c, REAL *d, REAL *, REAL) {
  if (is_too_large(a, b, c, d)) {
    return true;
  }
  if (counted != nullptr) {
    count(a, b, c, d);
  }
  return false;
}

} // namespace

void watch(const tetgen_shim_input &in, tetgenio &input) {
  counted = in.counts;
  bound_sizes(in);
  if (in.counts != nullptr || in.size_nodes != nullptr) {
    input.tetunsuitable = is_to_be_split;
  }
}
