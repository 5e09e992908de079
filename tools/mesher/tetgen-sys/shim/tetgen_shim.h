/* C interface to TetGen: one call that forks, meshes in the child, and leaves the result in a
   memory file that both processes share. */
#ifndef TETGEN_SHIM_H
#define TETGEN_SHIM_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* How far refinement is, written by the child while it works. */
struct tetgen_shim_counts {
  uint64_t tetrahedra;      /* that were within the bounds on volumes when they were checked */
  uint64_t points;          /* distinct corners of them, estimated */
};

/* A node of an octree of sizes. */
struct tetgen_shim_size {
  double size;              /* in a leaf */
  uint32_t first;           /* the first of eight children, which follow each other, x first; 0 for a leaf */
  uint32_t padding;
};

/* A piecewise linear complex of triangles. */
struct tetgen_shim_input {
  const char *switches;     /* NUL-terminated */
  const double *points;     /* 3 per point */
  const int32_t *triangles; /* 3 point numbers from 0 per triangle */
  const int32_t *markers;   /* 1 per triangle */
  const double *holes;      /* 3 per hole */
  const double *regions;    /* 5 per region: point, attribute, largest volume */
  int32_t point_count;
  int32_t triangle_count;
  int32_t hole_count;
  int32_t region_count;
  uint64_t memory;          /* bytes the child may allocate; 0 for no limit */
  struct tetgen_shim_counts *counts; /* in memory shared with the child, or null */
  const struct tetgen_shim_size *size_nodes; /* the root first, or null where sizes are the same everywhere */
  double size_origin[3];    /* least coordinates of the cube that it divides */
  double size_width;        /* its width */
  double size_volume;       /* largest volume of a tetrahedron over the cube of the size at its middle */
};

/* Begins the memory file; the arrays follow, each at a multiple of 8 bytes, in the order of the
   counts. An absent array has count 0. */
struct tetgen_shim_header {
  uint64_t state;           /* 0 while the child works, then TETGEN_SHIM_DONE */
  int64_t code;             /* 0, what TetGen threw, or a TETGEN_SHIM_... code */
  uint64_t points;          /* 3 doubles each */
  uint64_t tetrahedra;      /* 4 ints each */
  uint64_t neighbors;       /* 4 ints each, opposite to the corners; -1 for none */
  uint64_t attributes;      /* 1 double each */
  uint64_t triangles;       /* 3 ints each */
  uint64_t triangle_markers;/* 1 int each */
  uint64_t triangle_sides;  /* 2 ints each: tetrahedra beside the triangle; -1 for none */
};

#define TETGEN_SHIM_DONE 0x7465746465736821ull
#define TETGEN_SHIM_BAD_SWITCHES 1000
#define TETGEN_SHIM_UNKNOWN_EXCEPTION 1001
#define TETGEN_SHIM_NO_SPACE 1002
#define TETGEN_SHIM_NOT_LINEAR 1003
#define TETGEN_SHIM_ENDED 1004 /* TetGen asked to end without an error */

/* Forks a child that meshes `input`, prints to `chatter` (a file descriptor), and writes to the
   memory file `result`. Returns the child's process id, or -1 with errno set. */
int32_t tetgen_shim_start(const struct tetgen_shim_input *input, int result, int chatter);

#ifdef __cplusplus
}
#endif

#endif
