#include "sizes.h"

#include <cmath>

namespace {

const tetgen_shim_input *sizes = nullptr;

// The size at a point; beside the cube that of the nearest place in it.
double size_at(const double (&point)[3]) {
  double at[3];
  for (int axis = 0; axis < 3; axis++) {
    at[axis] = (point[axis] - sizes->size_origin[axis]) / sizes->size_width;
  }
  const tetgen_shim_size *node = sizes->size_nodes;
  while (node->first != 0) {
    uint32_t child = node->first;
    for (int axis = 0; axis < 3; axis++) {
      at[axis] *= 2;
      if (at[axis] >= 1) {
        at[axis] -= 1;
        child += uint32_t(1) << axis;
      }
    }
    node = sizes->size_nodes + child;
  }
  return node->size;
}

} // namespace

void bound_sizes(const tetgen_shim_input &in) { sizes = in.size_nodes != nullptr ? &in : nullptr; }

bool is_too_large(const double *a, const double *b, const double *c, const double *d) {
  if (sizes == nullptr) {
    return false;
  }
  double u[3], v[3], w[3], middle[3];
  for (int i = 0; i < 3; i++) {
    u[i] = a[i] - d[i];
    v[i] = b[i] - d[i];
    w[i] = c[i] - d[i];
    middle[i] = 0.25 * (a[i] + b[i] + c[i] + d[i]);
  }
  const double determinant = u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) +
                             u[2] * (v[0] * w[1] - v[1] * w[0]);
  const double size = size_at(middle);
  return std::fabs(determinant) > 6 * sizes->size_volume * size * size * size;
}
