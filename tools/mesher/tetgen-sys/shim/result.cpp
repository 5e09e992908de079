#include "result.h"

#include <errno.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/types.h>
#include <unistd.h>

#include <cstring>

#include <tetgen.h>

namespace {

struct Array {
  const void *data;
  uint64_t count;
  uint64_t bytes; // all elements

  uint64_t padded() const { return (bytes + 7) & ~uint64_t(7); }
};

Array array(const void *data, int count, uint64_t element_bytes) {
  if (data == nullptr || count <= 0) {
    return Array{nullptr, 0, 0};
  }
  return Array{data, uint64_t(count), uint64_t(count) * element_bytes};
}

} // namespace

bool write_result(int file, int64_t code, const tetgenio *output) {
  Array arrays[7] = {};
  if (code == 0) {
    const tetgenio &o = *output;
    // TetGen may give more than one attribute per tetrahedron; only a single one is passed on.
    const int attributes = o.numberoftetrahedronattributes == 1 ? o.numberoftetrahedra : 0;
    arrays[0] = array(o.pointlist, o.numberofpoints, 24);
    arrays[1] = array(o.tetrahedronlist, o.numberoftetrahedra, 16);
    arrays[2] = array(o.neighborlist, o.numberoftetrahedra, 16);
    arrays[3] = array(o.tetrahedronattributelist, attributes, 8);
    arrays[4] = array(o.trifacelist, o.numberoftrifaces, 12);
    arrays[5] = array(o.trifacemarkerlist, o.numberoftrifaces, 4);
    arrays[6] = array(o.adjtetlist, o.numberoftrifaces, 8);
  }
  uint64_t size = sizeof(tetgen_shim_header);
  for (const Array &a : arrays) {
    size += a.padded();
  }
  // Reserves the pages, so that a shortage shows here and not as a bus error.
  int failed;
  do {
    failed = posix_fallocate(file, 0, off_t(size));
  } while (failed == EINTR);
  if (failed != 0) {
    return false;
  }
  void *map = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  if (map == MAP_FAILED) {
    return false;
  }
  auto *header = static_cast<tetgen_shim_header *>(map);
  header->code = code;
  header->points = arrays[0].count;
  header->tetrahedra = arrays[1].count;
  header->neighbors = arrays[2].count;
  header->attributes = arrays[3].count;
  header->triangles = arrays[4].count;
  header->triangle_markers = arrays[5].count;
  header->triangle_sides = arrays[6].count;
  char *to = static_cast<char *>(map) + sizeof(tetgen_shim_header);
  for (const Array &a : arrays) {
    if (a.bytes != 0) {
      memcpy(to, a.data, a.bytes);
    }
    to += a.padded();
  }
  header->state = TETGEN_SHIM_DONE;
  return munmap(map, size) == 0;
}
